! The same as program.c, by the module periodyn.
program consumer
    use periodyn
    implicit none
    integer, parameter :: dp = c_double
    real(dp), parameter :: stiffness = 3, damping = 0.2_dp, omega = 1.5_dp, &
        period = 2*acos(-1.0_dp)/omega
    real(dp) :: inertia(3, 3), angle(1), expected
    type(pdn_model) :: model
    type(pdn_solution) :: solution
    integer :: body, hinge

    print '(a)', pdn_build_info()
    inertia = reshape([0.4_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.4_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.5_dp], &
        [3, 3])
    expected = stiffness - inertia(3, 3)*omega**2
    expected = 0.6_dp*expected/(expected**2 + (damping*omega)**2)
    call model%new()
    call model%add_rigid_body(2.0_dp, [0.0_dp, 0.0_dp, 0.0_dp], inertia, body)
    call model%add_revolute(PDN_GROUND, body, [0.0_dp, 0.0_dp, 0.0_dp], [0.0_dp, 0.0_dp, 1.0_dp], &
        hinge)
    call model%add_spring_damper(hinge, PDN_ROTATION, stiffness, damping, 0.0_dp)
    call model%add_load(body, PDN_FRAME_SPACE, PDN_MOMENT_3, &
        pdn_harmonics_signal(0.0_dp, 0.0_dp, [0.6_dp], [0.0_dp]))
    call model%solve_periodic(period, solution)
    call solution%sample(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
        [0.0_dp], angle)
    print '(2(a, f0.12))', 'angle at the start ', angle, ', expected ', expected
    if (.not. solution%converged() .or. abs(angle(1) - expected) > 1e-6_dp) error stop 1
end program consumer
