"""The rotor of the NREL 5-MW turbine: its harmonics are those of a march, and of all its blades."""

import pathlib
import sys

import numpy as np
import pytest

import periodyn as pdn

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "examples"))
import nrel_5mw_rotor as rotor  # noqa: E402


@pytest.fixture(scope="module", name="whole")
def whole_rotor():
    """Solved for all three blades."""
    model, _, roots = rotor.build(alike=False)
    return model, roots[0], model.solve_periodic(rotor.PERIOD)


def harmonics(solution, root):
    """Of lag and flap moments, complex, from the mean to the sixth."""
    return np.array([np.fft.rfft(moment)[:7] / len(moment)
                     for moment in rotor.root_moments(solution, root)])


def test_tangents(whole):
    model, *_ = whole
    for number in range(12):
        assert model.check_tangents(pdn.FIRST_FORCE + number, rotor.PERIOD).error < 1e-8


def test_one_blade_is_as_all(whole):
    _, root, all_of_them = whole
    model, _, roots = rotor.build()
    alike = model.solve_periodic(rotor.PERIOD)
    assert all_of_them.outcome_name == alike.outcome_name == "CONVERGED"
    found, wanted = harmonics(alike, roots[0]), harmonics(all_of_them, root)
    # Motions are right to 1e-6 of the rotor's size, moments to three digits less.
    np.testing.assert_allclose(found, wanted, atol=1e-4 * abs(wanted).max())


def test_harmonics_are_those_of_a_march(whole):
    model, root, solution = whole
    marched = [harmonics(model.solve_march(duration=rotor.PERIOD, period=rotor.PERIOD,
                                           steps_per_period=steps, initial=solution), root)
               for steps in (400, 800)]
    found = harmonics(solution, root)
    # The march's error falls with the square of its step: a third of what halving it changes.
    error = abs(marched[1] - marched[0]) / 3
    away = abs(marched[1] - found)
    floor = 1e-5 * abs(found).max()
    assert (away <= 1.1 * error + floor).all()
    # What is left once the march's error is taken away is small beside it: the next term of the
    # error, which is of higher order (6 % with half as many steps, a fourth of that here).
    better = marched[1] + (marched[1] - marched[0]) / 3
    assert abs(better - found).max() < 0.05 * error.max()
    # The test sees errors of moments of 9 MN m from 1e-5 on.
    assert error.max() < 1e-5 * abs(found).max()
