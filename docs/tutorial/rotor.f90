program rotor_program
    use rotor_model
    implicit none
    real(dp), parameter :: speed = 5
    type(rotor), target :: r
    type(pdn_solution) :: solution
    real(dp) :: mean(1), cosines(1, 2), sines(1, 2)
    integer :: j

    call build_rotor(r, speed, 0.02_dp)
    call r%model%solve_periodic(r%period, solution)
    print '(2a)', 'converged: ', trim(merge('yes', 'no ', solution%converged()))
    call solution%harmonics(pdn_quantity_of(PDN_JOINT_DRIVING_EFFORT, r%shaft, PDN_ROTATION), mean)
    print '(a, f0.3, a)', 'power: ', -1e-3_dp*speed*mean, ' kW'
    call solution%harmonics(pdn_quantity_of(PDN_BEAM_FORCE, r%blades(1)%first_element, 4, &
        station=-1.0_dp), mean, cosines=cosines, sines=sines)
    print '(a, f0.3, a)', 'flapwise moment at the root: mean ', 1e-3_dp*mean, ' kN m'
    do j = 1, 2
        print '(2x, i0, 2(a, f6.3), a)', j, ' a turn: ', 1e-3_dp*cosines(1, j), ' cos, ', &
            1e-3_dp*sines(1, j), ' sin'
    end do
end program rotor_program
