! Modes of the oscillator, whose eigenvalues are known.
program test_modes
    use checks
    implicit none

    call modes_of_oscillator()

contains

    subroutine modes_of_oscillator()
        type(pdn_model) :: model
        type(pdn_modes) :: modes, none
        type(pdn_modes_options) :: options
        type(pdn_static_options) :: at_rest
        type(pdn_mode) :: mode
        type(pdn_solution) :: motion, equilibrium
        integer :: body, hinge, spring, count, outcome, stat
        logical :: complete
        real(dp) :: real_part(6, 1), imaginary_part(6, 1), cosines(1, 1), sines(1, 1), &
            angle(1)
        character(300) :: errmsg

        call oscillator(model, body, hinge, spring)
        call pdn_init(options)
        options%count = 1
        call model%solve_modes(modes, options)
        call check(modes%converged(), 'converged')
        call check(index(modes%report(), 'mode') > 0, 'report')
        call modes%outcome(outcome)
        call modes%count(count, complete)
        call check(outcome == PDN_CONVERGED .and. count == 1 .and. complete, 'count')

        ! 0.5 s^2 + 0.2 s + 3 = 0
        call modes%get(0, mode)
        call near(mode%eigenvalue_real, -0.2_dp, 1e-10_dp, 'real part')
        call near(abs(mode%eigenvalue_imaginary), sqrt(6 - 0.04_dp), 1e-10_dp, 'imaginary part')
        call modes%shape(0, [body], real_part, imaginary_part)
        call near(hypot(real_part(6, 1), imaginary_part(6, 1)), 1.0_dp, 1e-10_dp, 'shape')
        call modes%shape(0, [body], real_part)
        call near(real_part(1, 1), 0.0_dp, 1e-10_dp, 'displacement')
        call modes%motion(0, 0.01_dp, motion)
        call motion%harmonics(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
            cosines=cosines, sines=sines)
        call near(hypot(cosines(1, 1), sines(1, 1)), 0.01_dp, 1e-10_dp, 'motion')
        call modes%equilibrium(equilibrium)
        call equilibrium%sample(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
            [0.0_dp], angle)
        call near(angle(1), 0.0_dp, 1e-12_dp, 'equilibrium')
        call pdn_init(at_rest)
        at_rest%initial = equilibrium%handle()
        call model%solve_modes(modes, options, at_rest)
        call check(modes%converged(), 'from an equilibrium')

        stat = 77
        errmsg = 'none'
        options%count = 0
        call model%solve_modes(none, options, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'options.count: ')
        call pdn_init(options)
        options%near_frequency = not_a_number()
        call model%solve_modes(none, options, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'options.near_frequency: ')
        call pdn_init(at_rest)
        at_rest%load_steps = 0
        call model%solve_modes(none, equilibrium=at_rest, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'options.equilibrium: options.load_steps: ')
        mode%frequency = 55
        call modes%get(1, mode, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'mode: ')
        call check(mode%frequency == 55, 'output as it was')
        call modes%shape(0, [7], real_part, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'nodes')
        call modes%shape(0, [body, body], real_part, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'real: expected the shape 6 x 2, got 6 x 1')
        call modes%motion(0, not_a_number(), motion, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'amplitude: ')
        call none%count(count, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NULL, 'modes: ')
        call none%outcome(outcome, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NULL, 'modes: ')
        call none%equilibrium(motion, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NULL, 'modes: ')
        call check(len(none%report()) == 0 .and. .not. none%converged(), 'no modes')
    end subroutine modes_of_oscillator
end program test_modes
