! Procedures that no other test needs: each gives what its function in C does, against closed forms
! where there are results.
program test_procedures
    use checks
    implicit none

    integer :: stat = 77
    character(300) :: errmsg = 'none'

    call library()
    call functions_of_phase()
    call parameters()
    call branches()
    call events()
    call reading()
    call beams_and_shells()

contains

    integer(c_int32_t) function moment(phase, value, user_data) bind(C)
        real(c_double), value :: phase
        real(c_double), intent(inout) :: value
        type(c_ptr), value :: user_data

        value = 0.6_dp*cos(phase)
        moment = merge(1, 0, c_associated(user_data))
    end function moment

    ! A damper about axis 3, without tangents.
    integer(c_int32_t) function drag(state, values, user_data) bind(C)
        type(pdn_force_state), intent(in) :: state
        type(pdn_force_values), intent(inout) :: values
        type(c_ptr), value :: user_data
        real(dp), pointer :: velocities(:, :), forces(:, :)

        call c_f_pointer(state%velocities, velocities, [6, 1])
        call c_f_pointer(values%forces, forces, [6, 1])
        forces(6, 1) = -0.1_dp*velocities(6, 1)
        drag = merge(1, 0, c_associated(user_data))
    end function drag

    subroutine library()
        call pdn_version_check(PDN_VERSION_MAJOR, PDN_VERSION_MINOR)
        call pdn_version_check(99, 0, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'version: ')
        call pdn_set_last_error('my own words  ')
        call check(pdn_last_error() == 'my own words', 'message of a library on top')
    end subroutine library

    ! Of the angle at the start, under this moment, with more damping.
    subroutine functions_of_phase()
        type(pdn_model) :: model, copy
        type(pdn_signal) :: never
        type(pdn_solution) :: solution
        integer :: body, hinge, spring, force, node, loads, frame, first, elements, load
        real(dp) :: factors(2), angle(1), fraction, offset(3)

        call oscillator(model, body, hinge, spring)
        call model%add_load(body, PDN_FRAME_SPACE, PDN_MOMENT_3, &
            pdn_function_of_phase_signal(moment))
        call model%add_user_force([body], PDN_FRAME_SPACE, PDN_TANGENTS_DIFFERENCED, drag, &
            force=force)
        call model%declare_of_phase(force)
        call model%set_mass_damping(0.4_dp)
        call model%copy(copy)
        call model%free()
        call copy%solve_periodic(period, solution)
        call solution%sample(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
            [0.0_dp], angle)
        factors = oscillator_angle(3.0_dp, 0.2_dp + 0.1_dp + 0.4_dp*0.5_dp)
        call near(angle(1), factors(1), 1e-9_dp, 'angle')
        call copy%force_node(force, 0, node)
        call copy%load_count(loads)
        call check(node == body .and. loads == 1, 'node of a force')
        call copy%load_at(PDN_FIRST_LOAD, node, first, elements, fraction, frame)
        call check(node == body .and. frame == PDN_FRAME_SPACE, 'load')
        call check(first == -1 .and. elements == 0, 'no beam')
        call copy%add_load_at_point(body, [0.0_dp, 0.5_dp, 0.0_dp], PDN_FRAME_SPACE, PDN_FORCE_1, &
            pdn_constant_signal(2.0_dp), load=load)
        call copy%set_load_frame(load, PDN_FRAME_MATERIAL)
        call copy%load_at(load, node, first, elements, fraction, frame, offset)
        call check(node == body .and. frame == PDN_FRAME_MATERIAL, 'load at a point')
        call near(offset(2), 0.5_dp, 1e-15_dp, 'offset')
        call copy%add_load_on_beam(PDN_FIRST_BEAM_ELEMENT, 1, 0.5_dp, PDN_FRAME_SPACE, &
            PDN_FORCE_1, pdn_constant_signal(2.0_dp), stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'first_element')
        call copy%add_load(body, PDN_FRAME_SPACE, PDN_MOMENT_3, never, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_STRUCT_SIZE, 'signal')
    end subroutine functions_of_phase

    ! The oscillator under the moment 0.6 cos(omega t), whose stiffness is a parameter.
    subroutine with_stiffness(model, body, hinge, parameter)
        type(pdn_model), intent(inout) :: model
        integer, intent(out) :: body, hinge, parameter
        integer :: spring

        call oscillator(model, body, hinge, spring)
        call model%add_parameter('stiffness', 3.0_dp, 1.0_dp, parameter)
        call model%move_number(parameter, PDN_NUMBER_STIFFNESS, spring, 1, 1.0_dp)
        call model%add_load(body, PDN_FRAME_SPACE, PDN_MOMENT_3, &
            pdn_harmonics_signal(cosines=[0.6_dp], sines=[0.0_dp]))
    end subroutine with_stiffness

    ! 0.5 s^2 + 0.2 s + k = 0, and multipliers are exp(s T).
    subroutine parameters()
        type(pdn_model) :: model
        type(pdn_solution) :: solution
        type(pdn_stability) :: stability
        type(pdn_stability_options) :: options
        type(pdn_sensitivities) :: sensitivities
        type(pdn_conditions) :: conditions
        type(pdn_quantity) :: angle
        integer :: body, hinge, parameter, count
        complex(dp) :: s, derivative
        real(dp) :: re(1), im(1), found, derivatives(1, 1), factors(2)

        call with_stiffness(model, body, hinge, parameter)
        call model%parameter_count(count)
        call check(count == 1, 'parameters')
        call model%solve_periodic(period, solution)
        call solution%floquet_count(count)
        call check(count == 2, 'multipliers')
        call pdn_init(options)
        options%tolerance = 1e-10_dp
        call solution%solve_stability(stability, options)
        call check(stability%converged(), 'stability')
        call sensitivities%new()
        call sensitivities%add_parameter(parameter)
        call solution%multiplier_sensitivities(sensitivities, stability, 0, re, im)
        s = cmplx(-0.2_dp, sqrt(6 - 0.04_dp), dp)
        derivative = -period*exp(s*period)/(s + 0.2_dp)
        call near(re(1), real(derivative), 1e-7_dp, 'multiplier by stiffness')
        call near(abs(im(1)), abs(aimag(derivative)), 1e-7_dp, 'multiplier by stiffness')
        call solution%multiplier_sensitivities(sensitivities, stability, 0, re, im(:0), stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'im: expected the shape 1, got 0')

        ! The stiffness for which the cosine of the angle is what it is at 2.5.
        factors = oscillator_angle(2.5_dp, 0.2_dp)
        angle = pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION)
        call conditions%new()
        call conditions%release(parameter)
        call conditions%add_quantity(angle, PDN_FEATURE_COSINE, 1.0_dp, factors(1))
        call model%solve_conditioned(period, conditions, solution)
        call solution%parameter(parameter, found)
        call near(found, 2.5_dp, 1e-8_dp, 'stiffness')
        call sensitivities%new()
        call sensitivities%add_found(parameter)
        call sensitivities%add_parameter(parameter)
        call solution%sensitivities(sensitivities, derivatives, conditions, stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'parameters: ')
        call conditions%add_phase()
        call conditions%add_energy(1.0_dp)
        call conditions%add_joint_coordinate(hinge, PDN_ROTATION, 0.1_dp)
    end subroutine parameters

    ! The amplitude along the stiffness, on the grid that is asked for.
    subroutine branches()
        type(pdn_model) :: model
        type(pdn_branch) :: branch
        type(pdn_branch_options) :: options
        type(pdn_periodic_options) :: periodic
        type(pdn_branch_point) :: point
        type(pdn_solution) :: solution
        type(pdn_diagnostics) :: figures
        integer :: body, hinge, parameter, count, i
        real(dp) :: cosines(1, 1), factors(2)

        call with_stiffness(model, body, hinge, parameter)
        call pdn_init(options)
        options%from = 2.5_dp
        options%to = 4
        call pdn_init(periodic)
        periodic%grid_points = 21
        call model%follow_branch(period, parameter, branch, options, periodic)
        call branch%count(count)
        call check(count > 2, 'points')
        do i = 0, count - 1
            call branch%get(i, point)
            call branch%solution(i, solution)
            call solution%diagnostics(figures)
            call check(figures%grid_points == 21, 'grid')
            call solution%harmonics(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
                cosines=cosines)
            factors = oscillator_angle(point%parameter, 0.2_dp)
            call near(cosines(1, 1), factors(1), 1e-9_dp, 'cosine')
        end do
        call branch%write_csv('test_procedures.csv')
    end subroutine branches

    ! Grid points that are closer together about an event are those asked for.
    subroutine events()
        type(pdn_model) :: model
        type(pdn_solution) :: solution
        type(pdn_periodic_options) :: options
        integer :: body, hinge, parameter, count
        real(dp), allocatable :: times(:), widths(:), shares(:)

        call with_stiffness(model, body, hinge, parameter)
        call pdn_init(options)
        options%grid_points = 61
        options%time_map = PDN_TIME_MAP_EVENTS
        call model%solve_periodic(period, solution, options, event_times=[1.0_dp], &
            event_widths=[0.5_dp], event_shares=[1.0_dp])
        call solution%sharp_event_count(count)
        call solution%sharp_events(times, widths, shares)
        call check(count == 1 .and. size(times) == 1, 'events')
        call near(times(1), 1.0_dp, 1e-14_dp, 'time')
        call near(widths(1), 0.5_dp, 1e-14_dp, 'width')
        call near(shares(1), 1.0_dp, 1e-14_dp, 'share')
        call model%solve_periodic(period, solution, options, event_times=[1.0_dp], &
            event_widths=[0.5_dp, 0.5_dp], stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'event_widths: expected the shape 1, got 2')
    end subroutine events

    subroutine reading()
        type(pdn_model) :: model
        integer :: body, hinge, spring, count

        call oscillator(model, body, hinge, spring)
        call model%add_free_joint(PDN_GROUND, body, origin)
        call model%add_relation(PDN_FIRST_JOINT + [0, 1], [PDN_ROTATION, PDN_ROTATION_3], &
            [1.0_dp, -1.0_dp])
        call model%relation_term_count(PDN_FIRST_RELATION, count)
        call check(count == 2, 'terms')
        call model%set_label(body, 'wheel')
        call check(model%label(body) == 'wheel', 'label')
        call model%set_label(body)
        call check(model%label(body) == '', 'no label')
    end subroutine reading

    subroutine beams_and_shells()
        type(pdn_model) :: model
        type(pdn_beam) :: beam
        type(pdn_shell) :: shell
        type(pdn_section) :: section
        integer :: count, node, first, elements, place, frame
        real(dp) :: twist

        call model%new()
        call model%add_beam_between(pdn_straight_line(origin, 2*axis_1, axis_2), &
            [steel(), steel()], [0.0_dp, 0.25_dp, 1.0_dp], 2, beam, [0.0_dp, 1.0_dp], &
            [0.0_dp, 0.8_dp])
        call check(beam%elements == 2, 'elements')
        call model%beam_element_node_count(beam%first_element, count)
        call model%beam_element_node(beam%first_element, 2, node)
        call check(count == 3 .and. node == beam%first + 2, 'nodes of an element')
        call model%set_beam_spin(beam%first_element, 2, 0.0_dp)
        twist = 1
        call model%beam_spin(beam%first_element, twist)
        call check(twist == 0, 'spin of an element')
        call model%beam_section(beam%first_element, 0.0_dp, section, twist)
        call near(section%stiffness(1), 53e6_dp, 1e-6_dp, 'stiffness')
        call near(twist, 0.8_dp/8, 1e-15_dp, 'twist')
        call model%beam_load_count(count)
        call check(count == 0, 'loads of beams')
        call model%add_beam_between(pdn_straight_line(origin, axis_1, axis_2), [steel()], &
            [real(dp) ::], 2, beam, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'count: ')

        call model%add_shell(pdn_parallelogram_surface(origin, axis_1, axis_2), 1, 1, 2, 2, &
            pdn_isotropic_shell_section(0.02_dp, 3e6_dp, 0.3_dp, 1200.0_dp), shell)
        call model%add_shell_load(shell%first_element, 1, PDN_SHELL_SURFACE, PDN_FRAME_SPACE, &
            PDN_FORCE_3, pdn_constant_signal(1.0_dp))
        call model%shell_load(PDN_FIRST_SHELL_LOAD, first, elements, place, frame)
        call check(first == shell%first_element .and. elements == 1 .and. place == &
            PDN_SHELL_SURFACE .and. frame == PDN_FRAME_SPACE, 'load of a shell')
    end subroutine beams_and_shells
end program test_procedures
