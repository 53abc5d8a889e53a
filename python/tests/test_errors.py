"""Wrong arguments are refused with what was expected and what came; the model stays usable."""

import subprocess
import sys

import numpy as np
import pytest
from models import oscillator

import periodyn as pdn

MODEL, BODY, JOINT, _ = oscillator()


@pytest.mark.parametrize("call, message, status", [
    (lambda: MODEL.add_rigid_body(-1, [0, 0, 0], np.eye(3)), "mass: expected zero or more, got -1",
     "PDN_ERR_VALUE"),
    (lambda: MODEL.add_rigid_body(1, [0, 0], np.eye(3)), "centre: expected an array of 3, got 2",
     "PDN_ERR_SIZE"),
    (lambda: MODEL.add_rigid_body(1, [0, 0, 0], np.ones(9)),
     "inertia: expected an array of 3 x 3, got 9", "PDN_ERR_SIZE"),
    (lambda: MODEL.add_rigid_body(1, "here", np.eye(3)), "centre: expected numbers",
     "PDN_ERR_VALUE"),
    (lambda: MODEL.add_rigid_body(1, [0, 0, np.nan], np.eye(3)), "centre", "PDN_ERR_NOT_FINITE"),
    (lambda: MODEL.add_spring_damper(99, pdn.DISPLACEMENT, 1, 1, 0), "joint: expected",
     "PDN_ERR_ID"),
    (lambda: MODEL.add_user_force([0.5], pdn.FRAME_SPACE, 0, print), "nodes: expected a list of",
     "PDN_ERR_ID"),
    (lambda: MODEL.add_load(BODY, pdn.FRAME_SPACE, pdn.FORCE_1, "cos"),
     "signal: expected a signal, a number or a function, got 'cos'", "PDN_ERR_VALUE"),
    (lambda: MODEL.add_straight_beam([0, 0, 0], [1, 0, 0], [0, 1, 0], 3.0, 1, 1),
     "section: expected a Section, got 3.0", "PDN_ERR_VALUE"),
    (lambda: MODEL.add_rigid_body(None, [0, 0, 0], np.eye(3)), "mass: expected a number, got None",
     "PDN_ERR_VALUE"),
    (lambda: MODEL.add_revolute(pdn.GROUND, 1.5, [0, 0, 0], [0, 0, 1]),
     "second: expected a whole number, got 1.5", "PDN_ERR_VALUE"),
    (lambda: MODEL.prescribe(JOINT, "rotation", 0),
     "coordinate: expected a whole number, got 'rotation'", "PDN_ERR_VALUE"),
    (lambda: MODEL.set_label(2**40, "far"),
     "id: expected a whole number, got 1099511627776", "PDN_ERR_VALUE"),
    (lambda: pdn.Signal().set_samples(0, [1, 2, 3]), "rate: expected a number, got [1, 2, 3]",
     "PDN_ERR_VALUE"),
    (lambda: MODEL.solve_periodic(2 * np.pi, grid_points=10), "expected an odd number, got 10",
     "PDN_ERR_SIZE"),
    (lambda: MODEL.solve_periodic(2 * np.pi, grid_points=-3), "grid_points", "PDN_ERR_VALUE"),
    (lambda: MODEL.solve_periodic(2 * np.pi, initial=3), "initial: expected a handle",
     "PDN_ERR_VALUE"),
    (lambda: MODEL.solve_periodic(2 * np.pi, grid_points=5, guess_positions=np.zeros((1, 4, 3))),
     "guess_positions: expected an array of 1 x 5 x 3, got 1 x 4 x 3", "PDN_ERR_SIZE"),
    (lambda: pdn.Signal().set_harmonics(cosines=[1, 2], sines=[1]),
     "sines: expected an array of 2, got 1", "PDN_ERR_SIZE"),
    (lambda: pdn.Solution.load("/nowhere"), "/nowhere", "PDN_ERR_IO"),
])
def test_wrong_arguments(call, message, status):
    nodes = MODEL.node_count()
    with pytest.raises(pdn.Error) as raised:
        call()
    assert message in str(raised.value)
    assert raised.value.status == status
    assert MODEL.node_count() == nodes
    assert MODEL.solve_periodic(2 * np.pi).converged


def test_unknown_options_are_refused():
    with pytest.raises(TypeError):
        MODEL.solve_periodic(2 * np.pi, grid=11)
    with pytest.raises(TypeError, match="no field"):
        pdn.PeriodicOptions(grid=11)


def test_counts_that_are_none_are_named():
    model, body, *_ = oscillator()
    solution = model.solve_periodic(2 * np.pi)
    position = pdn.Quantity(pdn.NODE_POSITION, body)
    for count, what in ((-1, "at least 0"), (2.5, "a whole number")):
        with pytest.raises(pdn.Error, match=f"^harmonics: expected {what}, got {count}"):
            solution.harmonics(position, count)


def test_importing_takes_little():
    # What takes long to load is loaded where it is needed, unless numpy needs it, too.
    script = ("import sys, numpy; before = set(sys.modules); import periodyn; "
              "print(*sorted(set(sys.modules) - before))")
    done = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True,
                          text=True)
    loaded = done.stdout.split()
    assert "periodyn._interface" in loaded
    slow = {"pathlib", "tempfile", "multiprocessing", "concurrent", "asyncio", "inspect", "cffi",
            "urllib", "logging", "matplotlib", "pandas", "dataclasses", "json", "typing"}
    assert not slow & {name.partition(".")[0] for name in loaded}
