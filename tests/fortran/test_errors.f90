! What is refused gives stat and errmsg, and leaves outputs and models as they were.
program test_errors
    use checks
    implicit none

    integer :: stat = 77
    character(300) :: errmsg = 'none'
    real(dp) :: nan

    nan = not_a_number()
    call sections_lines_signals()
    call models()
    call joints_and_beams()
    call forces()
    call solves()
    call solutions()
    call motions()
    call nothing_there()
    print '(i0, a)', refusals, ' refusals'

contains

    subroutine sections_lines_signals()
        type(pdn_section) :: section
        type(pdn_line) :: line
        type(pdn_signal) :: signal
        real(dp), parameter :: ones(6) = 1, none(0) = [real(dp) ::]
        character(20) :: short
        integer :: k

        section = pdn_diagonal_section(-ones, ones(:4), stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'stiffness[0]: ')
        section = pdn_diagonal_section(ones, [nan, ones(:3)], stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'mass[0]: ')
        section = steel()
        call pdn_section_set_proportional_damping(section, -1.0_dp, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'seconds: ')
        line = pdn_straight_line(origin, nan*axis_1, axis_2, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'end[0]: ')
        line = pdn_arc_line(origin, nan*axis_1, axis_1, axis_2, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'point[0]: ')
        signal = pdn_constant_signal(nan, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'value: ')
        signal = pdn_harmonics_signal(0.0_dp, nan, ones, ones, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'rate: ')
        signal = pdn_harmonics_signal(0.0_dp, 0.0_dp, ones, ones(:2), stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'sines: expected the shape 6, got 2')
        signal = pdn_samples_signal(none, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'count: ')
        signal = pdn_samples_signal([1.0_dp, nan], stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'samples[1]: ')

        ! errmsg is cut or padded; stat is zero after success.
        signal = pdn_constant_signal(nan, stat, short)
        call check(short == 'value: expected a fi', 'short errmsg')
        short = 'untouched'
        signal = pdn_constant_signal(1.0_dp, stat, short)
        call check(stat == PDN_OK .and. short == 'untouched', 'success')
        do k = 1, 3
            signal = pdn_constant_signal(1.0_dp)
        end do
    end subroutine sections_lines_signals

    subroutine models()
        type(pdn_model) :: m, empty
        type(pdn_frame) :: frame
        type(pdn_summary) :: summary
        integer :: body, hinge, spring, id, nodes
        real(dp) :: mass, centre(3), unit(6, 6)

        call oscillator(m, body, hinge, spring)
        unit = 0
        unit(1, 1) = -1
        id = 55
        mass = 4
        call empty%new()
        call empty%mass(mass, centre, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_AVAILABLE, 'centre: ')
        call empty%summary(summary, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_MODEL, 'model: ')
        call check(mass == 4 .and. len(empty%describe()) == 0 .and. &
            index(pdn_last_error(), 'model: ') == 1, 'outputs as they were')
        call m%node_frame(7, frame, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'node: ')
        call m%add_node([0.0_dp, nan, 0.0_dp], node=id, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'position[1]: ')
        call m%add_node(origin, 2*identity, id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'rotation: ')
        call m%add_rigid_body(0.0_dp, origin, identity, id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'mass: ')
        call m%add_mass(9, 1.0_dp, origin, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'node: ')
        call m%add_inertia(body, unit, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'matrix: ')
        call m%add_inertia(body, unit, frame_at(nan*axis_1), stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'frame position[0]: ')
        call m%add_load(body, 2, PDN_FORCE_1, pdn_constant_signal(1.0_dp), stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'frame: ')
        call m%add_load(4, PDN_FRAME_SPACE, PDN_FORCE_1, pdn_constant_signal(1.0_dp), stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'node: ')
        call m%set_gravity([0.0_dp, 0.0_dp, nan], stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'acceleration[2]: ')
        call m%node_count(nodes)
        call check(id == 55 .and. nodes == 1, 'nothing changed')
    end subroutine models

    subroutine joints_and_beams()
        type(pdn_model) :: m
        type(pdn_beam) :: beam
        type(pdn_section) :: unset
        integer :: body, hinge, spring, id, joints, elements

        call oscillator(m, body, hinge, spring)
        id = 55
        call m%add_rigid_joint(PDN_GROUND, 3, origin, id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'second: ')
        call m%add_revolute(PDN_GROUND, body, origin, origin, id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'axis: ')
        call m%add_prismatic(body, body, origin, axis_1, id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'first, second: ')
        call m%add_cylindrical(5, body, origin, axis_1, id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'first: ')
        call m%add_screw(PDN_GROUND, body, origin, axis_1, 0.0_dp, id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'pitch: ')
        call m%add_planar(PDN_GROUND, body, origin, origin, id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'normal: ')
        call m%add_spherical(PDN_GROUND, body, nan*axis_1, id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'point[0]: ')
        call m%add_universal(PDN_GROUND, body, origin, axis_1, axis_1, id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'first_arm, second_arm: ')
        call m%add_free_joint(PDN_GROUND, -2, origin, id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'second: ')
        call m%add_strut(PDN_GROUND, body, origin, origin, id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'second_point: ')
        call m%add_joint(-1, PDN_GROUND, body, frame_at(origin), frame_at(origin), id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'kind: ')
        call m%add_screw_between(PDN_GROUND, body, frame_at(origin), frame_at(origin), nan, id, &
            stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'pitch: ')
        call m%prescribe(hinge, PDN_DISPLACEMENT, pdn_constant_signal(0.0_dp), stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_AVAILABLE, 'coordinate: ')

        call m%add_beam_element([body], steel(), id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'count: ')
        call m%add_straight_beam(origin, origin, axis_2, steel(), 1, 1, beam, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'end: ')
        call m%add_straight_beam(origin, axis_1, axis_2, steel(), -4, 1, beam, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'elements: ')
        call m%add_straight_beam(origin, axis_1, axis_2, unset, 1, 1, beam, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_STRUCT_SIZE, 'section')
        call m%add_beam(pdn_straight_line(origin, axis_1, axis_2), [steel(), steel()], 1, 1, beam, &
            [0.0_dp], stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'fractions: expected the shape 2, got 1')
        call m%add_beam(pdn_straight_line(origin, axis_1, axis_2), [steel()], 1, 1, beam, &
            twists=[0.0_dp, 1.0_dp], stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'twists: ')
        call m%add_beam(pdn_straight_line(origin, axis_1, axis_1), [steel()], 1, 1, beam, &
            stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'line')
        call m%add_distributed_load(0, 1, PDN_FRAME_SPACE, PDN_FORCE_1, &
            pdn_constant_signal(1.0_dp), stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'first_element: ')
        call m%add_distributed_load(0, 1, PDN_FRAME_SPACE, PDN_FORCE_1, &
            pdn_constant_signal(1.0_dp), [0.0_dp, 1.0_dp], [1.0_dp], stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'factors: ')
        call m%add_load_at_places(0, 1, PDN_FRAME_SPACE, [0.0_dp, 1.0_dp], &
            reshape([pdn_constant_signal(1.0_dp)], [1, 1]), stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'signals: expected the shape')
        call m%joint_count(joints)
        call m%element_count(elements)
        call check(id == 55 .and. joints == 1 .and. elements == 0, 'nothing changed')
    end subroutine joints_and_beams

    subroutine forces()
        type(pdn_model) :: m
        type(pdn_tangent_check) :: tangents
        integer :: body, hinge, spring, id, count
        real(dp) :: unit(6, 6)

        call oscillator(m, body, hinge, spring)
        id = 55
        unit = 0
        unit(1, 1) = -1
        call m%add_spring_damper(5, PDN_ROTATION, 1.0_dp, 0.0_dp, 0.0_dp, id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'joint: ')
        call m%add_nonlinear_spring_damper(hinge, PDN_ROTATION, [nan], [1.0_dp], 0.0_dp, id, &
            stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'stiffness: ')
        call m%add_actuator(hinge, PDN_DISPLACEMENT, pdn_constant_signal(1.0_dp), id, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_AVAILABLE, 'coordinate: ')
        call m%add_viscoelastic(hinge, PDN_ROTATION, 1.0_dp, 0.0_dp, [1.0_dp], [-1.0_dp], id, &
            stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'relaxation_times[0]: ')
        call m%add_viscoelastic(hinge, PDN_ROTATION, 1.0_dp, 0.0_dp, [1.0_dp], unit(:2, 1), id, &
            stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'relaxation_times: ')
        call m%add_relation([0, 1], [PDN_ROTATION], [1.0_dp, 2.0_dp], stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'coordinates: ')
        call m%add_viscous_damper(PDN_GROUND, body, unit, force=id, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'matrix: ')
        call m%check_tangents(spring, 1.0_dp, tangents, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_AVAILABLE, 'force 0: ')
        call m%check_tangents(6, 1.0_dp, tangents, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'force: ')
        call m%force_count(count)
        call check(id == 55 .and. count == 1, 'nothing changed')
    end subroutine forces

    subroutine solves()
        type(pdn_model) :: m, empty
        type(pdn_solution) :: solution
        type(pdn_periodic_options) :: options, unset
        type(pdn_static_options) :: at_rest, unset_static
        real(dp) :: guess(3, 31, 2)
        integer :: body, hinge, spring

        call empty%new()
        call oscillator(m, body, hinge, spring)
        guess = 0
        call empty%solve_periodic(1.0_dp, solution, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_MODEL, 'model: ')
        call m%solve_periodic(-1.0_dp, solution, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'period: ')
        call m%solve_periodic(1.0_dp, solution, unset, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_STRUCT_SIZE, 'options')
        call pdn_init(options)
        options%grid_points = 8
        call m%solve_periodic(1.0_dp, solution, options, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'options.grid_points: ')
        call pdn_init(options)
        options%error_tolerance = -1
        call m%solve_periodic(1.0_dp, solution, options, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'options.error_tolerance: ')
        call pdn_init(options)
        options%oversampling = 17
        call m%solve_periodic(1.0_dp, solution, options, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'options.oversampling: ')
        call pdn_init(options)
        options%grid_points = 31
        call m%solve_periodic(1.0_dp, solution, options, guess_positions=guess, stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, &
            'guess_positions: expected the shape 3 x 31 x 1, got 3 x 31 x 2')
        call m%solve_periodic(1.0_dp, solution, options, guess_rotations=guess, stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'guess_rotations: ')
        call m%solve_static(solution, unset_static, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_STRUCT_SIZE, 'options')
        call pdn_init(at_rest)
        at_rest%load_steps = 0
        call m%solve_static(solution, at_rest, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'options.load_steps: ')
        call m%prescribe(hinge, PDN_ROTATION, &
            pdn_harmonics_signal(0.0_dp, 1.0_dp, guess(:1, 1, 1), guess(:1, 1, 1)))
        call m%solve_periodic(1.0_dp, solution, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_PERIODIC, '')
        call check(.not. c_associated(solution%handle()), 'no solution')
    end subroutine solves

    subroutine solutions()
        type(pdn_model) :: m
        type(pdn_solution) :: s, filtered
        integer :: body, hinge, spring
        real(dp) :: zero(1), one(1), three(3, 1), four(4, 1), six(6, 1), nine(9, 1)
        real(dp) :: mean(3), many(3, 16), mean1(1), many1(1, 16), mean6(6), many6(6, 2)

        call oscillator(m, body, hinge, spring)
        call m%solve_periodic(period, s)
        call s%filtered(PDN_FILTER_LANCZOS, 33, filtered, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'order: ')
        zero = 0
        one = 8
        three = 8
        call s%sample(pdn_quantity_of(PDN_NODE_POSITION, 1), zero, three, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'quantity.object: ')
        call s%sample(pdn_quantity_of(PDN_NODE_POSITION, body), zero, four, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'out: expected the shape 3 x 1, got 4 x 1')
        call s%sample(pdn_quantity_of(PDN_NODE_ROTATION, -1), zero, nine, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'quantity.object: ')
        call s%sample(pdn_quantity_of(PDN_NODE_QUATERNION, body), nan + zero, four, stat, &
            errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'times: ')
        call s%sample(pdn_quantity_of(PDN_NODE_VELOCITY, body, frame=5), zero, six, stat, &
            errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'quantity.frame: ')
        call s%sample(pdn_quantity_of(PDN_NODE_ACCELERATION, body), zero, nine, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'out: ')
        call s%sample(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_DISPLACEMENT), zero, &
            one, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_AVAILABLE, 'coordinate: ')
        call s%sample(pdn_quantity_of(PDN_JOINT_RATE, 2, PDN_ROTATION), zero, one, &
            stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'quantity.object: ')
        call s%sample(pdn_quantity_of(PDN_JOINT_ACCELERATION, hinge, 9), zero, &
            one, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'quantity.component: ')
        call s%sample(pdn_quantity_of(PDN_JOINT_DRIVING_EFFORT, hinge, PDN_ROTATION), zero, &
            one, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_AVAILABLE, 'coordinate: ')
        call s%sample(pdn_quantity_of(PDN_JOINT_DRIVING_EFFORT, hinge, PDN_ROTATION), zero, &
            mean, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'out: expected the shape 1, got 3')
        call s%sample(pdn_quantity_of(PDN_JOINT_REACTION, hinge, frame=4), zero, six, stat, &
            errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'quantity.frame: ')
        call s%sample(pdn_quantity_of(PDN_BEAM_STRAIN, 0), zero, six, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'quantity.object: ')
        call s%sample(pdn_quantity_of(PDN_BEAM_FORCE, PDN_FIRST_BEAM_ELEMENT, &
            station=2.0_dp), zero, six, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'station: ')
        call s%sample(pdn_quantity_of(PDN_FORCE_EFFORT, 4), zero, one, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'quantity.object: ')
        call s%sample(pdn_quantity_of(PDN_FORCE_BRANCH_EFFORT, spring), zero, one, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_AVAILABLE, 'branch: ')
        call s%sample(pdn_quantity_of(PDN_FORCE_BRANCH_ELONGATION, spring), zero, one, stat, &
            errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_AVAILABLE, 'branch: ')
        call s%sample(pdn_quantity_of(PDN_FORCE_ON_NODE, spring, node=7), zero, six, &
            stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'quantity.node: ')
        call s%harmonics(pdn_quantity_of(PDN_NODE_VELOCITY, body), mean, cosines=many, &
            sines=many, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'mean: expected the shape 6, got 3')
        call s%harmonics(pdn_quantity_of(PDN_NODE_POSITION, body), mean, cosines=many, &
            sines=many1, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'sines: ')
        call s%harmonics(pdn_quantity_of(PDN_JOINT_RATE, hinge, PDN_ROTATION), &
            mean1, mean, many1, many1, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'rate: ')
        call s%harmonics(pdn_quantity_of(50, hinge, PDN_ROTATION), mean6, &
            cosines=many6, sines=many6, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'quantity.kind: ')
        call s%harmonics(pdn_quantity_of(PDN_BEAM_FORCE, 0), mean6, cosines=many6, &
            sines=many6, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'quantity.object: ')
        call s%harmonics(pdn_quantity_of(PDN_FORCE_EFFORT, 9), mean1, &
            cosines=many1(:, :2), sines=many1(:, :2), stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'quantity.object: ')
        call check(all(one == 8) .and. all(three == 8), 'outputs as they were')
    end subroutine solutions

    subroutine motions()
        real(dp) :: positions(3, 2), rotations(9, 2), out(6, 2)

        positions = 0
        rotations = spread(reshape(identity, [9]), 2, 2)
        call pdn_motion_interpolate(1.0_dp, positions, rotations, [0.0_dp], stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'points: ')
        call pdn_motion_interpolate(1.0_dp, positions, rotations(:, :1), [0.0_dp], stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'rotations: ')
        call pdn_motion_interpolate(1.0_dp, positions, rotations, [0.0_dp], velocity=out, &
            stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'velocity: expected the shape 6 x 1, got 6 x 2')
        call pdn_motion_grid_kinematics(0.0_dp, positions(:, :1), rotations(:, :1), stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'period: ')
        call pdn_motion_grid_kinematics(1.0_dp, positions, rotations, acceleration_tangent=out, &
            stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, &
            'acceleration_tangent: expected the shape 12 x 12, got 6 x 2')
    end subroutine motions

    ! Handles that were never made, or were freed.
    subroutine nothing_there()
        type(pdn_model) :: m
        type(pdn_solution) :: s
        integer :: id, outcome
        real(dp), allocatable :: times(:)

        outcome = 55
        call m%add_node(origin, node=id, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NULL, 'model: ')
        call m%new()
        call m%free()
        call m%solve_periodic(1.0_dp, s, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NULL, 'model: ')
        call s%outcome(outcome, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NULL, 'solution: ')
        call s%grid_times(times, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NULL, 'solution: ')
        call check(outcome == 55 .and. .not. allocated(times) .and. .not. s%converged(), &
            'outputs as they were')
        call check(len(s%report()) == 0, 'no report')
    end subroutine nothing_there
end program test_errors
