! Functions of the caller: signals, laws, user forces and progress, with their data; and their
! failures.
module functions
    use checks
    implicit none
    public

    type :: law_data
        real(dp) :: stiffness = 2, damping = 0.1_dp
        integer :: calls = 0, destroyed = 0
    end type law_data

contains

    integer(c_int32_t) function moment(time, value, user_data) bind(C)
        real(c_double), value :: time
        real(c_double), intent(inout) :: value
        type(c_ptr), value :: user_data
        real(dp), pointer :: amplitude

        call c_f_pointer(user_data, amplitude)
        value = amplitude*cos(omega*time)
        moment = 0
    end function moment

    integer(c_int32_t) function law(time, coordinate, rate, effort, derivatives, user_data) bind(C)
        real(c_double), value :: time, coordinate, rate
        real(c_double), intent(inout) :: effort
        real(c_double), intent(inout), optional :: derivatives(*)
        type(c_ptr), value :: user_data
        type(law_data), pointer :: data

        call c_f_pointer(user_data, data)
        data%calls = data%calls + 1
        effort = data%stiffness*coordinate + data%damping*rate
        if (present(derivatives)) derivatives(1:2) = [data%stiffness, data%damping]
        law = 0
        if (time < 0) law = 1
    end function law

    subroutine destroy(user_data) bind(C)
        type(c_ptr), value :: user_data
        type(law_data), pointer :: data

        call c_f_pointer(user_data, data)
        data%destroyed = data%destroyed + 1
    end subroutine destroy

    ! The same as the law, as a moment on the body.
    integer(c_int32_t) function torque(state, values, user_data) bind(C)
        type(pdn_force_state), intent(in) :: state
        type(pdn_force_values), intent(inout) :: values
        type(c_ptr), value :: user_data
        type(law_data), pointer :: data
        real(dp), pointer :: rotations(:, :), velocities(:, :), forces(:, :), by_motion(:, :), &
            by_velocity(:, :)

        call c_f_pointer(user_data, data)
        call c_f_pointer(state%rotations, rotations, [9, int(state%node_count)])
        call c_f_pointer(state%velocities, velocities, [6, int(state%node_count)])
        call c_f_pointer(values%forces, forces, [6, int(state%node_count)])
        forces(6, 1) = -data%stiffness*atan2(rotations(2, 1), rotations(1, 1)) &
            - data%damping*velocities(6, 1)
        if (c_associated(values%by_motion)) then
            call c_f_pointer(values%by_motion, by_motion, [6, 6])
            call c_f_pointer(values%by_velocity, by_velocity, [6, 6])
            by_motion(6, 6) = -data%stiffness
            by_velocity(6, 6) = -data%damping
        end if
        torque = 0
    end function torque

    integer(c_int32_t) function failing(time, value, user_data) bind(C)
        real(c_double), value :: time
        real(c_double), intent(inout) :: value
        type(c_ptr), value :: user_data

        value = 0
        failing = 0
        if (time > 1) then
            call pdn_set_callback_error('no moment is known')
            failing = merge(42, 43, .not. c_associated(user_data))
        end if
    end function failing

    integer(c_int32_t) function failing_curve(fraction, position, axis_2, user_data) bind(C)
        real(c_double), value :: fraction
        real(c_double), intent(inout) :: position(*), axis_2(*)
        type(c_ptr), value :: user_data

        position(1:3) = fraction
        axis_2(1:3) = 1
        failing_curve = merge(5, 6, .not. c_associated(user_data))
    end function failing_curve

    ! A lift along a beam.
    integer(c_int32_t) function lift(state, values, user_data) bind(C)
        type(pdn_surface_state), intent(in) :: state
        type(pdn_surface_values), intent(inout) :: values
        type(c_ptr), value :: user_data
        real(dp), pointer :: places(:, :), forces(:, :)

        call c_f_pointer(state%places, places, [2, int(state%point_count)])
        call c_f_pointer(values%forces, forces, [6, int(state%point_count)])
        forces(3, :) = 1000
        lift = merge(0, 1, all(abs(places(1, :)) < 1) .and. all(abs(places(2, :)) <= 0) .and. &
            state%element == PDN_FIRST_BEAM_ELEMENT + 1 .and. .not. c_associated(user_data))
    end function lift

    ! Cancels after as many iterations as the data says.
    integer(c_int32_t) function cancel(progress, user_data) bind(C)
        type(pdn_progress), intent(in) :: progress
        type(c_ptr), value :: user_data
        integer, pointer :: left

        call c_f_pointer(user_data, left)
        left = left - 1
        cancel = merge(1, 0, left <= 0 .and. progress%iteration > 0)
    end function cancel
end module functions

program test_callbacks
    use functions
    implicit none

    call laws_and_forces()
    call lifts()
    call failures()
    call cancelling()

contains

    subroutine laws_and_forces()
        type(pdn_model) :: model
        type(pdn_solution) :: solution
        type(pdn_tangent_check) :: tangents
        type(law_data), target :: data
        real(dp), target :: amplitude
        real(dp) :: factors(2), angle(1)
        integer :: body, hinge, spring, force, kind, stat

        amplitude = 0.6_dp
        factors = oscillator_angle(5.0_dp, 0.3_dp)
        do kind = 1, 3
            call oscillator(model, body, hinge, spring)
            call model%add_load(body, PDN_FRAME_SPACE, PDN_MOMENT_3, &
                pdn_function_signal(moment, c_loc(amplitude)))
            select case (kind)
            case (1)
                call model%add_coordinate_law(hinge, PDN_ROTATION, PDN_TANGENTS_DIFFERENCED, law, &
                    c_loc(data))
            case (2)
                call model%add_coordinate_law(hinge, PDN_ROTATION, PDN_TANGENTS_GIVEN, law, &
                    c_loc(data), destroy, force)
            case (3)
                call model%add_user_force([body], PDN_FRAME_MATERIAL, PDN_TANGENTS_GIVEN, torque, &
                    c_loc(data), destroy, force)
            end select
            if (kind == 2) then
                call model%check_tangents(force, period, tangents)
                call check(tangents%error < 1e-7_dp, 'tangents')
            end if
            call model%solve_periodic(period, solution)
            call check(solution%converged(), 'converged')
            call solution%sample(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
                [0.0_dp], angle)
            call near(angle(1), factors(1), merge(1e-9_dp, 1e-12_dp, kind == 1), 'angle')
        end do
        call check(data%calls > 0, 'calls')
        ! The models of kinds 1 and 2 are gone, that of kind 3 is here, and in the solution.
        call check(data%destroyed == 1, 'destroyed with the last model')
        call model%free()
        call check(data%destroyed == 1, 'kept by the solution')
        call solution%free()
        call check(data%destroyed == 2, 'destroyed with the solution')
        call oscillator(model, body, hinge, spring)
        call model%add_coordinate_law(99, PDN_ROTATION, PDN_TANGENTS_GIVEN, law, c_loc(data), &
            destroy, stat=stat)
        call check(stat == PDN_ERR_ID .and. data%destroyed == 2, 'not taken')
    end subroutine laws_and_forces

    ! A lift by a function is the load.
    subroutine lifts()
        type(pdn_model) :: model
        type(pdn_solution) :: solution
        type(pdn_beam) :: beam
        type(pdn_force_info) :: info
        real(dp) :: position(3, 1), heights(2)
        integer :: force, k

        do k = 1, 2
            call model%new()
            call model%add_straight_beam(origin, axis_1, axis_2, steel(), 2, 2, beam)
            call model%add_rigid_joint(PDN_GROUND, beam%first, origin)
            if (k == 1) then
                call model%add_distributed_load(beam%first_element + 1, 1, PDN_FRAME_MATERIAL, &
                    PDN_FORCE_3, pdn_constant_signal(1000.0_dp))
            else
                call model%add_line_force(beam%first_element + 1, 1, PDN_FRAME_MATERIAL, &
                    PDN_TANGENTS_DIFFERENCED, lift, first_force=force)
                call model%force(force, info)
                call check(info%kind == PDN_FORCE_IS_LINE_FORCE .and. &
                    info%beam_element == PDN_FIRST_BEAM_ELEMENT + 1, 'force along a beam')
            end if
            call model%solve_static(solution)
            call check(solution%converged(), 'converged')
            call solution%sample(pdn_quantity_of(PDN_NODE_POSITION, beam%last), [0.0_dp], position)
            heights(k) = position(3, 1)
        end do
        call check(heights(1) > 1e-3_dp, 'lifted')
        call near(heights(2), heights(1), 1e-12_dp, 'lift by a function')
    end subroutine lifts

    subroutine failures()
        type(pdn_model) :: model
        type(pdn_solution) :: solution
        type(pdn_beam) :: beam
        character(300) :: errmsg
        integer :: body, hinge, spring, stat

        call oscillator(model, body, hinge, spring)
        call model%add_load(body, PDN_FRAME_SPACE, PDN_MOMENT_3, pdn_function_signal(failing))
        call model%solve_periodic(period, solution, stat=stat, errmsg=errmsg)
        call check(stat == PDN_ERR_CALLBACK .and. pdn_last_callback_code() == 42, &
            'status of the callback')
        call check(index(errmsg, 'no moment is known') > 0, 'message of the callback')
        call check(.not. c_associated(solution%handle()), 'no solution')

        call model%add_beam(pdn_curve_line(failing_curve), [steel()], 1, 1, beam, stat=stat, &
            errmsg=errmsg)
        call check(stat == PDN_ERR_CALLBACK .and. pdn_last_callback_code() == 5, &
            'status of the curve')
    end subroutine failures

    subroutine cancelling()
        type(pdn_model) :: model
        type(pdn_solution) :: solution
        type(pdn_periodic_options) :: options
        integer, target :: left
        integer :: body, hinge, spring, outcome

        call oscillator(model, body, hinge, spring)
        call model%add_load(body, PDN_FRAME_SPACE, PDN_MOMENT_3, pdn_constant_signal(1.0_dp))
        left = 1
        call pdn_init(options)
        options%progress = c_funloc(cancel)
        options%progress_data = c_loc(left)
        call model%solve_periodic(period, solution, options)
        call solution%outcome(outcome)
        call check(outcome == PDN_CANCELLED .and. left <= 0 .and. .not. solution%converged(), &
            'cancelled')
    end subroutine cancelling
end program test_callbacks
