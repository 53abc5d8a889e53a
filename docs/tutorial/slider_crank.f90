program slider_crank
    use periodyn
    implicit none
    integer, parameter :: dp = c_double
    real(dp), parameter :: x(3) = [1, 0, 0], y(3) = [0, 1, 0], z(3) = [0, 0, 1]
    real(dp), parameter :: centre(3) = 0, pin(3) = 0.1_dp*x, far(3) = 0.5_dp*x
    real(dp), parameter :: speed = 150, young = 210e9_dp, shear = 81e9_dp, density = 7850
    real(dp), parameter :: width = 0.012_dp, area = width**2, bending = area**2/12
    type(pdn_section) :: steel
    type(pdn_model) :: model
    type(pdn_solution) :: solution
    type(pdn_beam) :: rod
    real(dp) :: least(1), most(1)
    integer :: crank, piston, motor, slide

    ! A motor turns the crank at 150 rad/s, a rod of steel pushes the piston against a damper.
    steel = pdn_diagonal_section([young*area, shear*area*5/6, shear*area*5/6, &
        shear*0.141_dp*area**2, young*bending, young*bending], &
        density*[area, 2*bending, bending, bending])
    call pdn_section_set_proportional_damping(steel, 1e-5_dp)

    call model%new()
    call model%add_rigid_body(1.0_dp, centre, diagonal([2e-3_dp, 2e-3_dp, 3e-3_dp]), crank)
    call model%add_straight_beam(pin, far, y, steel, 4, 3, rod)
    call model%add_rigid_body(0.6_dp, far, diagonal([4e-4_dp, 4e-4_dp, 4e-4_dp]), piston)
    call model%add_revolute(PDN_GROUND, crank, centre, z, motor)
    call model%add_revolute(crank, rod%first, pin, z)
    call model%add_revolute(rod%last, piston, far, z)
    call model%add_prismatic(PDN_GROUND, piston, far, x, slide)
    call model%add_spring_damper(slide, PDN_DISPLACEMENT, stiffness=0.0_dp, damping=20.0_dp)
    call model%prescribe(motor, PDN_ROTATION, pdn_harmonics_signal(rate=speed))

    call model%solve_periodic(2*acos(-1.0_dp)/speed, solution)
    print '(2a)', 'converged: ', trim(merge('yes', 'no ', solution%converged()))
    call solution%extremes(pdn_quantity_of(PDN_JOINT_DRIVING_EFFORT, motor, PDN_ROTATION), &
        smallest=least, largest=most)
    print '(2(a, f0.2), a)', 'torque of the motor: ', least, ' to ', most, ' N m'
    call solution%extremes(pdn_quantity_of(PDN_BEAM_FORCE, rod%first_element + 2, 5, &
        station=-1.0_dp), smallest=least, largest=most)
    print '(2(a, f0.2), a)', 'moment in the middle of the rod: ', least, ' to ', most, ' N m'

contains

    pure function diagonal(values) result(matrix)
        real(dp), intent(in) :: values(3)
        real(dp) :: matrix(3, 3)
        integer :: i

        matrix = 0
        do i = 1, 3
            matrix(i, i) = values(i)
        end do
    end function diagonal
end program slider_crank
