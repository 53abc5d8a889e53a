! A march of the oscillator against its free vibration in closed form.
program test_march
    use checks
    implicit none

    call march()

contains

    subroutine march()
        type(pdn_model) :: model, empty
        type(pdn_march_options) :: options, unset
        type(pdn_march_diagnostics) :: figures
        type(pdn_shooting_options) :: shot
        type(pdn_solution) :: free, periodic, steady, shooting, none
        integer :: body, hinge, spring, stat
        character(300) :: errmsg
        real(dp) :: angle(1), position(3, 1), rotation(9, 1), velocity(6, 1), rate
        type(pdn_stability_options) :: asked
        type(pdn_stability) :: stability
        type(pdn_multiplier) :: multiplier
        integer :: outcome, verdict, known, states, steps
        real(dp), allocatable :: re(:), im(:), at(:), mode(:, :), other(:, :)
        real(dp) :: limit
        real(dp), parameter :: t = 1.7_dp

        call oscillator(model, body, hinge, spring)
        call pdn_init(options)
        options%duration = 2
        options%step = 1e-3_dp
        options%spectral_radius = 1
        position = 0
        rotation = reshape(identity, [9, 1])
        velocity = 0
        velocity(6, 1) = 0.3_dp
        call model%solve_march(free, options, positions=position, rotations=rotation, &
            velocities=velocity)
        call check(free%converged(), 'converged')
        call free%march(figures)
        call check(figures%steps == 2000, 'steps')
        call free%sample(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), [t], angle)
        ! Second order: with rate 2.4 and step 1e-3 the error is a few 1e-7.
        rate = sqrt(6 - 0.04_dp)
        call near(angle(1), 0.3_dp/rate*exp(-0.2_dp*t)*sin(rate*t), 1e-6_dp, 'free vibration')

        call model%add_load(body, PDN_FRAME_SPACE, PDN_MOMENT_3, &
            pdn_harmonics_signal(0.0_dp, 0.0_dp, [0.6_dp], [0.0_dp]))
        call model%solve_periodic(period, periodic)
        call pdn_init(options)
        options%period = period
        options%steps_per_period = 200
        options%periodic_tolerance = 1e-2_dp
        call model%solve_march(steady, options, initial=periodic)
        call steady%march(figures)
        call check(steady%converged() .and. figures%periods <= 3, 'periodic')
        call model%solve_periodic(period, periodic, initial=steady)
        call check(periodic%converged(), 'from a march')

        ! By shooting: the free vibration decays by exp(-0.2 T) in a period.
        call pdn_init(shot)
        shot%steps_per_period = 400
        call model%solve_shooting(period, shooting, shot, initial=periodic)
        call check(shooting%converged(), 'shooting')
        call shooting%floquet(re, im)
        call near(hypot(re(1), im(1)), exp(-0.2_dp*period), 1e-3_dp, 'Floquet multiplier')

        ! The same of the periodic solution, to rounding.
        call pdn_init(asked)
        asked%tolerance = 1e-10_dp
        call periodic%solve_stability(stability, asked)
        call stability%outcome(outcome)
        call stability%verdict(verdict, limit)
        call check(outcome == PDN_CONVERGED .and. verdict == PDN_STABLE, 'stable')
        call check(limit > 1e300_dp, 'all known')
        call stability%count(known, states)
        call check(known == 2 .and. states == 2, 'multipliers')
        call stability%get(0, multiplier)
        call near(hypot(multiplier%real, multiplier%imaginary), exp(-0.2_dp*period), 1e-10_dp, &
            'multiplier')
        call stability%times(at)
        call stability%time_count(steps)
        call check(size(at) == steps, 'number of times of modes')
        call near(at(steps), period, 1e-12_dp, 'times of modes')
        call stability%shape(0, body, mode, other)
        call near(maxval(hypot(mode, other)), 1.0_dp, 1e-10_dp, 'mode')
        call check(index(stability%report(), 'Stability: stable') == 1, 'report')
        stat = 77
        errmsg = 'none'
        call stability%get(2, multiplier, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'number: ')
        call stability%shape(0, 99, mode, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'node: ')
        call check(size(mode, 2) == steps, 'a mode that is left as it was')
        call shooting%solve_stability(stability, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_AVAILABLE, 'stability: ')

        stat = 77
        errmsg = 'none'
        call model%solve_shooting(-1.0_dp, none, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'period: ')
        call empty%solve_shooting(period, none, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NULL, 'model: ')
        call periodic%floquet(re, im)
        call near(hypot(re(1), im(1)), exp(-0.2_dp*period), 1e-8_dp, 'of the periodic solution')
        call model%solve_march(none, unset, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_STRUCT_SIZE, 'options')
        options%period = not_a_number()
        call model%solve_march(none, options, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'options.period: ')
        call model%solve_march(none, options, positions=rotation, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'positions: expected the shape 3 x 1, got 9 x 1')
        call model%solve_march(none, options, rotations=position, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'rotations: ')
        call model%solve_march(none, options, velocities=position, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'velocities: ')
        call empty%solve_march(none, options, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NULL, 'model: ')
        figures%steps = 55
        call periodic%march(figures, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_AVAILABLE, 'solution: ')
        call check(figures%steps == 55 .and. .not. c_associated(none%handle()), &
            'outputs as they were')
    end subroutine march
end program test_march
