"""Pictures hold what they are made of."""

import pathlib
import re
import subprocess
import sys

import matplotlib
import numpy as np
import pytest
from models import cantilever, oscillator

import periodyn as pdn

matplotlib.use("Agg")
ROOT = pathlib.Path(__file__).parents[2]
plot = pytest.importorskip("periodyn.plot")


@pytest.fixture(autouse=True)
def no_drawing_is_left():
    """Which programs that tests run in this process would go on in."""
    yield
    matplotlib.pyplot.close("all")


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


def test_joints_and_elements_are_drawn(tmp_path):
    subprocess.run([sys.executable, ROOT / "script/draw_joints", tmp_path], check=True)
    page = (ROOT / "docs/joints.md").read_text(encoding="utf-8")
    table = page.partition("## The joints")[2].partition("## Names")[0]
    joints = re.findall(r"^\| (\w+)[^|]* \| [^|]+ \| \d ", table, re.M)
    assert len(joints) == 10
    for name, titles in [("joints", joints), ("elements", ["beam element", "bushing"])]:
        drawn = (tmp_path / f"{name}.svg").read_text(encoding="utf-8")
        kept = (ROOT / f"docs/images/{name}.svg").read_text(encoding="utf-8")
        for title in titles:
            assert f">{title}</text>" in drawn and f">{title}</text>" in kept
