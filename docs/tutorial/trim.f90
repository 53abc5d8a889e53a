program trim_program
    use rotor_model
    implicit none
    type(rotor), target :: r
    type(pdn_quantity) :: held
    type(pdn_conditions) :: conditions
    type(pdn_solution) :: solution
    real(dp) :: found, mean(1)
    integer :: pitch, b

    ! Which pitch gives a mean thrust of 8 kN? The shaft holds the hub against it.
    call build_rotor(r, 5.0_dp, 0.02_dp)
    call r%model%add_parameter('collective pitch', 0.02_dp, 0.1_dp, pitch)
    do b = 1, 3
        call r%model%move_signal(pitch, r%pitches(b), 0, PDN_PART_MEAN, 1.0_dp)
    end do
    held = pdn_quantity_of(PDN_JOINT_REACTION, r%shaft, 0)
    call conditions%new()
    call conditions%release(pitch)
    call conditions%add_quantity(held, PDN_FEATURE_MEAN, 0.0_dp, -8e3_dp)

    call r%model%solve_conditioned(r%period, conditions, solution)
    print '(2a)', 'converged: ', trim(merge('yes', 'no ', solution%converged()))
    call solution%parameter(pitch, found)
    print '(a, f0.3, a)', 'pitch: ', found*180/pi, ' degrees'
    call solution%harmonics(held, mean)
    print '(a, f0.3, a)', 'thrust: ', -1e-3_dp*mean, ' kN'
end program trim_program
