"""Relations, bearings, labels, and what a model holds."""

import numpy as np
import pytest
from models import oscillator

import periodyn as pdn

FRAME = pdn.Frame(position=np.zeros(3), rotation=np.eye(3))


def wheel(model, x, inertia):
    body = model.add_rigid_body(1, [x, 0, 0], inertia * np.eye(3))
    return model.add_revolute(pdn.GROUND, body, [x, 0, 0], [0, 0, 1])


def test_geared_wheels_are_one_inertia():
    model = pdn.Model()
    joints = [wheel(model, 0, 0.4), wheel(model, 1, 0.15)]
    model.add_spring_damper(joints[0], pdn.ROTATION, 3)
    model.add_actuator(joints[0], pdn.ROTATION, np.cos)
    relation = model.add_relation(joints, [pdn.ROTATION, pdn.ROTATION], [-2.5, -1])
    solution = model.solve_periodic(2 * np.pi)
    times = np.linspace(0, 6, 7)
    exact = np.cos(times) / (3 - 0.4 - 2.5**2 * 0.15)
    first, second = (
        solution.sample(pdn.Quantity(pdn.JOINT_COORDINATE, j, pdn.ROTATION), times) for j in joints
    )
    np.testing.assert_allclose(first, exact, atol=1e-6)
    np.testing.assert_allclose(second, -2.5 * first, atol=1e-6)
    effort = solution.sample(
        pdn.Quantity(kind=pdn.RELATION_EFFORT, object=relation, component=1), times)
    np.testing.assert_allclose(np.ravel(effort), 0.15 * 2.5 * exact, atol=1e-5)
    assert model.relation_term(relation, 0) == (joints[0], pdn.ROTATION, -2.5)


def test_turns_that_are_not_whole_name_a_period():
    model = pdn.Model()
    joints = [wheel(model, 0, 0.4), wheel(model, 1, 0.15)]
    model.prescribe(joints[0], pdn.ROTATION, pdn.Signal().set_harmonics(rate=1.0))
    model.add_relation(joints, [pdn.ROTATION, pdn.ROTATION], [0.5, -1])
    with pytest.raises(pdn.Error, match="a period 2 times as long"):
        model.solve_periodic(2 * np.pi)
    assert model.solve_periodic(4 * np.pi).converged


def test_matrices_of_bearings_are_rows_by_columns():
    stiffness = np.arange(36.0).reshape(6, 6)
    stiffness[:, 5] = 0
    model = pdn.Model()
    body = model.add_rigid_body(1, [0, 0, 0], np.eye(3))
    force = model.add_bushing(pdn.GROUND, body, FRAME, FRAME, stiffness, np.eye(6),
                              pdn.ANGLES_TILT_AND_SPIN)
    info = model.force(force)
    assert info.kind == pdn.FORCE_IS_BUSHING and info.first == pdn.GROUND and info.second == body
    kept = [model.force_number(force, pdn.NUMBER_STIFFNESS, i) for i in range(36)]
    np.testing.assert_array_equal(np.reshape(kept, (6, 6), order="F"), stiffness)


def test_labels_and_contents():
    model, body, joint, spring = oscillator(force=0.5)
    model.set_label(joint, "Führung")
    assert model.label(joint) == "Führung"
    assert model.label(body) == ""
    assert model.find_label(pdn.OBJECT_JOINT, "Führung") == joint
    with pytest.raises(pdn.Error, match="no joint has the label"):
        model.find_label(pdn.OBJECT_JOINT, "Kolben")
    info = model.joint(joint)
    assert info.kind == pdn.JOINT_PRISMATIC and info.second == body
    assert model.force(spring).stiffness_count == 1
    assert model.force_number(spring, pdn.NUMBER_STIFFNESS, 0) == 4
    node, matrix = model.inertia(model.inertia_of(body))
    assert node == body
    np.testing.assert_array_equal(matrix, np.eye(6))
    mass = model.add_mass(body, 0.0, [0, 0, 0])
    assert mass == pdn.FIRST_INERTIA + 1 and model.inertia(mass)[0] == body
    parameter = model.add_parameter("mass", 1, 1)
    model.move_number(parameter, pdn.NUMBER_INERTIA, model.inertia_of(body), 0, 1.0)
    assert model.parameter_name(parameter) == "mass" and model.parameter(parameter) == (1, 1)
    assert model.find_parameter("mass") == parameter
    model.set_parameter(parameter, 2)
    np.testing.assert_array_equal(model.inertia(model.inertia_of(body))[1], 2 * np.eye(6))
    with pytest.raises(pdn.Error, match="one that spins"):
        model.spin(model.inertia_of(body))
    model.set_spin(model.inertia_of(body), [0, 0, 2], 3.5)
    axis, rate = model.spin(model.inertia_of(body))
    assert rate == 3.5 and axis.tolist() == [0, 0, 1]
    model.set_turning_frame([0, 0, 1], 0.0)
    model.set_frame_advance(1.5)
    assert model.frame_advance() == 1.5
    section = pdn.Section().set_diagonal([8e3, 3e3, 3e3, 14, 9, 9], [0.3, 1e-5, 5e-6, 5e-6])
    shaft = model.add_straight_beam([0, 0, 0], [1, 0, 0], [0, 1, 0], section, 2, 2)
    model.set_beam_spin(shaft.first_element, 2, -4)
    assert model.beam_spin(shaft.first_element + 1) == -4
    node, first_element, elements, fraction, offset, frame = model.load_at(pdn.FIRST_LOAD)
    assert (node, first_element, elements, fraction) == (body, -1, 0, 0)
    assert frame == pdn.FRAME_SPACE and not offset.any()
    values = model.sample_signal(pdn.FIRST_LOAD, pdn.FORCE_1, 1.0, [0, 0.5])
    np.testing.assert_array_equal(values, [0.5, 0.5])


@pytest.mark.parametrize("along, axis_1, axis_2", [
    ("x", [0, 1, 0], [0, 0, 1]), ("y", [1, 0, 0], [0, 0, -1]), ("z", [1, 0, 0], [0, 1, 0])])
def test_axes_of_joints_made_by_an_axis(along, axis_1, axis_2):
    # the table of docs/joints.md
    model = pdn.Model()
    body = model.add_rigid_body(1, [0, 0, 0], np.eye(3))
    axis = np.eye(3)["xyz".index(along)]
    for add in (model.add_revolute, model.add_prismatic, model.add_cylindrical, model.add_planar):
        joint = model.joint(add(pdn.GROUND, body, [0, 0, 0], 2 * axis))
        for rotation in (joint.first_rotation, joint.second_rotation):
            np.testing.assert_allclose(rotation.T, [axis_1, axis_2, axis], atol=1e-15)
    for add in (model.add_rigid_joint, model.add_spherical, model.add_free_joint):
        np.testing.assert_array_equal(model.joint(add(pdn.GROUND, body, [1, 0, 0])).first_rotation,
                                      np.eye(3))


def test_loads_at_points_are_those_on_nodes_there():
    section = pdn.Section().set_diagonal([8e3, 3e3, 3e3, 14, 9, 25], [0.3, 1e-5, 5e-6, 5e-6])
    arm = [0, 0.2, 0.1]

    def bent(load):
        model = pdn.Model()
        beam = model.add_straight_beam([0, 0, 0], [1, 0, 0], [0, 1, 0], section, 2, 3)
        model.add_rigid_joint(pdn.GROUND, beam.first, [0, 0, 0])
        added = load(model, beam)
        model.set_load_frame(added, pdn.FRAME_MATERIAL)
        assert model.load_at(added)[-1] == pdn.FRAME_MATERIAL
        return model.solve_static().sample(pdn.Quantity(pdn.NODE_POSITION, beam.last), [0])[0]

    push = pdn.FRAME_SPACE, pdn.FORCE_3, 20
    on_line = bent(lambda model, beam: model.add_load(beam.first + 3, *push))
    off_line = bent(lambda model, beam: model.add_load_at_point(beam.first + 3, arm, *push))
    for offset, wanted in (None, on_line), (arm, off_line):
        found = bent(lambda model, beam: model.add_load_on_beam(
            beam.first_element, 2, 0.5, *push, offset=offset))
        np.testing.assert_allclose(found, wanted, atol=1e-14)
    assert abs(off_line - on_line).max() > 1e-3
