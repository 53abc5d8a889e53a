"""Controllers: laws that read other coordinates, and states of the user."""

import numpy as np
import pytest

import periodyn as pdn

MASS, STIFFNESS, INTEGRAL, LOSS, OMEGA = 2.0, 5.0, 1.5, 0.8, 1.7


def oscillator():
    model = pdn.Model()
    body = model.add_rigid_body(MASS, [0, 0, 0], np.eye(3))
    slide = model.add_prismatic(pdn.GROUND, body, [0, 0, 0], [1, 0, 0])
    model.add_spring_damper(slide, pdn.DISPLACEMENT, STIFFNESS)
    return model, slide


def govern(state, values):
    values.efforts[0] = -INTEGRAL * state.states[0] - LOSS * state.input_rates[0]
    values.state_rates[0] = state.inputs[0]
    if values.by_inputs is not None:
        values.by_inputs[1, 0] = 1
        values.by_input_rates[0, 0] = -LOSS
        values.by_states[0, 0] = -INTEGRAL


def governed(tangents, function=govern):
    model, slide = oscillator()
    at = [slide], [pdn.DISPLACEMENT]
    force = model.add_controller(
        *at, tangents, function, *at, initial=[0.25], sizes=[0.5])
    model.add_actuator(slide, pdn.DISPLACEMENT, lambda t: 0.9 * np.cos(OMEGA * t))
    return model, slide, force


@pytest.mark.parametrize("tangents", [pdn.TANGENTS_GIVEN, pdn.TANGENTS_DIFFERENCED])
def test_an_integral_makes_it_third_order(tangents):
    model, slide, force = governed(tangents)
    solution = model.solve_periodic(2 * np.pi / OMEGA, grid_points=9)
    times = np.linspace(0, 3, 7)
    s = 1j * OMEGA
    response = 0.9 / (STIFFNESS + MASS * s**2 + LOSS * s + INTEGRAL / s)
    wave = np.exp(s * times)
    found = solution.sample(pdn.Quantity(pdn.JOINT_COORDINATE, slide, pdn.DISPLACEMENT), times)
    np.testing.assert_allclose(found, (response * wave).real, atol=1e-11)
    quantity = pdn.Quantity(kind=pdn.FORCE_CONTROL_STATE, object=force)
    found = np.ravel(solution.sample(quantity, times))
    np.testing.assert_allclose(found, (response / s * wave).real, atol=1e-11)
    assert model.controller_counts(force) == (1, 1, 1)
    assert model.controller_coordinate(force, 1) == (slide, pdn.DISPLACEMENT)
    assert model.controller_state(force, 0) == (0.25, 0.5)
    if tangents == pdn.TANGENTS_GIVEN:
        assert model.check_tangents(force, 2 * np.pi / OMEGA).error < 1e-8


def test_without_states_and_inputs_it_is_a_function_of_time():
    model, slide = oscillator()

    def push(state, values):
        assert len(state.states) == len(state.inputs) == 0
        values.efforts[0] = np.cos(OMEGA * state.time)

    model.add_controller([slide], [pdn.DISPLACEMENT], pdn.TANGENTS_DIFFERENCED, push)
    solution = model.solve_periodic(2 * np.pi / OMEGA, grid_points=5)
    exact = 1 / (STIFFNESS - MASS * OMEGA**2)
    found = solution.sample(pdn.Quantity(pdn.JOINT_COORDINATE, slide, pdn.DISPLACEMENT), [0.0])
    np.testing.assert_allclose(found, exact, atol=1e-11)


def test_exceptions_come_back_and_functions_are_bound_by_label(tmp_path):
    def fail(state, values):
        raise ZeroDivisionError("no law")

    model, slide, force = governed(pdn.TANGENTS_DIFFERENCED, fail)
    with pytest.raises(ZeroDivisionError, match="no law"):
        model.solve_periodic(2 * np.pi / OMEGA, grid_points=9)
    model.bind_controller(force, pdn.TANGENTS_GIVEN, govern)
    assert model.solve_periodic(2 * np.pi / OMEGA, grid_points=9).converged

    model, slide = oscillator()
    at = [slide], [pdn.DISPLACEMENT]
    force = model.add_controller(*at, pdn.TANGENTS_GIVEN, govern, *at, sizes=[1.0])
    model.set_label(force, "governor")
    path = str(tmp_path / "model.pdm")
    model.save(path)
    loaded = pdn.Model.load(path)
    with pytest.raises(pdn.Error, match="its function is not there"):
        loaded.solve_periodic(2.0, grid_points=5)
    loaded.bind_controller(
        loaded.find_label(pdn.OBJECT_FORCE, "governor"), pdn.TANGENTS_GIVEN, govern)
    assert loaded.solve_periodic(2.0, grid_points=5).converged


def test_what_makes_none_is_refused():
    model, slide = oscillator()
    at = [slide], [pdn.DISPLACEMENT]
    with pytest.raises(pdn.Error, match="output_joints"):
        model.add_controller([7], [pdn.DISPLACEMENT], pdn.TANGENTS_GIVEN, govern)
    with pytest.raises(pdn.Error, match="output_count"):
        model.add_controller([], [], pdn.TANGENTS_GIVEN, govern)
    with pytest.raises(pdn.Error, match="sizes"):
        model.add_controller(*at, pdn.TANGENTS_GIVEN, govern, *at, sizes=[-1.0])
    assert model.force_count() == 1
