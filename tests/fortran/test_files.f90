! Tables as CSV and animations.
program test_files
    use checks
    implicit none

    call files()

contains

    subroutine files()
        type(pdn_model) :: model, cantilever
        type(pdn_solution) :: solution, bent, loaded, none
        type(pdn_table) :: table
        type(pdn_beam) :: beam
        integer :: body, hinge, spring, stat, unit, k
        character(300) :: errmsg, head
        real(dp) :: angle(3), row(3), tip(3, 1), same(3, 1)
        real(dp) :: sampled(1, 3), least(1), most(1), at(2), mean(1), cosines(1, 2), sines(1, 2)
        type(pdn_quantity) :: turn
        integer :: elements
        real(dp), parameter :: times(3) = [0.0_dp, 0.5_dp, 1.0_dp]
        logical :: there

        call oscillator(model, body, hinge, spring)
        call model%add_load(body, PDN_FRAME_SPACE, PDN_MOMENT_3, &
            pdn_harmonics_signal(0.0_dp, 0.0_dp, [0.6_dp], [0.0_dp]))
        call model%solve_periodic(period, solution)
        call table%new(times)
        call table%add_quantity(solution, pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, &
            PDN_ROTATION), 'angle  ')
        call table%add_values('mine', [1.0_dp, 2.0_dp, 3.0_dp])
        call table%write_csv('own.csv')
        call solution%sample(pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, PDN_ROTATION), &
            times, angle)
        open (newunit=unit, file='own.csv', status='old', action='read')
        read (unit, '(a)') head
        call check(head == 't,angle,mine', 'names')
        do k = 1, 3
            read (unit, *) row
            call check(all(row == [times(k), angle(k), real(k, dp)]), 'row')
        end do
        close (unit)

        turn = pdn_quantity_of(PDN_JOINT_COORDINATE, hinge, component=PDN_ROTATION)
        call solution%sample(turn, times, sampled)
        call check(all(sampled(1, :) == angle), 'quantity')
        call solution%extremes(turn, least, at(:1), most, at(2:))
        call check(least(1) < angle(2) .and. angle(2) < most(1), 'extremes')
        call solution%harmonics(turn, mean, cosines=cosines, sines=sines)
        call check(least(1) < mean(1) .and. mean(1) < most(1), 'mean')
        call solution%sample(turn, times, cosines, stat, errmsg)
        call check(stat == PDN_ERR_SIZE, 'shape of samples')
        turn%component = 17
        call solution%sample(turn, times, sampled, stat, errmsg)
        call check(stat == PDN_ERR_VALUE, 'no such coordinate')
        turn%component = PDN_ROTATION
        call table%add_quantity(solution, turn, 'turn')

        call table%add_quantity(solution, pdn_quantity_of(PDN_NODE_POSITION, body))
        call table%add_quantity(solution, pdn_quantity_of(PDN_JOINT_REACTION, hinge), 'reaction')
        call table%add_quantity(solution, pdn_quantity_of(PDN_FORCE_ON_NODE, spring, node=body), &
            'pull')
        call cantilever%new()
        call cantilever%add_straight_beam(origin, axis_1, axis_2, steel(), 2, 1, beam)
        call cantilever%add_rigid_joint(PDN_GROUND, beam%first, origin)
        call cantilever%solve_static(bent)
        call table%add_quantity(bent, pdn_quantity_of(PDN_BEAM_FORCE, beam%first_element), 'root')
        call table%write_csv('more.csv')
        open (newunit=unit, file='more.csv', status='old', action='read')
        read (unit, '(a)') head
        close (unit)
        call check(index(head, 'node0.position.x') > 0 .and. index(head, 'root.axial') > 0 .and. &
            index(head, 'reaction.force_x') > 0 .and. index(head, 'pull.') > 0, 'more names')
        call bent%write_vtk([0.0_dp], 3, 'bent.pvd')
        inquire (file='bent.pvd', exist=there)
        call check(there, 'animation')

        ! What is loaded is what was saved, and can be solved again.
        call bent%save('bent.pdn')
        call loaded%load('bent.pdn')
        call bent%sample(pdn_quantity_of(PDN_NODE_POSITION, beam%last), [0.0_dp], tip)
        call loaded%sample(pdn_quantity_of(PDN_NODE_POSITION, beam%last), [0.0_dp], same)
        call check(all(tip == same) .and. loaded%report() == bent%report(), 'loaded')
        call loaded%model(cantilever)
        call cantilever%element_count(elements)
        call check(elements == 2, 'model of the solution')
        call cantilever%add_load(beam%last, PDN_FRAME_SPACE, PDN_FORCE_3, &
            pdn_constant_signal(1.0_dp))
        call cantilever%solve_static(loaded)
        call check(loaded%converged(), 'solved again')

        stat = 77
        errmsg = 'none'
        call table%new([not_a_number()], stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_FINITE, 'times')
        call table%add_quantity(solution, pdn_quantity_of(PDN_NODE_POSITION, 4), 'x', stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'quantity.object: ')
        call table%add_quantity(solution, pdn_quantity_of(PDN_NODE_POSITION, body), stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'label: ')
        call table%add_quantity(solution, pdn_quantity_of(PDN_JOINT_RATE, hinge, &
            PDN_DISPLACEMENT), stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_NOT_AVAILABLE, 'coordinate: ')
        call table%add_quantity(bent, pdn_quantity_of(PDN_BEAM_FORCE, beam%first_element, &
            station=3.0_dp), stat=stat, errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'station: ')
        call table%add_quantity(solution, pdn_quantity_of(PDN_FORCE_EFFORT, 8), stat=stat, &
            errmsg=errmsg)
        call refused(stat, errmsg, PDN_ERR_ID, 'quantity.object: ')
        call table%add_values('short', [1.0_dp], stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'count: ')
        call table%write_csv('no/such/place.csv', stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_IO, 'path: ')
        call bent%write_vtk([0.0_dp], -1, 'bent.pvd', stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_SIZE, 'points_per_element: ')
        call bent%write_vtk([0.0_dp], 2, 'bent.vtk', stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_VALUE, 'path: ')
        call none%load('nowhere.pdn', stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_IO, 'path: ')
        call none%load('own.csv', stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_FORMAT, '')
        call bent%save('no/such/place.pdn', stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_IO, 'path: ')
        call none%save('bent.pdn', stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NULL, 'solution: ')
        call none%model(model, stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NULL, 'solution: ')
        call table%free()
        call table%write_csv('own.csv', stat, errmsg)
        call refused(stat, errmsg, PDN_ERR_NULL, 'table: ')
    end subroutine files
end program test_files
