"""Pictures hold what they are made of."""

import matplotlib
import numpy as np
import pytest
from models import cantilever, oscillator

import periodyn as pdn

matplotlib.use("Agg")
plot = pytest.importorskip("periodyn.plot")


def test_curves_of_a_solve():
    model, _, joint, _ = oscillator()
    solution = model.solve_periodic(2 * np.pi)
    drawn = plot.decay(solution).lines[0].get_ydata()
    assert len(drawn) == len(solution.decay())
    assert len(plot.iterations(solution).lines) == 2
    mean, _, cosines, sines = solution.harmonics(
        pdn.Quantity(pdn.JOINT_COORDINATE, joint, pdn.DISPLACEMENT), 3
    )
    heights = [bar.get_height() for bar in plot.harmonics(mean, cosines, sines).patches]
    assert heights[1] == pytest.approx(1 / abs(3 + 0.1j))
    with pytest.raises(ValueError, match="choose a column"):
        plot.harmonics(np.zeros(3), np.zeros((2, 3)), np.zeros((2, 3)))


def test_lines_in_space():
    model, beam, _ = cantilever()
    axes = plot.lines(model.solve_static(), [range(beam.first, beam.last + 1)], [0.0])
    assert len(axes.lines) == 1
