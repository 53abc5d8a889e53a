! The flexible spatial four-bar mechanism of Han and Bauchau, Nonlinear Dynamics 92 (2018), section
! 7.2.
!
! Rocker AB (revolute at A, spherical at B), coupler BC (universal at C) and crank CD, which a motor
! at D turns once in a period. Metres, newtons, kilograms, seconds.
!
!   spatial_four_bar [--grid N] [--elements E] [--order P] [--out FILE]
!
! FILE gets `t,x3_B,v3_B,torque_D` at 401 times from 0 to T: height and vertical velocity of B, and
! the torque of the motor. The same programs in C and C++ print the same.
program spatial_four_bar
    use periodyn
    use, intrinsic :: iso_fortran_env, only: error_unit
    implicit none

    integer, parameter :: dp = c_double, times = 401
    integer :: grid = 21, elements = 8, order = 1
    character(:), allocatable :: out

    ! The reference configuration, in which nothing is strained.
    real(dp), parameter :: point_A(3) = [-0.40_dp, 0.00_dp, 0.000_dp]
    real(dp), parameter :: point_B(3) = [-0.75_dp, 0.00_dp, 0.652_dp]
    real(dp), parameter :: point_C(3) = [0.00_dp, 0.85_dp, 0.200_dp]
    real(dp), parameter :: point_D(3) = [0.00_dp, 0.85_dp, 0.000_dp]
    real(dp), parameter :: i1(3) = [1, 0, 0], i2(3) = [0, 1, 0]
    ! i1 x BC: arm of the universal joint fixed to BC
    real(dp), parameter :: cross(3) = [0.0_dp, 0.452_dp, 0.85_dp]
    real(dp), parameter :: omega = 0.3_dp, period = 20.943951023931954923_dp ! 2 pi / omega

    type(pdn_section) :: steel16, steel8
    type(pdn_model) :: model
    type(pdn_beam) :: rocker, coupler, crank
    type(pdn_signal) :: turn
    type(pdn_periodic_options) :: options
    type(pdn_solution) :: solution
    integer :: hinge_A, motor_D, i, lowest, highest, unit
    real(dp) :: t(times), position(3, times), velocity(6, times), torque(times)

    call read_options()

    ! Steel, 16 x 16 mm and 8 x 8 mm: [axial, shear, shear, torsion, bending, bending] stiffness;
    ! mass and its moments of inertia [m, m11, m22, m33], for each unit of length.
    steel16 = pdn_diagonal_section([52.99e6_dp, 16.88e6_dp, 16.88e6_dp, 733.5_dp, 1131.0_dp, &
        1131.0_dp], [1.997_dp, 85.20e-6_dp, 42.60e-6_dp, 42.60e-6_dp])
    steel8 = pdn_diagonal_section([13.25e6_dp, 4.220e6_dp, 4.220e6_dp, 45.84_dp, 70.66_dp, &
        70.66_dp], [0.4992_dp, 5.324e-6_dp, 2.662e-6_dp, 2.662e-6_dp])

    call model%new()
    call model%add_straight_beam(point_A, point_B, i2, steel16, elements, order, rocker)
    call model%add_straight_beam(point_B, point_C, i1, steel16, elements, order, coupler)
    call model%add_straight_beam(point_C, point_D, i1, steel8, elements, order, crank)

    call model%add_revolute(PDN_GROUND, rocker%first, point_A, i2, hinge_A)
    call model%add_spherical(rocker%last, coupler%first, point_B)
    call model%add_universal(coupler%last, crank%first, point_C, cross, i1)
    call model%add_revolute(PDN_GROUND, crank%last, point_D, i1, motor_D)

    call model%add_spring_damper(hinge_A, PDN_ROTATION, stiffness=18.0_dp, damping=0.0_dp, &
        rest=0.0_dp)

    ! theta(t) = 0.3 t + (1 - cos 0.3 t) / 3 + sin(0.6 t) / 10 + (1 - cos 0.9 t) / 21
    turn = pdn_harmonics_signal(mean=1.0_dp/3 + 1.0_dp/21, rate=omega, &
        cosines=[-1.0_dp/3, 0.0_dp, -1.0_dp/21], sines=[0.0_dp, 0.1_dp, 0.0_dp])
    call model%prescribe(motor_D, PDN_ROTATION, turn)

    call pdn_init(options)
    options%grid_points = grid
    call model%solve_periodic(period, solution, options)
    write (*, '(a)', advance='no') solution%report()
    if (.not. solution%converged()) error stop 1

    t = [(period*i/(times - 1), i=0, times - 1)]
    call solution%sample(pdn_quantity_of(PDN_NODE_POSITION, rocker%last), t, position)
    call solution%sample(pdn_quantity_of(PDN_NODE_VELOCITY, rocker%last), t, velocity)
    call solution%sample(pdn_quantity_of(PDN_JOINT_DRIVING_EFFORT, motor_D, PDN_ROTATION), t, &
        torque)

    lowest = minloc(torque, dim=1)
    highest = maxloc(torque, dim=1)
    write (*, '(a, 2(f0.4, a, f5.3, a))') 'Torque of the motor: ', torque(lowest), ' N m at ', &
        t(lowest)/period, ' T to ', torque(highest), ' N m at ', t(highest)/period, ' T'

    if (len(out) > 0) then
        open (newunit=unit, file=out, status='replace', action='write')
        write (unit, '(a)') 't,x3_B,v3_B,torque_D'
        do i = 1, times
            write (unit, '(3(es24.16e3, ","), es24.16e3)') t(i), position(3, i), velocity(3, i), &
                torque(i)
        end do
        close (unit)
    end if

    call solution%free()
    call model%free()

contains

    subroutine read_options()
        character(1000) :: name, value
        integer :: k, wrong

        out = ''
        do k = 1, command_argument_count(), 2
            call get_command_argument(k, name)
            call get_command_argument(k + 1, value)
            wrong = 0
            select case (name)
            case ('--grid')
                read (value, *, iostat=wrong) grid
            case ('--elements')
                read (value, *, iostat=wrong) elements
            case ('--order')
                read (value, *, iostat=wrong) order
            case ('--out')
                out = trim(value)
            case default
                wrong = 1
            end select
            if (wrong /= 0 .or. k == command_argument_count()) then
                write (error_unit, '(a)') &
                    'usage: spatial_four_bar [--grid N] [--elements E] [--order P] [--out FILE]'
                error stop 2
            end if
        end do
    end subroutine read_options
end program spatial_four_bar
