program pendulum
    use periodyn
    implicit none
    integer, parameter :: dp = c_double
    real(dp), parameter :: pi = acos(-1.0_dp)
    type(pdn_model) :: model
    type(pdn_solution) :: solution
    real(dp) :: inertia(3, 3), largest(1), time(1)
    integer :: bar, hinge

    ! Metres, kilograms, seconds. Below its hinge hangs a bar of 1 m and 2 kg.
    inertia = 0
    inertia(1, 1) = 1.0_dp/6
    inertia(2, 2) = 1.0_dp/6
    inertia(3, 3) = 0.001_dp
    call model%new()
    call model%set_gravity([real(dp) :: 0, 0, -9.81_dp])
    call model%add_rigid_body(2.0_dp, [real(dp) :: 0, 0, -0.5], inertia, bar)
    call model%add_revolute(PDN_GROUND, bar, [real(dp) :: 0, 0, 0], [real(dp) :: 0, 1, 0], hinge)
    call model%add_spring_damper(hinge, PDN_ROTATION, stiffness=0.0_dp, damping=0.5_dp)

    ! A motor at the hinge pushes it to and fro, by 1.5 N m at 3 rad/s.
    call model%add_actuator(hinge, PDN_ROTATION, &
        pdn_harmonics_signal(cosines=[1.5_dp], sines=[0.0_dp]))

    call model%solve_periodic(2*pi/3, solution)
    print '(2a)', 'converged: ', trim(merge('yes', 'no ', solution%converged()))
    call solution%extremes(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
        largest=largest, time_of_largest=time)
    print '(a, f0.3, a, f5.3, a)', 'it swings to ', largest*180/pi, ' degrees, at ', time, ' s'
end program pendulum
