! Checks that end the program, and the mechanism that tests use.
module checks
    use periodyn
    implicit none
    public

    integer, parameter :: dp = c_double
    real(dp), parameter :: pi = acos(-1.0_dp)
    real(dp), parameter :: origin(3) = 0, axis_1(3) = [1, 0, 0], axis_2(3) = [0, 1, 0], &
        axis_3(3) = [0, 0, 1]
    real(dp), parameter :: identity(3, 3) = reshape([1, 0, 0, 0, 1, 0, 0, 0, 1], [3, 3])
    real(dp), parameter :: omega = 1.5_dp, period = 2*pi/omega
    integer :: refusals = 0

contains

    subroutine check(condition, what)
        logical, intent(in) :: condition
        character(*), intent(in) :: what

        if (.not. condition) then
            print '(2a)', 'not so: ', what
            error stop 1
        end if
    end subroutine check

    subroutine near(found, expected, tolerance, what)
        real(dp), intent(in) :: found, expected, tolerance
        character(*), intent(in) :: what

        if (.not. abs(found - expected) <= tolerance) then
            print '(2a, 2es24.16)', what, ': ', found, expected
            error stop 1
        end if
    end subroutine near

    ! stat and errmsg of a call are the status and a message that starts so; both are reset.
    subroutine refused(stat, errmsg, status, start)
        integer, intent(inout) :: stat
        character(*), intent(inout) :: errmsg
        integer, intent(in) :: status
        character(*), intent(in) :: start

        refusals = refusals + 1
        if (stat /= status .or. index(errmsg, start) /= 1) then
            print '(a, i0, 8a)', 'refusal ', refusals, ': ', pdn_status_name(stat), ': ', &
                trim(errmsg), ', expected ', pdn_status_name(status), ': ', start
            error stop 1
        end if
        stat = 77
        errmsg = 'none'
    end subroutine refused

    real(dp) function not_a_number()
        real(dp) :: zero

        zero = 0
        not_a_number = transfer(-2251799813685248_c_int64_t, zero)
    end function not_a_number

    ! A torsional oscillator about axis 3: moment of inertia 0.5, stiffness 3, damping 0.2.
    subroutine oscillator(model, body, hinge, spring)
        type(pdn_model), intent(inout) :: model
        integer, intent(out) :: body, hinge, spring
        real(dp) :: inertia(3, 3)

        inertia = 0.4_dp*identity
        inertia(3, 3) = 0.5_dp
        call model%new()
        call model%add_rigid_body(2.0_dp, origin, inertia, body)
        call model%add_revolute(PDN_GROUND, body, origin, axis_3, hinge)
        call model%add_spring_damper(hinge, PDN_ROTATION, 3.0_dp, 0.2_dp, 0.0_dp, spring)
    end subroutine oscillator

    ! Its angle under the moment 0.6 cos(omega t): factors of cosine and sine.
    pure function oscillator_angle(stiffness, damping) result(angle)
        real(dp), intent(in) :: stiffness, damping
        real(dp) :: angle(2)

        angle = [stiffness - 0.5_dp*omega**2, damping*omega]
        angle = 0.6_dp*angle/sum(angle**2)
    end function oscillator_angle

    function steel() result(section)
        type(pdn_section) :: section

        section = pdn_diagonal_section([53e6_dp, 17e6_dp, 17e6_dp, 730.0_dp, 1130.0_dp, &
            1130.0_dp], [2.0_dp, 85e-6_dp, 43e-6_dp, 43e-6_dp])
    end function steel

    function frame_at(point) result(frame)
        real(dp), intent(in) :: point(3)
        type(pdn_frame) :: frame

        frame%position = point
        frame%rotation = reshape(identity, [9])
    end function frame_at

    ! A quarter of a circle about axis 3.
    integer(c_int32_t) function quarter(fraction, position, axis_2, user_data) bind(C)
        real(c_double), value :: fraction
        real(c_double), intent(inout) :: position(*), axis_2(*)
        type(c_ptr), value :: user_data

        position(1:3) = [cos(fraction*pi/2), sin(fraction*pi/2), 5.0_dp]
        axis_2(1:3) = axis_3
        quarter = merge(1, 0, c_associated(user_data))
    end function quarter
end module checks
