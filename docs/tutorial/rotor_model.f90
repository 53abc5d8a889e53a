module rotor_model
    use periodyn
    implicit none
    integer, parameter :: dp = c_double

    ! Metres, kilograms, seconds. The shaft is along x, as is the wind; blades of 10 m reach from
    ! the hub, the first one upwards at first. wind is that at the rotor, which slows it down.
    real(dp), parameter :: pi = acos(-1.0_dp), radius = 10, hub_radius = 1, chord = 0.6_dp
    real(dp), parameter :: wind = 6, shear = 0.02_dp
    real(dp), parameter :: half_density = 0.6_dp, lift_slope = 5.7_dp, drag = 0.01_dp

    type rotor
        type(pdn_model) :: model
        real(dp) :: period
        integer :: shaft, pitches(3)
        type(pdn_beam) :: blades(3)
        real(dp) :: widths(7) ! of the pieces of a blade, which its nodes stand for
    end type rotor

contains

    ! Lift across and drag along the air that meets a piece of a blade. Axis 2 of its node points
    ! to the leading edge, axis 3 downwind.
    integer(c_int32_t) function airload(state, values, data) bind(C)
        type(pdn_force_state), intent(in) :: state
        type(pdn_force_values), intent(inout) :: values
        type(c_ptr), value :: data
        real(dp), pointer :: width, position(:), axes(:, :), velocity(:), forces(:)
        real(dp) :: here, along, across, factor, speed

        call c_f_pointer(data, width)
        call c_f_pointer(state%positions, position, [3])
        call c_f_pointer(state%rotations, axes, [3, 3])
        call c_f_pointer(state%velocities, velocity, [6])
        call c_f_pointer(values%forces, forces, [6])
        here = wind*(1 + shear*position(3))
        along = here*axes(1, 2) - velocity(2)
        across = here*axes(1, 3) - velocity(3)
        factor = half_density*chord*width
        speed = hypot(along, across)
        forces(2) = factor*(lift_slope*across**2 + drag*speed*along)
        forces(3) = factor*(-lift_slope*across*along + drag*speed*across)
        airload = 0
    end function airload

    subroutine build_rotor(r, speed, pitch)
        type(rotor), intent(inout), target :: r
        real(dp), intent(in) :: speed, pitch
        real(dp) :: inertia(3, 3), azimuth, span(3), forward(3)
        type(pdn_section) :: section
        type(pdn_frame) :: before, after
        integer :: hub, bearing, b, node, k

        inertia = reshape([real(dp) :: 100, 0, 0, 0, 60, 0, 0, 0, 60], [3, 3])
        section = pdn_diagonal_section([4e8_dp, 1e8_dp, 1e8_dp, 6e5_dp, 6e6_dp, 1e6_dp], &
            [16.0_dp, 0.5_dp, 0.05_dp, 0.45_dp])
        call pdn_section_set_proportional_damping(section, 2e-3_dp)

        r%period = 2*pi/speed
        call r%model%new()
        call r%model%set_gravity([real(dp) :: 0, 0, -9.81_dp])
        call r%model%add_rigid_body(200.0_dp, [real(dp) :: 0, 0, 0], inertia, hub)
        call r%model%add_revolute(PDN_GROUND, hub, [real(dp) :: 0, 0, 0], [real(dp) :: 1, 0, 0], &
            r%shaft)
        call r%model%prescribe(r%shaft, PDN_ROTATION, pdn_harmonics_signal(rate=speed))
        do b = 1, 3
            azimuth = 2*pi*(b - 1)/3
            span = [0.0_dp, -sin(azimuth), cos(azimuth)]
            forward = [0.0_dp, -cos(azimuth), -sin(azimuth)]
            call r%model%add_straight_beam(hub_radius*span, radius*span, forward, section, 2, 3, &
                r%blades(b))
            call r%model%add_revolute(hub, r%blades(b)%first, hub_radius*span, -span, bearing)
            call r%model%prescribe(bearing, PDN_ROTATION, pdn_constant_signal(pitch), r%pitches(b))
            do node = r%blades(b)%first, r%blades(b)%last
                call r%model%node_frame(max(node - 1, r%blades(b)%first), before)
                call r%model%node_frame(min(node + 1, r%blades(b)%last), after)
                k = node - r%blades(b)%first + 1
                r%widths(k) = norm2(after%position - before%position)/2
                call r%model%add_user_force([node], PDN_FRAME_MATERIAL, &
                    PDN_TANGENTS_DIFFERENCED, airload, c_loc(r%widths(k)))
            end do
        end do
    end subroutine build_rotor
end module rotor_model
