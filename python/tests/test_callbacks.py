"""Functions of Python that the library calls: their values, exceptions, lifetime and threads."""

import gc
import signal
import threading
import time

import numpy as np
import pytest
from models import oscillator

import periodyn as pdn


def test_what_a_function_raises_comes_out_of_the_call():
    def broken(_time):
        raise ZeroDivisionError("no force today")

    model, *_ = oscillator(force=broken)
    with pytest.raises(ZeroDivisionError, match="no force today"):
        model.solve_periodic(2 * np.pi)
    # and the next error is another
    with pytest.raises(pdn.Error, match="period"):
        model.solve_periodic(-1.0)


def test_a_function_that_gives_no_number():
    model, *_ = oscillator(force=lambda _time: "one")
    with pytest.raises(TypeError):
        model.solve_periodic(2 * np.pi)


def notes(error):
    """What is added to an exception: before Python 3.11 its cause."""
    return "\n".join(getattr(error, "__notes__", [str(error.__cause__)]))


def test_exceptions_tell_which_function_raised_them_and_what_was_expected():
    def drag(state, values):
        values.forces[:] = -state.velocities[:, :3]

    model, body, *_ = oscillator()
    force = model.add_user_force([body], pdn.FRAME_SPACE, pdn.TANGENTS_DIFFERENCED, drag)
    model.set_label(force, "air")
    with pytest.raises(ValueError, match="broadcast") as raised:
        model.solve_periodic(2 * np.pi)
    told = notes(raised.value)
    assert 'force 1 "air"' in told and "drag is a force on nodes: given positions (1, 3)" in told
    assert "velocities (1, 6); to fill forces (1, 6)" in told

    model, *_ = oscillator(force=lambda _time: "one")
    with pytest.raises(TypeError) as raised:
        model.solve_periodic(2 * np.pi)
    assert "<lambda> is a signal, which returns a number" in notes(raised.value)


def test_nodes_apart_take_blocks_of_tangents():
    calls = []

    def drag(state, values):
        calls.append(values)
        values.forces[:, :3] = -0.2 * state.velocities[:, :3]
        if values.by_motion is not None:
            assert values.by_velocity.shape == (3, 6, 6)
            values.by_velocity[:, :3, :3] = -0.2 * np.eye(3)

    def solved(apart, tangents):
        model = pdn.Model()
        nodes = []
        for x in range(3):
            nodes.append(model.add_rigid_body(1 + x, [x, 0, 0], np.eye(3)))
            slide = model.add_prismatic(pdn.GROUND, nodes[-1], [x, 0, 0], [0, 0, 1])
            model.add_spring_damper(slide, pdn.DISPLACEMENT, 5, 0.1, 0)
            model.add_load(nodes[-1], pdn.FRAME_SPACE, pdn.FORCE_3, np.cos)
        force = model.add_user_force(nodes, pdn.FRAME_SPACE, tangents, drag)
        if apart:
            model.declare_nodes_apart(force)
        assert model.force(force).nodes_apart == apart
        if tangents == pdn.TANGENTS_GIVEN:
            assert model.check_tangents(force, 2 * np.pi).error < 1e-6
        calls.clear()
        solution = model.solve_periodic(2 * np.pi)
        values = [solution.sample(pdn.Quantity(pdn.NODE_POSITION, node), 1.0) for node in nodes]
        return np.array(values), len(calls)

    expected, many = solved(False, pdn.TANGENTS_DIFFERENCED)
    for tangents in pdn.TANGENTS_DIFFERENCED, pdn.TANGENTS_GIVEN:
        found, few = solved(True, tangents)
        np.testing.assert_allclose(found, expected, atol=1e-12)
        assert few < many / 2


def test_functions_live_as_long_as_they_are_needed():
    model, body, *_ = oscillator(force=lambda time: np.cos(time))
    solution = model.solve_periodic(2 * np.pi)
    del model
    gc.collect()
    again = solution.model().solve_periodic(2 * np.pi)
    assert (
        again.sample(pdn.Quantity(pdn.NODE_POSITION, body), 0.0)[0, 0]
        == solution.sample(pdn.Quantity(pdn.NODE_POSITION, body), 0.0)[0, 0]
    )


def test_progress_sees_iterations_and_cancels():
    model, *_ = oscillator()
    numbers = []
    model.solve_periodic(2 * np.pi, progress=lambda told: numbers.append(told.iteration))
    assert max(numbers) >= 1
    stopped = model.solve_periodic(2 * np.pi, progress=lambda _told: True)
    assert stopped.outcome_name == "CANCELLED" and not stopped.converged

    def broken(_told):
        raise RuntimeError("in progress")

    with pytest.raises(RuntimeError, match="in progress"):
        model.solve_periodic(2 * np.pi, progress=broken)
    with pytest.raises(pdn.Error, match="expected a function"):
        model.solve_periodic(2 * np.pi, progress=3)


def test_control_c_ends_a_solve():
    model, *_ = oscillator()
    # What runs in the background may have been told to ignore it.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
    timer.start()
    began = time.monotonic()
    try:
        with pytest.raises(KeyboardInterrupt):
            model.solve_march(duration=1e6, step=1e-2, period=1.0, stored_periods=1)
    finally:
        signal.signal(signal.SIGINT, before)
    timer.join()
    assert time.monotonic() - began < 30


def test_forces_on_nodes_with_tangents():
    """A spring of stiffness 5 with a damper of 0.2, written twice."""
    def force(state, values):
        values.forces[0, 0] = -5 * state.positions[0, 0] - 0.2 * state.velocities[0, 0]
        if values.by_motion is not None:
            values.by_motion[0, 0] = -5
            values.by_velocity[0, 0] = -0.2

    model, body, *_ = oscillator(stiffness=0.0, damping=0.0)
    user = model.add_user_force([body], pdn.FRAME_SPACE, pdn.TANGENTS_GIVEN, force)
    assert model.check_tangents(user, 2 * np.pi).error < 1e-6
    expected, same, *_ = oscillator(stiffness=5.0, damping=0.2)
    np.testing.assert_allclose(
        model.solve_periodic(2 * np.pi).sample(pdn.Quantity(pdn.NODE_POSITION, body), 1.0),
        expected.solve_periodic(2 * np.pi).sample(pdn.Quantity(pdn.NODE_POSITION, same), 1.0),
        atol=1e-12,
    )


def test_tangents_are_row_by_column():
    """A force along axis 1 that a turn about axis 3 makes: row 0, column 5."""
    def force(state, values):
        values.forces[0, 0] = 2 * state.rotations[0, 1, 0]
        if values.by_motion is not None:
            values.by_motion[0, 3:] = [-2 * state.rotations[0, 2, 0], 0,
                                       2 * state.rotations[0, 0, 0]]

    model = pdn.Model()
    body = model.add_rigid_body(1, [0, 0, 0], np.eye(3))
    joint = model.add_free_joint(pdn.GROUND, body, [0, 0, 0])
    for coordinate in range(pdn.DISPLACEMENT, pdn.ROTATION_3 + 1):
        model.add_spring_damper(joint, coordinate, 10, 1, 0)
    user = model.add_user_force([body], pdn.FRAME_SPACE, pdn.TANGENTS_GIVEN, force)
    assert model.check_tangents(user, 1.0).error < 1e-6


def test_a_function_along_a_beam_is_the_load_that_it_gives():
    """A lift, linear along two elements, and drag, which takes a velocity that there is not."""
    section = pdn.Section().set_diagonal([8e3, 3e3, 3e3, 14, 9, 25], [0.3, 1e-5, 5e-6, 5e-6])

    def bent(tangents):
        model = pdn.Model()
        beam = model.add_straight_beam([0, 0, 0], [1, 0, 0], [0, 1, 0], section, 2, 3)
        model.add_rigid_joint(pdn.GROUND, beam.first, [0, 0, 0])
        if tangents is None:
            lift = pdn.Signal().set_constant(3.0)
            model.add_distributed_load(beam.first_element, 2, pdn.FRAME_MATERIAL, pdn.FORCE_3,
                                       lift, [0, 1], [1, 2])
        else:
            def wind(state, values):
                along = (state.element - beam.first_element + (state.places[:, 0] + 1) / 2) / 2
                np.testing.assert_allclose(state.sizes.sum(), 0.5)
                assert state.rotations.shape[1:] == (3, 3) and not state.places[:, 1].any()
                values.forces[:, 2] = 3 * (1 + along) - 0.1 * state.velocities[:, 2]
                if values.by_velocity is not None:
                    values.by_velocity[:, 2, 2] = -0.1

            force = model.add_line_force(beam.first_element, 2, pdn.FRAME_MATERIAL, tangents, wind)
            assert model.force(force + 1).kind == pdn.FORCE_IS_LINE_FORCE
            assert model.force(force + 1).beam_element == beam.first_element + 1
            if tangents == pdn.TANGENTS_GIVEN:
                assert model.check_tangents(force, 1.0).error < 1e-7
        return model.solve_static().sample(pdn.Quantity(pdn.NODE_POSITION, beam.last), [0])[0]

    wanted = bent(None)
    assert wanted[2] > 0.05
    for tangents in (pdn.TANGENTS_GIVEN, pdn.TANGENTS_DIFFERENCED):
        np.testing.assert_allclose(bent(tangents), wanted, rtol=0, atol=1e-12)


def test_laws_with_and_without_derivatives():
    expected, node, *_ = oscillator()
    wanted = expected.solve_periodic(2 * np.pi).sample(pdn.Quantity(pdn.NODE_POSITION, node), 1.0)
    laws = {
        pdn.TANGENTS_DIFFERENCED: lambda _time, x, v: 3 * x,
        pdn.TANGENTS_GIVEN: lambda _time, x, v: (3 * x, (3, 0)),
    }
    for tangents, law in laws.items():
        model, body, joint, _ = oscillator(stiffness=1.0)
        model.add_coordinate_law(joint, pdn.DISPLACEMENT, tangents, law)
        found = model.solve_periodic(2 * np.pi).sample(pdn.Quantity(pdn.NODE_POSITION, body), 1.0)
        np.testing.assert_allclose(found, wanted, atol=1e-10)


def test_solves_run_on_threads_at_once():
    """A solve does not hold the interpreter: another thread counts on."""
    model, *_ = oscillator(force=0.0, damping=0.0)
    done = threading.Event()

    def solve():
        model.solve_march(duration=300.0, step=1e-2)
        done.set()

    thread = threading.Thread(target=solve)
    thread.start()
    counted = 0
    while not done.is_set() and counted < 10**6:
        counted += 1
        time.sleep(0.001)
    thread.join()
    assert counted > 3


def test_functions_come_back_to_a_model_from_a_file(tmp_path):
    def law(time, coordinate, rate):
        return 4 * coordinate, (4, 0)

    def drag(state, values):
        values.forces[0, :3] = -0.5 * state.velocities[0, :3]

    model = pdn.Model()
    body = model.add_rigid_body(1, np.zeros(3), np.eye(3))
    slide = model.add_prismatic(pdn.GROUND, body, np.zeros(3), [1, 0, 0])
    model.add_coordinate_law(slide, pdn.DISPLACEMENT, pdn.TANGENTS_GIVEN, law)
    model.add_user_force([body], pdn.FRAME_SPACE, pdn.TANGENTS_DIFFERENCED, drag)
    push = model.add_actuator(slide, pdn.DISPLACEMENT, np.cos)
    wanted = model.solve_periodic(2 * np.pi).sample(pdn.Quantity(pdn.NODE_POSITION, body), [0, 1])
    model.save(tmp_path / "model.pdm")
    loaded = pdn.Model.load(tmp_path / "model.pdm")
    with pytest.raises(pdn.Error, match="bind it again"):
        loaded.solve_periodic(2 * np.pi)
    loaded.bind_coordinate_law(pdn.FIRST_FORCE, pdn.TANGENTS_GIVEN, law)
    loaded.bind_user_force(pdn.FIRST_FORCE + 1, pdn.FRAME_SPACE, pdn.TANGENTS_DIFFERENCED, drag)
    loaded.set_signal(push, 0, np.cos)
    found = loaded.solve_periodic(2 * np.pi).sample(pdn.Quantity(pdn.NODE_POSITION, body), [0, 1])
    np.testing.assert_array_equal(found, wanted)
