"""Animations show what moves, where it is, and colours of the results."""

import numpy as np
import pytest

import periodyn as pdn

pyvista = pytest.importorskip("pyvista")
imageio = pytest.importorskip("imageio.v3")
animation = pytest.importorskip("periodyn.animation")
TIMES = np.linspace(0, 1, 5)
LENGTH, LOW = 2.0, 0.5


@pytest.fixture(scope="module")
def solution():
    """A beam and a strip of shells that a motor turns about axis 3 at 2 pi, and a body at rest."""
    model = pdn.Model()
    section = pdn.Section().set_diagonal([2e7, 7e6, 7e6, 150, 200, 200], [0.8, 2e-5, 1e-5, 1e-5])
    beam = model.add_straight_beam([0, 0, 0], [LENGTH, 0, 0], [0, 1, 0], section, 2, 3)
    strip = pdn.Surface().set_parallelogram([0, -0.2, LOW], [LENGTH, 0, 0], [0, 0.4, 0])
    rubber = pdn.ShellSection().set_isotropic(0.02, 3e8, 0, 1200)
    shell = model.add_shell(strip, 2, 1, 2, 1, rubber)
    body = model.add_rigid_body(1, [0, 0, 1], np.eye(3))
    model.add_rigid_joint(pdn.GROUND, body, [0, 0, 1])
    motor = model.add_revolute(pdn.GROUND, beam.first, [0, 0, 0], [0, 0, 1])
    model.add_rigid_edge(beam.first, shell, pdn.SHELL_EDGE_START_XI)
    model.prescribe(motor, pdn.ROTATION, pdn.Signal().set_harmonics(rate=2 * np.pi))
    solution = model.solve_periodic(1.0, grid_points=5)
    assert solution.converged
    return solution


def drawn(film, name):
    return film.plotter.actors[name].mapper.dataset


@pytest.mark.parametrize("number", [0, 1, 2])
def test_what_is_drawn_is_where_the_solution_is(solution, number):
    film = animation.Animation(solution, TIMES, radius=0.05, off_screen=True)
    film.draw(number)
    sides = [np.ptp(np.reshape(drawn(film, name).bounds, (3, 2)), axis=1)
             for name in ("beams", "shells", "bodies")]
    # A quarter of a turn for each number. Centrifugal loads stretch by 2e-6 and 2e-4.
    turned = [1, 0, 2] if number == 1 else [0, 1, 2]
    np.testing.assert_allclose(sides[0][turned], [LENGTH, 0.1, 0.1], atol=1e-3)
    np.testing.assert_allclose(sides[1][turned], [LENGTH, 0.4, 0], atol=1e-3)
    np.testing.assert_allclose(drawn(film, "bodies").points, [[0, 0, 1]], atol=1e-12)
    # From the reference: the chord of what was turned.
    chord = 2 * LENGTH * np.sin(number * np.pi / 4)
    assert drawn(film, "beams").point_data["shown"].max() == pytest.approx(chord, abs=1e-3)
    assert drawn(film, "bodies").point_data["shown"] == pytest.approx(0, abs=1e-12)


def test_colours_have_the_range_of_all_times(solution):
    film = animation.Animation(solution, TIMES, "displacement", component=0, off_screen=True)
    # Back by twice the length at half a turn.
    low, high = film.plotter.actors["beams"].mapper.scalar_range
    assert (low, high) == pytest.approx((-2 * LENGTH, 0.2), abs=1e-3)
    assert "displacement 1" in film.plotter.scalar_bars.keys()
    # Of beams and shells alone: the pull at the root, that of a bar that turns.
    film = animation.Animation(solution, TIMES, "von_mises_top", off_screen=True)
    assert "shown" not in drawn(film, "beams").point_data
    pull = 1200 * (2 * np.pi * LENGTH) ** 2 / 2
    assert drawn(film, "shells").point_data["shown"].max() == pytest.approx(pull, rel=0.1)


def test_a_film(solution, tmp_path):
    path = tmp_path / "motion.gif"
    animation.Animation(solution, TIMES, off_screen=True, window_size=[160, 120]).write(path)
    frames = imageio.imread(path)
    assert frames.shape[:3] == (len(TIMES), 120, 160)
    apart = [np.mean(frames[k] != frames[0]) for k in range(len(TIMES))]
    assert min(apart[1:4]) > 0.02  # the last is a whole turn later


def test_the_slider_chooses_the_time(solution):
    film = animation.Animation(solution, TIMES, off_screen=True)
    film.show(auto_close=False)
    slider, = film.plotter.widgets.slider_widgets
    slider.GetRepresentation().SetValue(0.55)
    slider.InvokeEvent("EndInteractionEvent")
    assert drawn(film, "beams").point_data["shown"].max() == pytest.approx(2 * LENGTH, abs=1e-3)
    film.plotter.close()


def test_what_is_not_there_is_refused(solution):
    with pytest.raises(pdn.Error, match="result: expected one of .*displacement.*, got colour"):
        animation.Animation(solution, TIMES, "colour")
    with pytest.raises(pdn.Error, match="component: expected 0 to 2, got 3"):
        animation.Animation(solution, TIMES, component=3)
