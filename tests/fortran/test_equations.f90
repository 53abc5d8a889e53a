! The equations below the solve: Newton's method of the test's own against the closed form of a
! forced oscillator.
program test_equations
    use checks
    implicit none

    call equations_of_an_oscillator()

contains

    subroutine equations_of_an_oscillator()
        type(pdn_model) :: model
        type(pdn_equations) :: equations
        type(pdn_equations_options) :: options
        type(pdn_equations_sizes) :: sizes
        type(pdn_solution) :: solution
        integer :: body, hinge, spring, step, stat, i
        integer(c_int32_t) :: nodes(1)
        integer(c_size_t), allocatable :: numbers(:)
        real(dp), allocatable :: right(:), increment(:), rest(:), x(:), y(:), again(:)
        real(dp), allocatable :: motions(:), own(:)
        real(dp) :: motion, change, angle(1), expected, real_part
        logical :: regular, compliant
        character(300) :: errmsg

        call oscillator(model, body, hinge, spring)
        call model%add_load(body, PDN_FRAME_SPACE, PDN_MOMENT_3, &
            pdn_harmonics_signal(0.0_dp, 0.0_dp, [0.6_dp], [0.0_dp]))
        call pdn_init(options)
        options%grid_points = 21
        options%preconditioner = PDN_LINEAR_BODY_CIRCULANT
        call equations%new(model, period, options)
        call equations%get_sizes(sizes)
        call check(sizes%size == sizes%total .and. sizes%nodes == 1, 'sizes')
        call equations%nodes(nodes)
        call check(nodes(1) == body, 'nodes')
        allocate (numbers(sizes%size), right(sizes%size), increment(sizes%size), rest(sizes%size))
        allocate (x(sizes%size), y(sizes%size), again(sizes%size))
        allocate (motions(sizes%motions), own(sizes%own_unknowns))
        call equations%numbers(numbers)
        call check(numbers(6) == 5, 'numbers, which begin with 0')

        motion = 1
        do step = 1, 8
            call equations%linearise()
            call equations%residual(right)
            right = -right
            call equations%factor(right, regular)
            call check(regular, 'regular')
            call solve(equations, right, increment)
            call equations%compliance(increment, rest, compliant)
            call check(.not. compliant, 'no compliance')
            call equations%norms(increment, motion, change)
            call equations%update(increment)
            if (motion <= 1e-10_dp) exit
        end do
        call check(motion <= 1e-10_dp, 'converged')
        call equations%solution(PDN_CONVERGED, solution, root=0)
        call solution%sample(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
            [0.0_dp], angle)
        real_part = 3 - 0.5_dp*omega**2
        expected = 0.6_dp*real_part/(real_part**2 + (0.2_dp*omega)**2)
        call near(angle(1), expected, 1e-9_dp, 'angle')

        x = [(sin(0.37_dp*i), i=1, size(x))]
        y = [(cos(0.23_dp*i), i=1, size(y))]
        call equations%product(x, right)
        call equations%transposed_product(y, rest)
        call near(dot_product(y, right), dot_product(rest, x), 1e-11_dp, 'transposed product')
        call equations%power_product(2, x, rest)
        call check(maxval(abs(rest)) > 0, 'mass')
        stat = 77
        errmsg = 'none'
        call equations%power_product(3, x, rest, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'power: expected 1 or 2')
        call equations%product(x, rest(2:), stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'out: ')

        call equations%state(motions, own)
        call equations%residual(right)
        call equations%set_state(motions, own)
        call equations%residual(again)
        call near(maxval(abs(again - right)), 0.0_dp, 1e-12_dp, 'the same state')
    end subroutine equations_of_an_oscillator

    ! Solves J x = b with the preconditioner alone, again and again.
    subroutine solve(equations, b, x)
        type(pdn_equations), intent(inout) :: equations
        real(dp), intent(in) :: b(:)
        real(dp), intent(inout) :: x(:)
        real(dp) :: rest(size(b)), correction(size(b))
        integer :: i

        x = 0
        rest = b
        do i = 1, 60
            call equations%precondition(rest, correction)
            x = x + correction
            call equations%product(x, rest)
            rest = b - rest
        end do
    end subroutine solve

end program test_equations
