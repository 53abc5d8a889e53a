! Every procedure of the module periodyn at least once, against closed forms where there are
! results.
program test_model
    use checks
    implicit none

    call library()
    call solution_of_oscillator()
    call motions()
    call beams()
    call everything()
    call viscoelastic()
    call handles()

contains

    ! The first effort is -x times the second input, and x lags behind the rate of the first.
    integer(c_int32_t) function govern(state, values, user_data) bind(C)
        type(pdn_controller_state), intent(in) :: state
        type(pdn_controller_values), intent(inout) :: values
        type(c_ptr), value :: user_data
        real(dp), pointer :: inputs(:), rates(:), states(:), efforts(:), state_rates(:)
        real(dp), pointer :: by_inputs(:, :), by_rates(:, :), by_states(:, :)

        call c_f_pointer(state%inputs, inputs, [2])
        call c_f_pointer(state%input_rates, rates, [2])
        call c_f_pointer(state%states, states, [1])
        call c_f_pointer(values%efforts, efforts, [1])
        call c_f_pointer(values%state_rates, state_rates, [1])
        efforts(1) = -states(1)*inputs(2)
        state_rates(1) = rates(1) - states(1)
        if (c_associated(values%by_inputs)) then
            call c_f_pointer(values%by_inputs, by_inputs, [2, 2])
            call c_f_pointer(values%by_input_rates, by_rates, [2, 2])
            call c_f_pointer(values%by_states, by_states, [2, 1])
            by_inputs(1, 2) = -states(1)
            by_rates(2, 1) = 1
            by_states(:, 1) = [-inputs(2), -1.0_dp]
        end if
        govern = merge(1, 0, c_associated(user_data))
    end function govern

    subroutine library()
        character(40) :: version

        write (version, '(i0, ".", i0, ".", i0)') PDN_VERSION_MAJOR, PDN_VERSION_MINOR, &
            PDN_VERSION_PATCH
        call check(pdn_version() == version, 'version')
        call check(index(pdn_build_info(), pdn_version()) > 0, 'build info')
        call check(pdn_status_name(PDN_ERR_VALUE) == 'PDN_ERR_VALUE', 'status name')
        call check(len(pdn_status_message(PDN_ERR_VALUE)) > 0, 'status message')
        call pdn_set_panic_printing(1)
        call pdn_release_memory()
    end subroutine library

    subroutine solution_of_oscillator()
        type(pdn_model) :: model
        type(pdn_solution) :: solution, again
        type(pdn_periodic_options) :: options
        type(pdn_diagnostics) :: figures
        integer :: body, hinge, spring, outcome, k
        real(dp), allocatable :: residuals(:), increments(:), steps(:), amplitudes(:), times(:)
        real(dp) :: angle(31), rate(31), acceleration(31), effort(31), position(3, 31), &
            rotation(9, 31)
        real(dp) :: quaternion(4, 31), velocity(6, 31), turning(6, 31), reaction(6, 31), &
            on_body(6, 31)
        real(dp) :: expected, slope, factors(2), mean(1), growth(1), cosines(1, 2), sines(1, 2), &
            mean6(6)
        real(dp) :: cosines6(6, 2), sines6(6, 2), plain(1), smooth(1)

        call oscillator(model, body, hinge, spring)
        call model%add_load(body, PDN_FRAME_SPACE, PDN_MOMENT_3, &
            pdn_harmonics_signal(0.0_dp, 0.0_dp, [0.6_dp], [0.0_dp]))
        call pdn_init(options)
        options%grid_points = 31
        call model%solve_periodic(period, solution, options)
        call check(solution%converged(), 'converged')
        call solution%outcome(outcome)
        call check(outcome == PDN_CONVERGED, 'outcome')
        call check(index(solution%report(), 'converged') > 0, 'report')
        call solution%diagnostics(figures)
        call check(figures%grid_points == 31, 'grid points')
        call solution%history(residuals, increments, steps)
        call check(size(residuals) == figures%iterations .and. size(increments) == size(steps), &
            'history')
        call check(increments(size(increments)) < 1e-9_dp, 'last increment')
        call solution%history(increments=steps)
        call check(all(steps == increments), 'one of three that is wanted')
        call solution%decay(amplitudes)
        call check(size(amplitudes) == 16, 'decay')
        call solution%grid_times(times)
        call near(times(2), period/31, 1e-15_dp, 'grid times')

        call solution%sample(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
            times, angle)
        call solution%sample(pdn_quantity_of(PDN_JOINT_RATE, hinge, PDN_ROTATION), &
            times, rate)
        call solution%sample(pdn_quantity_of(PDN_JOINT_ACCELERATION, hinge, &
            PDN_ROTATION), times, acceleration)
        call solution%sample(pdn_quantity_of(PDN_JOINT_REACTION, hinge, &
            frame=PDN_FRAME_FIRST), times, reaction)
        call solution%sample(pdn_quantity_of(PDN_NODE_POSITION, body), times, position)
        call solution%sample(pdn_quantity_of(PDN_NODE_ROTATION, body), times, rotation)
        call solution%sample(pdn_quantity_of(PDN_NODE_QUATERNION, body), times, quaternion)
        call solution%sample(pdn_quantity_of(PDN_NODE_VELOCITY, body), times, velocity)
        call solution%sample(pdn_quantity_of(PDN_NODE_ACCELERATION, body, &
            frame=PDN_FRAME_MATERIAL), times, turning)
        call solution%sample(pdn_quantity_of(PDN_FORCE_EFFORT, spring), times, effort)
        call solution%sample(pdn_quantity_of(PDN_FORCE_ON_NODE, spring, node=body), &
            times, on_body)
        factors = oscillator_angle(3.0_dp, 0.2_dp)
        do k = 1, size(times)
            expected = dot_product(factors, [cos(omega*times(k)), sin(omega*times(k))])
            slope = omega*dot_product(factors, [-sin(omega*times(k)), cos(omega*times(k))])
            call near(angle(k), expected, 1e-12_dp, 'angle')
            call near(rate(k), slope, 1e-12_dp, 'rate')
            call near(acceleration(k), -omega**2*expected, 1e-11_dp, 'acceleration')
            call near(reaction(1, k), 0.0_dp, 1e-11_dp, 'reaction')
            call near(position(1, k), 0.0_dp, 1e-12_dp, 'position')
            call near(rotation(2, k), sin(expected), 1e-12_dp, 'rotation')
            call near(quaternion(4, k), sin(expected/2), 1e-12_dp, 'quaternion')
            call near(velocity(6, k), slope, 1e-12_dp, 'velocity')
            call near(turning(6, k), acceleration(k), 1e-11_dp, 'turning')
            call near(effort(k), 3*expected + 0.2_dp*slope, 1e-11_dp, 'effort')
            call near(on_body(6, k), -effort(k), 1e-11_dp, 'on body')
        end do

        call solution%harmonics(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
            mean, growth, cosines, sines)
        call near(mean(1), 0.0_dp, 1e-12_dp, 'mean')
        call near(growth(1), 0.0_dp, 1e-12_dp, 'growth')
        call near(cosines(1, 1), factors(1), 1e-12_dp, 'cosine')
        call near(sines(1, 1), factors(2), 1e-12_dp, 'sine')
        call near(cosines(1, 2), 0.0_dp, 1e-12_dp, 'second cosine')
        call solution%harmonics(pdn_quantity_of(PDN_FORCE_EFFORT, spring), mean, &
            cosines=cosines, sines=sines)
        call near(cosines(1, 1), 3*factors(1) + 0.2_dp*omega*factors(2), 1e-11_dp, &
            'cosine of effort')
        call solution%harmonics(pdn_quantity_of(PDN_NODE_VELOCITY, body), mean6, &
            cosines=cosines6, sines=sines6)
        call near(cosines6(6, 1), omega*factors(2), 1e-12_dp, 'cosine of velocity')

        ! From the solution on another grid, and from its motions: one iteration each.
        options%grid_points = 33
        call model%solve_periodic(period, again, options, initial=solution)
        call again%diagnostics(figures)
        call check(figures%iterations == 1 .and. figures%grid_points == 33, 'from a solution')
        options%grid_points = 31
        call model%solve_periodic(period, again, options, &
            guess_positions=reshape(position, [3, 31, 1]), &
            guess_rotations=reshape(rotation, [9, 31, 1]))
        call again%diagnostics(figures)
        call check(figures%iterations == 1, 'from a guess')

        ! Seen through a filter.
        call solution%filtered(PDN_FILTER_EXPONENTIAL, 2, again)
        call solution%sample(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
            [0.0_dp], plain)
        call again%sample(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
            [0.0_dp], smooth)
        call near(smooth(1), plain(1)*exp(-36.0_dp/16**2), 1e-12_dp, 'filtered')

        ! On grids that the library chooses.
        call pdn_init(options)
        options%error_tolerance = 1e-9_dp
        call model%solve_periodic(period, again, options)
        call again%diagnostics(figures)
        call check(figures%error_estimate <= 1e-9_dp .and. figures%grids > 0, 'adaptive')
        call check(figures%outcome == PDN_CONVERGED .and. figures%decay /= PDN_DECAY_SLOW, &
            'fast decay')
    end subroutine solution_of_oscillator

    ! A motion about axis 3 with angle 0.4 cos(omega t), and its derivatives.
    subroutine motions()
        integer, parameter :: n = 21
        real(dp) :: positions(3, n), rotations(9, n), a, position(3, 2), rotation(9, 2), &
            velocity(6, 2)
        real(dp) :: acceleration(6, 2), at_grid(6, n)
        real(dp), allocatable :: linear(:, :)
        integer :: k

        allocate (linear(6*n, 6*n))
        linear = 0
        do k = 1, n
            a = 0.4_dp*cos(2*pi*(k - 1)/n)
            positions(:, k) = [cos(a), sin(a), 0.0_dp]
            rotations(:, k) = [cos(a), sin(a), 0.0_dp, -sin(a), cos(a), 0.0_dp, 0.0_dp, 0.0_dp, &
                1.0_dp]
        end do
        call pdn_motion_interpolate(period, positions, rotations, [0.3_dp, 7.7_dp], position, &
            rotation, velocity, acceleration)
        call near(position(2, 1), sin(0.4_dp*cos(omega*0.3_dp)), 1e-12_dp, 'interpolated position')
        call near(rotation(1, 2), cos(0.4_dp*cos(omega*7.7_dp)), 1e-12_dp, 'interpolated rotation')
        call near(velocity(6, 1), -0.4_dp*omega*sin(omega*0.3_dp), 1e-11_dp, &
            'interpolated velocity')
        call near(acceleration(6, 1), -0.4_dp*omega**2*cos(omega*0.3_dp), 1e-10_dp, &
            'interpolated acceleration')
        call pdn_motion_grid_kinematics(period, positions, rotations, acceleration=at_grid, &
            velocity_tangent=linear)
        call near(at_grid(6, 1), -0.4_dp*omega**2, 1e-10_dp, 'acceleration at the grid')
        call check(any(linear /= 0), 'tangent')
    end subroutine motions

    ! A cantilever of varying section: elongation by a force at its end; and access to beams.
    subroutine beams()
        type(pdn_model) :: model
        type(pdn_solution) :: solution, again
        type(pdn_static_options) :: options
        type(pdn_section) :: thin, thick, initialised
        type(pdn_beam) :: beam, curve
        type(pdn_frame) :: middle, same
        type(pdn_signal) :: load(12)
        integer :: root, element, first, second, elements, frame, places, id, i
        real(dp) :: position(3, 1), strain(6, 1), force(6, 2), mean(6), told(3)

        thin = steel()
        thick = steel()
        thick%stiffness = 2*thick%stiffness
        call model%new()
        call model%add_beam(pdn_straight_line(origin, 2*axis_1, axis_2), &
            [thick, thick, thin, thin], 4, 2, beam, fractions=[0.0_dp, 0.5_dp, 0.5_dp, 1.0_dp])
        call model%add_node(origin, identity, root)
        call model%add_rigid_joint(PDN_GROUND, root, origin)
        call model%add_rigid_joint(root, beam%first, origin)
        call model%add_load(beam%last, PDN_FRAME_MATERIAL, PDN_FORCE_1, &
            pdn_constant_signal(530.0_dp))
        call model%solve_static(solution)
        call check(solution%converged(), 'static')
        ! 530 / (2 EA) + 530 / EA, each over 1
        call solution%sample(pdn_quantity_of(PDN_NODE_POSITION, beam%last), [0.0_dp], position)
        call near(position(1, 1) - 2, 1.5e-5_dp, 1e-12_dp, 'elongation')
        call solution%sample(pdn_quantity_of(PDN_BEAM_STRAIN, beam%first_element), [0.0_dp], &
            strain)
        call near(strain(1, 1), 5e-6_dp, 1e-12_dp, 'strain')
        call solution%sample(pdn_quantity_of(PDN_BEAM_FORCE, beam%first_element + 3, &
            station=0.3_dp), [0.1_dp, 0.2_dp], force)
        call near(force(1, 2), 530.0_dp, 1e-5_dp, 'force')
        call solution%harmonics(pdn_quantity_of(PDN_BEAM_FORCE, beam%first_element, &
            station=1.0_dp), mean)
        call near(mean(1), 530.0_dp, 1e-5_dp, 'mean force')
        call pdn_init(options)
        options%load_steps = 3
        call model%solve_static(again, options, initial=solution)
        call check(again%converged(), 'static from a solution')

        call pdn_init(initialised)
        call check(initialised%struct_size == c_sizeof(initialised) .and. &
            all(initialised%stiffness >= 0), 'section')
        thin = pdn_diagonal_section([1e7_dp, 1e7_dp, 1e7_dp, 1e3_dp, 1e3_dp, 1e3_dp], &
            [2.0_dp, 1e-4_dp, 1e-4_dp, 1e-4_dp])
        call pdn_section_set_component_damping(thin, spread(1e-4_dp, 1, 6))
        call near(thin%damping(8), 1e3_dp, 1e-9_dp, 'damping of components')
        call pdn_section_set_proportional_damping(thin, 1e-4_dp)
        call near(thin%damping(1), 1e3_dp, 1e-9_dp, 'damping')
        call model%new()
        call model%add_beam(pdn_arc_line(axis_1, [sqrt(0.5_dp), sqrt(0.5_dp), 0.0_dp], axis_2, &
            axis_3), [thin, thin], 3, 3, beam, fractions=[0.0_dp, 1.0_dp], twists=[0.0_dp, 0.1_dp])
        call model%add_beam(pdn_curve_line(quarter), [thin], 3, 3, curve)
        call model%node_frame((beam%first + beam%last)/2, middle)
        call model%node_frame((curve%first + curve%last)/2, same)
        call near(middle%position(1), same%position(1), 1e-12_dp, 'curve')
        call near(middle%rotation(1), same%rotation(1), 1e-10_dp, 'axis along the curve')
        call model%add_node([0.0_dp, 0.0_dp, 9.0_dp], node=first)
        call model%add_node([1.0_dp, 0.0_dp, 9.0_dp], node=second)
        call model%add_beam_element([first, second], thin, element)
        call model%element_count(elements)
        call check(element == PDN_FIRST_BEAM_ELEMENT + 6 .and. elements == 7, 'elements')
        call model%add_straight_beam(3*axis_1, 4*axis_1, axis_2, thin, 2, 1, beam)
        call check(beam%elements == 2, 'straight beam')
        call model%add_distributed_load(curve%first_element, curve%elements, PDN_FRAME_SPACE, &
            PDN_FORCE_3, pdn_constant_signal(2.0_dp), [0.0_dp, 1.0_dp], [1.0_dp, 2.0_dp])
        call model%add_distributed_load(curve%first_element, 1, PDN_FRAME_MATERIAL, PDN_MOMENT_1, &
            pdn_samples_signal([0.0_dp, 1.0_dp, 2.0_dp]))
        do i = 1, 12
            load(i) = pdn_constant_signal(real(i, dp))
        end do
        call model%add_load_at_places(curve%first_element, curve%elements, PDN_FRAME_UNTWISTED, &
            [0.0_dp, 1.0_dp], reshape(load, [6, 2]), axis_3, id)
        call check(id == PDN_FIRST_BEAM_LOAD + 2, 'loads at places')
        call model%beam_load(PDN_FIRST_BEAM_LOAD, element, elements, frame, places)
        call check(element == curve%first_element .and. frame == PDN_FRAME_SPACE .and. &
            places == 2, 'beam load')
        call model%beam_load(id, element, elements, frame, places, told)
        call check(frame == PDN_FRAME_UNTWISTED .and. all(told == axis_3), 'untwisted')
        call model%beam_load_factor(PDN_FIRST_BEAM_LOAD, 1, told(1), told(2))
        call check(all(told(:2) == [1.0_dp, 2.0_dp]), 'factor')
    end subroutine beams

    ! All joints and forces can be made, and are counted.
    subroutine everything()
        type(pdn_model) :: m, rotor
        type(pdn_summary) :: summary
        type(pdn_joint_info) :: pair
        type(pdn_force_info) :: force
        type(pdn_tangent_check) :: tangents
        type(pdn_conditions) :: phases
        real(dp) :: unit(6, 6), mass, centre(3), number, axis(3), point(3)
        integer :: a, b, id, joints, forces, nodes, blades, of_blade, of_hub, i

        unit = 0
        do i = 1, 6
            unit(i, i) = 1
        end do
        call m%new()
        call m%add_rigid_body(1.0_dp, origin, identity, a)
        call m%add_rigid_body(2.0_dp, 3*axis_1, identity, b)
        call m%add_mass(a, 1.0_dp, axis_1)
        call m%add_mass(a, 1.0_dp, axis_1, identity, id)
        call check(id == PDN_FIRST_INERTIA + 3, 'mass')
        call m%add_inertia(b, unit)
        call m%add_inertia(b, unit, frame_at(origin), id)
        call check(id == PDN_FIRST_INERTIA + 5, 'inertia')
        call m%add_prismatic(PDN_GROUND, a, origin, axis_3)
        call m%add_cylindrical(a, b, origin, axis_3)
        call m%add_screw(a, b, origin, axis_3, 0.1_dp)
        call m%add_planar(a, b, origin, axis_3)
        call m%add_spherical(a, b, origin)
        call m%add_universal(a, b, origin, axis_1, axis_2)
        call m%add_free_joint(a, b, origin)
        call m%add_strut(a, b, origin, axis_1)
        call m%add_revolute(a, b, origin, axis_2)
        call m%add_joint(PDN_JOINT_SPHERICAL, a, b, frame_at(origin), frame_at(axis_1))
        call m%add_screw_between(a, b, frame_at(origin), frame_at(origin), -0.2_dp, id)
        call m%joint_count(joints)
        call check(id == PDN_FIRST_JOINT + 10 .and. joints == 11, 'joints')
        call m%prescribe(PDN_FIRST_JOINT, PDN_DISPLACEMENT, pdn_constant_signal(0.1_dp), id)
        call check(id == PDN_FIRST_PRESCRIBED, 'prescribed')
        call m%set_gravity([0.0_dp, 0.0_dp, -9.81_dp])
        call m%set_gravity_signals(pdn_constant_signal(0.0_dp), pdn_constant_signal(0.0_dp), &
            pdn_constant_signal(-9.81_dp))
        call m%set_turning_frame([0.0_dp, 0.0_dp, 2.0_dp], 1.5_dp)
        axis = 0
        point = 1
        call m%turning_frame(axis, number, point)
        call check(number == 1.5_dp .and. axis(3) == 1 .and. maxval(abs(point)) == 0, 'frame')
        call m%set_frame_advance(0.5_dp)
        call m%frame_advance(number)
        call check(number == 0.5_dp, 'advance')
        call rotor%new()
        do i = 1, 4
            call rotor%add_node(i*axis_1)
        end do
        call rotor%set_rotor_symmetry([0.0_dp, 0.0_dp, 2.0_dp], 3, &
            PDN_FIRST_NODE + [0, 1, 2], PDN_FIRST_NODE + [3], axis)
        call rotor%rotor_symmetry(axis, point, blades, of_blade, of_hub)
        call rotor%rotor_node(-1, 0, id)
        call check(blades == 3 .and. of_blade == 1 .and. of_hub == 1 .and. &
            id == PDN_FIRST_NODE + 3, 'rotor')
        call phases%new()
        call phases%add_rotation_phase(axis)
        call phases%add_translation_phase(axis)
        call phases%add_momentum(axis, 2.0_dp)
        call phases%add_angular_momentum(axis, 2.0_dp)
        call m%add_spring_damper(PDN_FIRST_JOINT + 6, PDN_DISPLACEMENT_2, 1.0_dp, 0.0_dp, 0.0_dp)
        call m%add_nonlinear_spring_damper(PDN_FIRST_JOINT + 6, PDN_DISPLACEMENT_3, &
            [1.0_dp, 0.0_dp, 2.0_dp], [0.1_dp], 0.0_dp)
        call m%add_actuator(PDN_FIRST_JOINT + 6, PDN_ROTATION_2, pdn_constant_signal(0.5_dp))
        call m%add_viscoelastic(PDN_FIRST_JOINT + 6, PDN_ROTATION_3, 1.0_dp, 0.0_dp, &
            [2.0_dp, 3.0_dp], [0.1_dp, 0.2_dp])
        call m%add_viscous_damper(a, b, unit)
        call m%add_viscous_damper(PDN_GROUND, b, unit, frame_at(origin), id)
        call m%force_count(forces)
        call check(id == PDN_FIRST_FORCE + 5 .and. forces == 6, 'forces')
        call m%add_bushing(a, b, frame_at(origin), frame_at(axis_1), unit, unit, &
            PDN_ANGLES_ROTATION_VECTOR, id)
        call check(id == PDN_FIRST_FORCE + 6, 'bushing')
        call m%add_controller(PDN_FIRST_JOINT + [6], [PDN_ROTATION_2], PDN_TANGENTS_GIVEN, govern, &
            PDN_FIRST_JOINT + [6, 8], [PDN_ROTATION_2, PDN_ROTATION], [0.5_dp], [2.0_dp], force=id)
        call check(id == PDN_FIRST_FORCE + 7, 'controller')
        call m%controller_counts(id, forces, state_count=nodes)
        call check(forces == 2 .and. nodes == 1, 'controller counts')
        call m%controller_coordinate(PDN_FIRST_FORCE + 7, 1, id, nodes)
        call check(id == PDN_FIRST_JOINT + 8 .and. nodes == PDN_ROTATION, 'controller reads')
        call m%controller_state(PDN_FIRST_FORCE + 7, 0, size=number)
        call near(number, 2.0_dp, 0.0_dp, 'controller state')
        call m%check_tangents(PDN_FIRST_FORCE + 7, 2.0_dp, tangents)
        call check(tangents%error < 1e-7_dp, 'controller tangents')
        call m%bind_controller(PDN_FIRST_FORCE + 7, PDN_TANGENTS_DIFFERENCED, govern)
        call m%add_relation(PDN_FIRST_JOINT + [6, 8], [PDN_ROTATION_2, PDN_ROTATION], &
            [1.0_dp, -2.0_dp], relation=id)
        call check(id == PDN_FIRST_RELATION, 'relation')
        call m%add_relation(PDN_FIRST_JOINT + [6, 8], [PDN_ROTATION_3, PDN_ROTATION], &
            [1.0_dp, 3.0_dp], pdn_constant_signal(0.5_dp))
        call m%relation_count(forces)
        call check(forces == 2, 'relations')
        call m%set_label(PDN_FIRST_JOINT + 8, 'shaft')
        call check(m%label(PDN_FIRST_JOINT + 8) == 'shaft', 'label')
        call m%find_label(PDN_OBJECT_JOINT, 'shaft', id)
        call check(id == PDN_FIRST_JOINT + 8, 'labelled')
        call m%joint(PDN_FIRST_JOINT + 9, pair)
        call check(pair%kind == PDN_JOINT_SPHERICAL .and. pair%first == a, 'joint')
        call m%force(PDN_FIRST_FORCE + 1, force)
        call check(force%stiffness_count == 3, 'force')
        call m%force_number(PDN_FIRST_FORCE + 1, PDN_NUMBER_STIFFNESS, 2, number)
        call near(number, 2.0_dp, 0.0_dp, 'number')
        call m%relation_term(PDN_FIRST_RELATION, 1, id, nodes, number)
        call check(id == PDN_FIRST_JOINT + 8 .and. nodes == PDN_ROTATION, 'term')
        call m%prescribed(PDN_FIRST_PRESCRIBED, id, nodes)
        call check(id == PDN_FIRST_JOINT .and. nodes == PDN_DISPLACEMENT, 'prescribed')
        call m%inertia_count(nodes)
        call m%inertia(PDN_FIRST_INERTIA, id, unit)
        call check(id == a .and. nodes > 2, 'inertia')
        call m%inertia_of(b, id)
        call check(id == PDN_FIRST_INERTIA + 1, 'inertia of a node')
        call m%set_spin(id, [0.0_dp, 3.0_dp, 0.0_dp], 2.5_dp)
        call m%spin(id, axis, number)
        call check(number == 2.5_dp .and. axis(2) == 1, 'spin')
        call m%sample_signal(PDN_GRAVITY, 2, 1.0_dp, [0.0_dp, 0.3_dp], centre(:2))
        call near(centre(2), -9.81_dp, 1e-14_dp, 'signal')
        call m%add_parameter('speed', 3.0_dp, 2.0_dp, id)
        call m%parameter(id, number)
        call check(m%parameter_name(id) == 'speed' .and. number == 3, 'parameter')
        call m%find_parameter('speed', nodes)
        call check(nodes == id, 'name of a parameter')
        call m%shell_load_count(nodes)
        call check(nodes == 0, 'shell loads')
        call m%node_count(nodes)
        call check(nodes == 2, 'nodes')
        call m%mass(mass, centre)
        call near(mass, 7.0_dp, 1e-15_dp, 'mass')
        call m%summary(summary)
        call check(summary%nodes == 2 .and. summary%joints == joints .and. summary%prescribed == &
            1, 'summary')
        call check(index(m%describe(), 'mass') > 0, 'description')
    end subroutine everything

    ! The internal states of a Maxwell branch: those of its closed form.
    subroutine viscoelastic()
        type(pdn_model) :: model
        type(pdn_solution) :: solution
        type(pdn_periodic_options) :: options
        integer :: body, hinge, spring, branch
        real(dp) :: wt, storage, loss, factors(2), effort(1), found(1)

        call oscillator(model, body, hinge, spring)
        call model%add_viscoelastic(hinge, PDN_ROTATION, 0.0_dp, 0.0_dp, [2.0_dp], [0.4_dp], branch)
        call model%add_load(body, PDN_FRAME_SPACE, PDN_MOMENT_3, pdn_samples_signal(&
            0.6_dp*[1.0_dp, cos(2*pi/3), cos(4*pi/3)]))
        call pdn_init(options)
        options%grid_points = 31
        call model%solve_periodic(period, solution, options)
        wt = omega*0.4_dp
        storage = 2*wt**2/(1 + wt**2)
        loss = 2*wt/(1 + wt**2)
        factors = oscillator_angle(3 + storage, 0.2_dp + loss/omega)
        call solution%sample(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
            [0.0_dp], found)
        call near(found(1), factors(1), 1e-12_dp, 'angle')
        call solution%sample(pdn_quantity_of(PDN_FORCE_BRANCH_EFFORT, branch), [0.0_dp], effort)
        call near(effort(1), dot_product([storage, loss], factors), 1e-12_dp, &
            'effort of the branch')
        call solution%sample(pdn_quantity_of(PDN_FORCE_BRANCH_ELONGATION, branch), [0.0_dp], &
            found)
        call near(found(1), factors(1) - effort(1)/2, 1e-12_dp, 'elongation of the dashpot')
    end subroutine viscoelastic

    ! Variables share what they are assigned, and free it once.
    subroutine handles()
        type(pdn_model) :: model, same
        type(pdn_solution) :: solution
        type(pdn_periodic_options) :: options
        integer :: body, hinge, spring, nodes
        real(dp) :: effort(1)

        call oscillator(model, body, hinge, spring)
        call model%prescribe(hinge, PDN_ROTATION, pdn_harmonics_signal(0.0_dp, 0.0_dp, [0.1_dp], &
            [0.0_dp]))
        same = model
        call model%add_node(origin)
        call same%node_count(nodes)
        call check(nodes == 2 .and. c_associated(model%handle(), same%handle()), 'shared')
        call model%new()
        call model%node_count(nodes)
        call check(nodes == 0, 'another')
        model = model
        model = same
        call same%free()
        call same%free()
        call check(.not. c_associated(same%handle()), 'freed')
        call model%node_count(nodes)
        call check(nodes == 2, 'kept')
        call model%add_mass(PDN_FIRST_NODE + 1, 1.0_dp, origin)
        call model%add_rigid_joint(PDN_GROUND, PDN_FIRST_NODE + 1, origin)
        call pdn_init(options)
        options%grid_points = 31
        call model%solve_periodic(period, solution, options)
        call model%free()
        call solution%sample(pdn_quantity_of(PDN_JOINT_DRIVING_EFFORT, hinge, PDN_ROTATION), &
            [0.0_dp], effort)
        call near(effort(1), 0.1_dp*(3 - 0.5_dp*omega**2), 1e-11_dp, 'driving effort')
    end subroutine handles
end program test_model
