program sweep
    use rotor_model
    implicit none
    real(dp), parameter :: speeds(5) = [3, 4, 5, 6, 7]
    type(rotor), target :: r(5)
    type(pdn_solution) :: last, solution
    real(dp) :: least(1), most(1)
    integer :: i

    do i = 1, 5
        call build_rotor(r(i), speeds(i), 0.02_dp)
        if (i == 1) then
            call r(i)%model%solve_periodic(r(i)%period, solution)
        else
            call r(i)%model%solve_periodic(r(i)%period, solution, initial=last)
        end if
        call solution%extremes(pdn_quantity_of(PDN_BEAM_FORCE, r(i)%blades(1)%first_element, 5, &
            station=-1.0_dp), smallest=least, largest=most)
        print '(i0, 2(a, f0.3), 2a)', nint(speeds(i)), ' rad/s: edgewise moment at the root ', &
            1e-3_dp*least, ' to ', 1e-3_dp*most, ' kN m, ', &
            trim(merge('converged    ', 'not converged', solution%converged()))
        last = solution
    end do
end program sweep
