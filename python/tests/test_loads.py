"""Root mean squares and cycles of what repeats itself."""

import numpy as np
import pytest
from models import oscillator

import periodyn as pdn
from periodyn import loads


def test_rms_is_that_of_the_harmonics():
    model, body, joint, _ = oscillator()
    solution = model.solve_periodic(2 * np.pi)
    moved = pdn.Quantity(pdn.JOINT_COORDINATE, joint, pdn.DISPLACEMENT)
    mean, _, cosines, sines = solution.harmonics(moved, 3)
    wanted = (np.sum(cosines**2) + np.sum(sines**2)) / 2
    assert wanted > 0
    assert loads.rms(solution, moved) == pytest.approx(np.sqrt(wanted + mean**2), rel=1e-12)
    assert loads.rms(solution, moved, about_mean=True) == pytest.approx(np.sqrt(wanted), rel=1e-12)
    position = pdn.Quantity(pdn.NODE_POSITION, body)
    assert loads.rms(solution, position).shape == (3,)
    times, values = loads.history(solution, moved, 7)
    assert times[1] == pytest.approx(2 * np.pi / 7) and values.shape == (7,)


def test_rainflow_of_the_standard():
    # ASTM E1049-85, 5.4.5 and figure 7, from D, which is the largest
    history = [5, -1, 3, -4, 4, -2, 1, -3]
    for start in range(8):
        ranges, means = loads.rainflow(np.roll(history, start))
        assert sorted(ranges) == [3, 4, 7, 9]
        assert dict(zip(ranges, means)) == {3: -0.5, 4: 1, 7: 0.5, 9: 0.5}


def test_rainflow_of_curves():
    angles = 2 * np.pi * np.arange(400) / 400
    ranges, means = loads.rainflow(2 + np.cos(angles))
    assert ranges == pytest.approx([2]) and means == pytest.approx([2])
    # a small ripple on it: as many cycles as there are ripples, and the large one
    ranges, _ = loads.rainflow(np.cos(angles) + 0.5 * np.cos(5 * angles))
    assert len(ranges) == 5
    assert max(ranges) == pytest.approx(3)
    assert loads.rainflow(np.ones(5))[0].shape == (0,)
    # plateaus are no turns
    assert sorted(loads.rainflow([0, 0, 1, 1, 0, 2, 2])[0]) == [1, 2]


@pytest.mark.parametrize("values", [[], [[1, 2], [3, 4]], 3.0])
def test_what_is_no_history_is_refused(values):
    with pytest.raises(pdn.Error, match="values: expected those of one component"):
        loads.rainflow(values)
