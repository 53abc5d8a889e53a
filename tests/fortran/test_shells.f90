! Shells over surfaces, points, cells and nodes; what a traction does to a strip is known.
module strips
    use checks
    implicit none

    real(dp), parameter :: length = 2, width = 0.5_dp

contains

    ! A rectangle; fails if it is given data.
    integer(c_int32_t) function strip(u, v, position, user_data) bind(C)
        real(c_double), value :: u, v
        real(c_double), intent(inout) :: position(*)
        type(c_ptr), value :: user_data

        position(:3) = [length*u, width*v, 0.0_dp]
        strip = merge(1, 0, c_associated(user_data))
    end function strip

    ! A pressure, and drag in proportion to the normal velocity.
    integer(c_int32_t) function wind(state, values, user_data) bind(C)
        type(pdn_surface_state), intent(in) :: state
        type(pdn_surface_values), intent(inout) :: values
        type(c_ptr), value :: user_data
        real(dp), pointer :: velocities(:, :), forces(:, :), slopes(:, :, :)

        call c_f_pointer(state%velocities, velocities, [6, int(state%point_count)])
        call c_f_pointer(values%forces, forces, [6, int(state%point_count)])
        forces(3, :) = 0.05_dp - 3*velocities(3, :)
        if (c_associated(values%by_velocity)) then
            call c_f_pointer(values%by_velocity, slopes, [6, 6, int(state%point_count)])
            slopes(3, 3, :) = -3
        end if
        wind = merge(1, 0, c_associated(user_data))
    end function wind
end module strips

program test_shells
    use strips
    implicit none

    real(dp), parameter :: thickness = 0.02_dp, young = 3e6_dp, per_area = 1200*thickness
    integer, target :: dummy

    call stretched_strips()
    call pressures()
    call masses()
    call refusals_of_shells()

contains

    function rubber() result(section)
        type(pdn_shell_section) :: section

        section = pdn_isotropic_shell_section(thickness, young, 0.0_dp, 1200.0_dp)
        call pdn_shell_section_set_proportional_damping(section, 0.5_dp)
        call check(section%damping(1) == 0.5_dp*section%stiffness(1), 'damping')
    end function rubber

    ! The same strip, of 2 x 1 elements of 3 x 2 nodes, over surfaces and over its points.
    subroutine stretched_strips()
        type(pdn_model) :: model
        type(pdn_shell) :: shell
        type(pdn_shell_placement) :: placement
        real(dp) :: points(3, 10)

        call over_surface(pdn_parallelogram_surface(origin, length*axis_1, width*axis_2), points)
        call over_surface(pdn_function_surface(strip), points)
        call pdn_init(placement)
        placement%frames = PDN_SHELL_PARALLEL
        call model%new()
        call model%add_shell_grid(points, 2, 1, 2, 1, rubber(), shell, .false., placement)
        call stretched(model, shell)
    end subroutine stretched_strips

    subroutine over_surface(surface, points)
        type(pdn_surface), intent(in) :: surface
        real(dp), intent(out) :: points(3, 10)
        type(pdn_model) :: model
        type(pdn_shell) :: shell
        type(pdn_frame) :: frame
        integer :: u, v, node, count

        call model%new()
        call model%add_shell(surface, 2, 1, 2, 1, rubber(), shell)
        call check(shell%nodes_u == 5 .and. shell%nodes_v == 2, 'numbers of nodes')
        call model%shell_element_count(count)
        call check(count == 2, 'number of elements')
        do u = 0, 4
            do v = 0, 1
                call model%shell_patch_node(shell, u, v, node)
                call model%node_frame(node, frame)
                points(:, 2*u + v + 1) = frame%position
            end do
        end do
        call stretched(model, shell)
    end subroutine over_surface

    ! A traction makes it longer by q L / (E h), as its strains are those of Biot.
    subroutine stretched(model, shell)
        type(pdn_model), intent(inout) :: model
        type(pdn_shell), intent(in) :: shell
        type(pdn_solution) :: solution
        integer :: first, joints, nodes(1), stat, tip
        real(dp) :: position(3, 1)

        call model%add_rigid_edge(PDN_GROUND, shell, PDN_SHELL_EDGE_START_XI, first, joints)
        call check(first == PDN_FIRST_JOINT .and. joints == shell%nodes_v, 'joints of an edge')
        ! The corner is held already.
        call model%shell_patch_node(shell, 0, 0, nodes(1))
        call model%add_rigid_joints(PDN_GROUND, nodes, stat=stat)
        call check(stat == PDN_ERR_VALUE, 'a node that is held')
        call model%add_shell_load(shell%first_element + 1, 1, PDN_SHELL_EDGE_END_XI, &
            PDN_FRAME_SPACE, PDN_FORCE_1, pdn_constant_signal(600.0_dp))
        call model%solve_static(solution)
        call check(solution%converged(), 'converged')
        call model%shell_node(shell%first_element + 1, 2, 0, tip)
        call solution%sample(pdn_quantity_of(PDN_NODE_POSITION, tip), [0.0_dp], position)
        call near(position(1, 1) - length, 600*length/(young*thickness), 1e-12_dp, 'stretch')
    end subroutine stretched

    ! A pressure by a function is the load.
    subroutine pressures()
        type(pdn_model) :: model
        type(pdn_shell) :: shell
        type(pdn_solution) :: solution
        type(pdn_tangent_check) :: tangents
        real(dp) :: position(3, 1), heights(2)
        integer :: k, force, node

        do k = 1, 2
            call model%new()
            call model%add_shell(pdn_parallelogram_surface(origin, length*axis_1, width*axis_2), &
                2, 1, 2, 1, rubber(), shell)
            call model%add_rigid_edge(PDN_GROUND, shell, PDN_SHELL_EDGE_START_XI)
            if (k == 1) then
                call model%add_shell_load(PDN_FIRST_SHELL_ELEMENT + 1, 1, PDN_SHELL_SURFACE, &
                    PDN_FRAME_MATERIAL, PDN_FORCE_3, pdn_constant_signal(0.05_dp))
            else
                call model%add_surface_force(PDN_FIRST_SHELL_ELEMENT + 1, 1, PDN_SHELL_SURFACE, &
                    PDN_FRAME_MATERIAL, PDN_TANGENTS_GIVEN, wind, first_force=force)
                call model%check_tangents(force, 1.0_dp, tangents)
                call check(force == PDN_FIRST_FORCE .and. tangents%error < 1e-7_dp, &
                    'tangents of wind')
            end if
            call model%solve_static(solution)
            call check(solution%converged(), 'converged')
            call model%shell_node(PDN_FIRST_SHELL_ELEMENT + 1, 2, 0, node)
            call solution%sample(pdn_quantity_of(PDN_NODE_POSITION, node), [0.0_dp], position)
            heights(k) = position(3, 1)
        end do
        call check(heights(1) > 1e-3_dp, 'bent by pressure')
        call near(heights(2), heights(1), 1e-13_dp, 'pressure by a function')
    end subroutine pressures

    subroutine masses()
        type(pdn_model) :: model
        type(pdn_shell) :: shell
        real(dp) :: corners(3, 4), resultants(12), mass
        integer :: nodes(4), first, element

        corners = reshape([0.0_dp, 0.0_dp, 0.0_dp, length, 0.0_dp, 0.0_dp, length, width, 0.0_dp, &
            0.0_dp, width, 0.0_dp], [3, 4])
        call model%new()
        call model%add_shell_quadrilaterals(corners, [0, 1, 2, 3], 4, 3, rubber(), &
            first_element=first)
        call model%mass(mass)
        call near(mass, per_area*length*width, 1e-12_dp, 'cell')
        call model%add_node([0.0_dp, 0.0_dp, 3.0_dp], node=nodes(1))
        call model%add_node([0.0_dp, width, 3.0_dp], node=nodes(2))
        call model%add_node([length, 0.0_dp, 3.0_dp], node=nodes(3))
        call model%add_node([length, width, 3.0_dp], node=nodes(4))
        call model%add_shell_element(nodes, 2, rubber(), element=element)
        call check(first == PDN_FIRST_SHELL_ELEMENT .and. element == first + 1, 'elements')
        resultants = 0
        resultants(1) = 1
        call model%set_shell_prestress(PDN_FIRST_SHELL_ELEMENT, 2, resultants)
        call model%mass(mass)
        call near(mass, 2*per_area*length*width, 1e-12_dp, 'nodes')
        call model%add_shell(pdn_annulus_surface(origin, axis_3, axis_1, 0.5_dp, 1.0_dp, pi), &
            1, 4, 2, 6, rubber(), shell)
        call model%mass(mass)
        call near(mass, per_area*(2*length*width + 0.375_dp*pi), 1e-8_dp, 'annulus')
        call model%add_shell(pdn_cylinder_surface(origin, axis_3, axis_1, 1.0_dp, 2.0_dp, 2*pi), &
            8, 1, 6, 2, rubber(), shell)
        call model%mass(mass)
        call near(mass, per_area*(2*length*width + 4.375_dp*pi), 1e-8_dp, 'cylinder')
    end subroutine masses

    subroutine refusals_of_shells()
        type(pdn_model) :: model
        type(pdn_shell) :: shell
        type(pdn_surface) :: surface
        type(pdn_shell_section) :: section
        real(dp) :: points(2, 4)
        integer :: stat, node
        character(300) :: errmsg

        stat = 77
        errmsg = 'none'
        call model%new()
        section = pdn_isotropic_shell_section(-1.0_dp, young, 0.0_dp, 1.0_dp, stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'thickness: expected a positive')
        surface = pdn_parallelogram_surface(origin, [0.0_dp, not_a_number(), 0.0_dp], axis_2, &
            stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'along_u[1]: ')
        surface = pdn_annulus_surface(origin, axis_3, axis_1, 1.0_dp, 2.0_dp, not_a_number(), &
            stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'angle: ')
        surface = pdn_cylinder_surface(origin, axis_3, axis_1, not_a_number(), 2.0_dp, pi, stat, &
            errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'radius: ')
        surface = pdn_function_surface(strip, c_loc(dummy))
        call model%add_shell(surface, 1, 1, 1, 1, rubber(), shell, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_CALLBACK, 'function: the callback returned 1')
        surface = pdn_function_surface(strip)
        call model%add_shell(surface, 1, -1, 1, 1, rubber(), shell, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'elements: ')
        points = 0
        call model%add_shell_grid(points, 1, 1, 1, 1, rubber(), shell, stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'points: ')
        call model%add_shell_quadrilaterals(points, [0, 1, 2, 3], 4, 1, rubber(), stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'points: ')
        call model%add_shell_element([0, 1, 2, 3], 2, rubber(), stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'nodes[0]: ')
        call model%add_shell(surface, 1, 1, 1, 1, rubber(), shell)
        call model%shell_patch_node(shell, 2, 0, node, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'u: expected 0 to 1')
        call model%shell_node(1, 0, 0, node, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'element: ')
        call model%add_shell_load(PDN_FIRST_SHELL_ELEMENT, 1, 7, PDN_FRAME_SPACE, PDN_FORCE_1, &
            pdn_constant_signal(1.0_dp), stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'place: ')
    end subroutine refusals_of_shells
end program test_shells
