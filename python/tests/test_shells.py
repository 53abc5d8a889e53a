"""Shells against closed forms."""

import meshio
import numpy as np
import pytest

import periodyn as pdn

LENGTH, WIDTH, THICKNESS, YOUNG = 2.0, 0.5, 0.02, 3e6
PER_AREA = 1200 * THICKNESS
SECOND = pdn.FIRST_SHELL_ELEMENT + 1


def rubber():
    return pdn.ShellSection().set_isotropic(THICKNESS, YOUNG, 0.0, 1200)


def over_rectangle(model):
    surface = pdn.Surface().set_parallelogram([0, 0, 0], [LENGTH, 0, 0], [0, WIDTH, 0])
    return model.add_shell(surface, 2, 1, 2, 1, rubber())


def over_function(model):
    surface = pdn.Surface().set_function(lambda u, v: (LENGTH * u, WIDTH * v, 0))
    return model.add_shell(surface, 2, 1, 2, 1, rubber())


def over_points(model):
    u, v = np.meshgrid(np.linspace(0, LENGTH, 5), np.linspace(0, WIDTH, 2), indexing="ij")
    points = np.stack([u, v, 0 * u], axis=-1).reshape(-1, 3)
    return model.add_shell_grid(points, 2, 1, 2, 1, rubber())


@pytest.mark.parametrize("add", [over_rectangle, over_function, over_points])
def test_a_traction_stretches_a_strip(add):
    model = pdn.Model()
    shell = add(model)
    assert (shell.nodes_u, shell.nodes_v) == (5, 2)
    assert shell.first_element == pdn.FIRST_SHELL_ELEMENT
    assert model.shell_element_count() == 2
    corner = model.shell_patch_node(shell, 0, 0)
    assert model.add_rigid_joints(pdn.GROUND, [corner]) == (pdn.FIRST_JOINT, 1)
    # The corner is held already.
    others = model.add_rigid_edge(pdn.GROUND, shell, pdn.SHELL_EDGE_START_XI)
    assert others == (pdn.FIRST_JOINT + 1, 1)
    load = model.add_shell_load(SECOND, 1, pdn.SHELL_EDGE_END_XI, pdn.FRAME_SPACE, pdn.FORCE_1,
                                600.0)
    assert load == pdn.FIRST_SHELL_LOAD
    assert model.shell_load(load) == (SECOND, 1, pdn.SHELL_EDGE_END_XI, pdn.FRAME_SPACE)
    solution = model.solve_static()
    assert solution.converged
    tip = model.shell_node(SECOND, 2, 0)
    assert tip == model.shell_patch_node(shell, 4, 0)
    stress = pdn.Quantity()
    stress.kind, stress.object, stress.direction = pdn.SHELL_STRESS_TOP, SECOND, [0, 1, 0]
    stresses = solution.sample(stress, [0])
    np.testing.assert_allclose(stresses, [[0, 600 / THICKNESS, 0, 600 / THICKNESS]], atol=1e-5)
    stretch = solution.sample(pdn.Quantity(pdn.NODE_POSITION, tip), [0])[0, 0] - LENGTH
    np.testing.assert_allclose(stretch, 600 * LENGTH / (YOUNG * THICKNESS), rtol=1e-12)
    model.set_shell_prestress(shell.first_element, 2, 600 * np.eye(12)[0])
    place = model.solve_static().sample(pdn.Quantity(pdn.NODE_POSITION, tip), [0])[0, 0]
    np.testing.assert_allclose(place, LENGTH, rtol=1e-12)


def test_a_pressure_by_a_function_is_the_load():
    def bent(given):
        model = pdn.Model()
        shell = over_rectangle(model)
        model.add_rigid_edge(pdn.GROUND, shell, pdn.SHELL_EDGE_START_XI)
        if given is None:
            model.add_shell_load(SECOND, 1, pdn.SHELL_SURFACE, pdn.FRAME_MATERIAL, pdn.FORCE_3,
                                 0.05)
        else:
            def wind(state, values):
                assert state.element == SECOND and state.places.shape == (len(state.sizes), 2)
                np.testing.assert_allclose(state.sizes.sum(), LENGTH * WIDTH / 2)
                values.forces[:, 2] = 0.05 - 3 * state.velocities[:, 2]
                if values.by_velocity is not None:
                    values.by_velocity[:, 2, 2] = -3

            force = model.add_surface_force(SECOND, 1, pdn.SHELL_SURFACE, pdn.FRAME_MATERIAL,
                                            given, wind)
            assert model.force(force).shell_element == SECOND
            if given == pdn.TANGENTS_GIVEN:
                assert model.check_tangents(force, 1.0).error < 1e-7
        return model.solve_static().sample(
            pdn.Quantity(pdn.NODE_POSITION, model.shell_node(SECOND, 2, 0)), [0]
        )[0, 2]

    assert bent(None) > 1e-3
    for given in (pdn.TANGENTS_GIVEN, pdn.TANGENTS_DIFFERENCED):
        np.testing.assert_allclose(bent(given), bent(None), rtol=1e-11)


def test_cells_and_surfaces_have_their_masses():
    model = pdn.Model()
    section = rubber().set_proportional_damping(0.5)
    np.testing.assert_allclose(section.damping, 0.5 * section.stiffness)
    assert section.stiffness.shape == (12, 12) and section.mass.shape == (6, 6)
    corners = [[0, 0, 0], [LENGTH, 0, 0], [LENGTH, WIDTH, 0], [0, WIDTH, 0]]
    model.add_shell_quadrilaterals(corners, [0, 1, 2, 3], 4, 3, section)
    np.testing.assert_allclose(model.mass()[0], PER_AREA * LENGTH * WIDTH)
    nodes = [model.add_node([x, y, 5]) for x in (0, LENGTH) for y in (0, WIDTH)]
    placement = pdn.ShellPlacement()
    placement.frames = pdn.SHELL_PARALLEL
    assert model.add_shell_element(nodes, 2, section, placement) == SECOND
    annulus = pdn.Surface().set_annulus([0, 0, 0], [0, 0, 1], [1, 0, 0], 0.5, 1, np.pi)
    model.add_shell(annulus, 1, 4, 2, 6, section)
    cylinder = pdn.Surface().set_cylinder([0, 0, 0], [0, 0, 1], [1, 0, 0], 1, 2, 2 * np.pi)
    model.add_shell(cylinder, 8, 1, 6, 2, section)
    expected = PER_AREA * (2 * LENGTH * WIDTH + 4.375 * np.pi)
    np.testing.assert_allclose(model.mass()[0], expected, rtol=1e-9)


def test_a_file_of_gmsh_becomes_a_shell(tmp_path):
    points = np.array([[x, y, 0.0] for y in (0, 1) for x in (0, 1, 2)])
    cells = np.array([[0, 1, 4, 3], [1, 2, 5, 4]])
    meshio.write(tmp_path / "plate.msh", meshio.Mesh(points, [("quad", cells)]), "gmsh")
    model, section = pdn.Model(), rubber()
    mesh = meshio.read(tmp_path / "plate.msh")
    model.add_shell_quadrilaterals(mesh.points, mesh.cells_dict["quad"].ravel(), 4, 3, section)
    assert model.shell_element_count() == 2 and model.node_count() == 7 * 4
    np.testing.assert_allclose(model.mass()[0], 2 * PER_AREA)


def test_arrays_of_a_struct_outlive_it():
    model = pdn.Model()
    nodes = [model.add_node([k, 2 * k, -k]) for k in range(200)]
    positions = [model.node_frame(node).position for node in nodes]
    for k, position in enumerate(positions):
        np.testing.assert_array_equal(position, [k, 2 * k, -k])


def test_what_a_surface_raises_comes_out():
    model = pdn.Model()

    def surface(u, v):
        raise ZeroDivisionError("no such surface")

    with pytest.raises(ZeroDivisionError, match="no such surface"):
        model.add_shell(pdn.Surface().set_function(surface), 1, 1, 1, 1, rubber())
    with pytest.raises(pdn.Error, match="thickness: expected a positive"):
        pdn.ShellSection().set_isotropic(0, 1, 0, 1)
    assert model.node_count() == 0
