! Parameters, conditions and branches of the oscillator, by closed forms.
program test_families
    use checks
    implicit none

    call moment_for_a_mean_angle()
    call response_over_frequencies()

contains

    ! The oscillator under the moment 0.6 cos(omega t) about a mean, which a parameter is.
    subroutine driven(model, body, hinge, parameter)
        type(pdn_model), intent(inout) :: model
        integer, intent(out) :: body, hinge, parameter
        integer :: spring, force

        call oscillator(model, body, hinge, spring)
        call model%add_actuator(hinge, PDN_ROTATION, &
            pdn_harmonics_signal(0.0_dp, 0.0_dp, [0.6_dp], [0.0_dp]), force)
        call model%add_parameter('moment', 0.0_dp, 1.0_dp, parameter)
        call model%move_signal(parameter, force, 0, PDN_PART_MEAN, 1.0_dp)
    end subroutine driven

    subroutine moment_for_a_mean_angle()
        type(pdn_model) :: model
        type(pdn_conditions) :: conditions
        type(pdn_sensitivities) :: sensitivities
        type(pdn_quantity) :: angle
        type(pdn_solution) :: solution
        integer :: body, hinge, parameter, stat
        real(dp) :: found, mean(1), derivatives(2, 1)
        character(300) :: errmsg

        call driven(model, body, hinge, parameter)
        call pdn_quantity_init(angle, c_sizeof(angle))
        angle%kind = PDN_JOINT_COORDINATE
        angle%object = hinge
        angle%component = PDN_ROTATION
        call conditions%new()
        call conditions%release(parameter)
        call conditions%add_quantity(angle, PDN_FEATURE_MEAN, 0.0_dp, 0.1_dp)
        call model%solve_conditioned(period, conditions, solution)
        call check(solution%converged(), 'converged')
        call solution%parameter(parameter, found)
        call near(found, 0.3_dp, 1e-10_dp, 'moment')

        ! The same with the parameter given.
        call model%set_parameter(parameter, 0.3_dp)
        call model%solve_periodic(period, solution)
        call solution%harmonics(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
            mean)
        call near(mean(1), 0.1_dp, 1e-10_dp, 'mean angle')

        ! What the mean angle gains from the moment, and the first harmonic does not.
        call sensitivities%new()
        call sensitivities%add_quantity(angle, PDN_FEATURE_MEAN)
        call sensitivities%add_quantity(angle, PDN_FEATURE_COSINE, 1.0_dp)
        call sensitivities%add_parameter(parameter)
        call solution%sensitivities(sensitivities, derivatives)
        call near(derivatives(1, 1), 1 / 3.0_dp, 1e-10_dp, 'mean angle by moment')
        call near(derivatives(2, 1), 0.0_dp, 1e-10_dp, 'cosine by moment')
        stat = 77
        errmsg = 'none'
        call solution%sensitivities(sensitivities, derivatives, conditions, stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'parameters: ')

        stat = 77
        errmsg = 'none'
        call conditions%add_quantity(angle, 7, 0.0_dp, 0.1_dp, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'feature: ')
        call model%set_parameter(9, 1.0_dp, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'parameter: ')
    end subroutine moment_for_a_mean_angle

    subroutine response_over_frequencies()
        type(pdn_model) :: model
        type(pdn_branch) :: branch, more
        type(pdn_branch_options) :: options
        type(pdn_branch_point) :: point
        type(pdn_quantity) :: position
        type(pdn_solution) :: solution
        integer :: body, hinge, parameter, count, end, i, stat
        real(dp) :: cosines(1, 1), sines(1, 1)
        complex(dp) :: stiffness
        character(300) :: errmsg

        call driven(model, body, hinge, parameter)
        call model%solve_frequency_response(1.0_dp, 4.0_dp, branch)
        call branch%end(end)
        call branch%count(count)
        call check(end == PDN_BRANCH_RANGE .and. count > 5, 'range')
        call check(len(branch%report()) > 0, 'report')
        do i = 0, count - 1
            call branch%get(i, point)
            call branch%solution(i, solution)
            call near(point%parameter*point%period, 2*pi, 1e-12_dp, 'period')
            call solution%harmonics(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, &
                PDN_ROTATION), cosines=cosines, sines=sines)
            stiffness = cmplx(3 - 0.5_dp*point%parameter**2, 0.2_dp*point%parameter, dp)
            call near(hypot(cosines(1, 1), sines(1, 1)), 0.6_dp/abs(stiffness), 1e-8_dp, &
                'amplitude')
        end do
        call pdn_quantity_init(position, c_sizeof(position))
        position%kind = PDN_NODE_POSITION
        position%object = body
        call branch%write_csv('test_families.csv', [position])
        stat = 77
        errmsg = 'none'
        position%kind = 99
        call branch%write_csv('test_families.csv', [position], stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'quantities[0]: ')
        call branch%write_campbell('test_families.csv')
        call branch%write_campbell('test_families.csv', blades=[body], stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'blades: ')

        ! Saved, loaded, and followed on.
        call branch%save('test_families.pdb')
        call more%load('test_families.pdb')
        call pdn_init(options)
        options%from = 1
        options%to = 5
        call more%continue_branch(branch, options)
        call branch%end(end)
        call branch%count(i)
        call branch%get(i - 1, point)
        call check(end == PDN_BRANCH_RANGE .and. i > count, 'continued')
        call near(point%parameter, 5.0_dp, 1e-12_dp, 'end')
        call branch%switch_branch(0, 0.1_dp, more, options, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_AVAILABLE, 'point: no other branch begins')
        call branch%follow_locus(0, parameter, more, options, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_AVAILABLE, 'point: nothing happens')
        call more%load('test_families.csv', stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_FORMAT, 'path: ')
        count = i
        call branch%get(count, point, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'point: ')
    end subroutine response_over_frequencies
end program test_families
