program unchecked
    use periodyn
    implicit none
    type(pdn_model) :: model
    type(pdn_frame) :: frame

    call model%new()
    call model%node_frame(7, frame)
    print '(a)', 'went on'
end program unchecked
