"""Results against closed forms, and their shapes."""

import json
import pickle

import numpy as np
import pytest
from models import cantilever, oscillator, solution_for

import periodyn as pdn

TIMES = np.linspace(0, 2 * np.pi, 9)


def exact(times, stiffness=4.0, damping=0.1):
    return np.real(np.exp(1j * times) / (stiffness - 1 + 1j * damping))


@pytest.mark.parametrize("force", [
    np.cos,
    pdn.Signal().set_harmonics(cosines=[1], sines=[0]),
    pdn.Signal().set_harmonics(cosines=[1]),
    pdn.Signal().set_samples(np.cos(2 * np.pi * np.arange(8) / 8)),
], ids=["function", "harmonics", "cosines alone", "samples"])
def test_an_oscillator_follows_its_force(force):
    model, body, joint, spring = oscillator(force=force)
    solution = model.solve_periodic(2 * np.pi)
    assert solution.converged and solution.outcome_name == "CONVERGED"
    assert "converged" in str(solution)
    position = solution.sample(pdn.Quantity(pdn.NODE_POSITION, body), TIMES)
    assert position.shape == (9, 3)
    np.testing.assert_allclose(position[:, 0], exact(TIMES), atol=1e-12)
    coordinate = solution.sample(pdn.Quantity(pdn.JOINT_COORDINATE, joint, pdn.DISPLACEMENT), TIMES)
    np.testing.assert_allclose(coordinate, exact(TIMES), atol=1e-12)
    rate = solution.sample(pdn.Quantity(pdn.JOINT_RATE, joint, pdn.DISPLACEMENT), TIMES)
    np.testing.assert_allclose(
        solution.sample(pdn.Quantity(pdn.FORCE_EFFORT, spring), TIMES),
        4 * coordinate + 0.1 * rate,
        atol=1e-12,
    )
    mean, _, cosines, sines = solution.harmonics(pdn.Quantity(pdn.NODE_POSITION, body), 3)
    assert mean.shape == (3,) and cosines.shape == sines.shape == (3, 3)
    factor = 1 / (3 + 0.1j)
    np.testing.assert_allclose([cosines[0, 0], sines[0, 0]], [factor.real, -factor.imag],
                               atol=1e-12)
    mean, rate, cosines, sines = solution.harmonics(
        pdn.Quantity(pdn.JOINT_COORDINATE, joint, pdn.DISPLACEMENT), 3
    )
    assert mean.shape == () and cosines.shape == (3,)
    assert len(solution.decay()) == (solution.diagnostics().grid_points + 1) // 2
    assert len(solution.history()[0]) == solution.diagnostics().iterations


def test_matrices_are_rows_by_columns():
    model = pdn.Model()
    turned = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]])
    node = model.add_node([1, 2, 3], turned)
    frame = model.node_frame(node)
    np.testing.assert_array_equal(frame.rotation, turned)
    np.testing.assert_array_equal(frame.position, [1, 2, 3])
    model.add_mass(node, 1, [1, 2, 3], np.eye(3))
    model.add_joint(pdn.JOINT_RIGID, pdn.GROUND, node, frame, frame)
    rotation = model.solve_static().sample(pdn.Quantity(pdn.NODE_ROTATION, node), [0.0, 1.0])
    # Column by column.
    assert rotation.shape == (2, 9)
    rotation = rotation.reshape(2, 3, 3).swapaxes(1, 2)
    np.testing.assert_allclose(rotation, [turned, turned], atol=1e-12)

    # A section whose damping couples axial rate to a moment only: row 0, column 4.
    section = pdn.Section().set_diagonal([1] * 6, [1] * 4)
    section.damping[0, 4] = 3
    assert section._c.damping[4 * 6 + 0] == 3
    assert section.damping[0, 4] == 3


def test_a_turning_frame_is_found_again():
    angles = 2 * np.pi * np.arange(5) / 5
    rotations = np.array([[[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]]
                          for a in angles])
    position, rotation, velocity, acceleration = pdn.motion_interpolate(
        1.0, np.zeros((5, 3)), rotations, [0.3])
    angle = 2 * np.pi * 0.3
    np.testing.assert_allclose(rotation[0, :2, 0], [np.cos(angle), np.sin(angle)], atol=1e-12)
    np.testing.assert_allclose(velocity[0], [0, 0, 0, 0, 0, 2 * np.pi], atol=1e-12)
    # δω = dδψ/dt + ω × δψ, for δψ that is the same at all times, about axis 2 or 1
    _, _, velocity_tangent, _ = pdn.motion_grid_kinematics(1.0, np.zeros((5, 3)), rotations)
    assert velocity_tangent.shape == (30, 30)
    assert velocity_tangent[3, 4::6].sum() == pytest.approx(-2 * np.pi)
    assert velocity_tangent[4, 3::6].sum() == pytest.approx(2 * np.pi)


def test_a_cantilever_bends_and_vibrates():
    model, beam, bending = cantilever()
    static = model.solve_static()
    deflection = static.sample(pdn.Quantity(pdn.NODE_POSITION, beam.last), 0.0)[0, 2]
    assert deflection == pytest.approx(1 / (3 * bending), rel=1e-4)
    modes = model.solve_modes(count=4)
    assert len(modes) == 4 and modes.converged
    first = 1.875104068711961**2 / (2 * np.pi) * np.sqrt(bending / 0.8)
    np.testing.assert_allclose(modes.frequencies[:2], first, rtol=1e-3)
    real, imaginary = modes.shape(0, [beam.first, beam.last])
    assert real.shape == (2, 6) and abs(real[1]).max() > 0.5
    with pytest.raises(IndexError):
        modes[4]


def test_stations_along_a_line():
    root = pdn.Section().set_diagonal([2e7, 7e6, 7e6, 150, 200, 200], [0.8, 2e-5, 1e-5, 1e-5])
    tip = pdn.Section().set_diagonal([1e7, 3e6, 3e6, 50, 60, 60], [0.4, 1e-5, 5e-6, 5e-6])
    line = pdn.Line().set_curve(lambda x: ([x, 0, 0], [0, 1, 0]))
    stations = pdn.Stations(fractions=[0, 1], sections=[root, tip], twists=[0, 0.1])
    model = pdn.Model()
    model.add_beam(line, stations, 4, 3)
    mass, centre = model.mass()
    assert mass == pytest.approx(0.6)
    assert centre[0] == pytest.approx((0.8 / 2 - 0.4 / 3) / 0.6)
    with pytest.raises(pdn.Error, match="fractions: expected an array of 2, got 3"):
        wrong = pdn.Stations(fractions=[0, 0.5, 1], sections=[root, tip])
        model.add_beam(line, wrong, 4, 3)


def test_solutions_are_pickled_and_read_again(tmp_path):
    solution = solution_for(4.0)
    again = pickle.loads(pickle.dumps(solution))
    kept, given = (
        s.sample(pdn.Quantity(pdn.NODE_POSITION, pdn.FIRST_NODE), TIMES) for s in (again, solution)
    )
    np.testing.assert_array_equal(kept, given)
    solution.save(tmp_path / "saved")
    assert pdn.Solution.load(tmp_path / "saved").model().node_count() == 1


def test_models_are_copied_pickled_and_read_again(tmp_path):
    model, body, *_ = oscillator(force=pdn.Signal().set_harmonics(cosines=[1]))
    wanted = model.solve_periodic(2 * np.pi).sample(pdn.Quantity(pdn.NODE_POSITION, body), TIMES)
    model.save(tmp_path / "model")
    others = [model.copy(), pickle.loads(pickle.dumps(model)), pdn.Model.load(tmp_path / "model")]
    for other in others:
        other.add_node([1, 2, 3])
        assert other.node_count() == model.node_count() + 1
    model.add_load(body, pdn.FRAME_SPACE, pdn.FORCE_1, 1.0)
    again = pdn.Model.load(tmp_path / "model").solve_periodic(2 * np.pi)
    np.testing.assert_array_equal(
        again.sample(pdn.Quantity(pdn.NODE_POSITION, body), TIMES), wanted
    )

    # Functions go with copies, but not into files.
    model, body, *_ = oscillator(force=np.cos)
    copy = model.copy()
    del model
    found = copy.solve_periodic(2 * np.pi).sample(pdn.Quantity(pdn.NODE_POSITION, body), TIMES)
    np.testing.assert_allclose(found, wanted, atol=1e-12)
    with pytest.raises(pdn.Error, match="loaded from a file"):
        pickle.loads(pickle.dumps(copy)).solve_periodic(2 * np.pi)


def test_tables(tmp_path):
    solution = solution_for(4.0)
    table = pdn.Table(TIMES)
    table.add_quantity(solution, pdn.Quantity(pdn.NODE_POSITION, pdn.FIRST_NODE), "mass")
    table.add_values("twice", 2 * TIMES)
    table.write_csv(tmp_path / "table.csv")
    read = np.genfromtxt(tmp_path / "table.csv", delimiter=",", names=True)
    np.testing.assert_array_equal(read["t"], TIMES)
    np.testing.assert_allclose(read["massx"], exact(TIMES), atol=1e-12)
    frame = pytest.importorskip("pandas") and table.to_frame()
    assert list(frame.columns) == ["t", "mass.x", "mass.y", "mass.z", "twice"]


def test_a_start_that_is_the_motion_itself_is_kept():
    model = pdn.Model()
    arm, tip = (model.add_rigid_body(1, [x, 0, 0], np.eye(3)) for x in (1, 2))
    model.add_rigid_joint(arm, tip, [1.5, 0, 0])
    hinge = model.add_revolute(pdn.GROUND, arm, [0, 0, 0], [0, 0, 1])
    model.prescribe(hinge, pdn.ROTATION, lambda time: 0.3 * np.sin(2 * time))
    angles = 0.3 * np.sin(2 * np.pi * np.arange(11) / 11)
    turns = np.zeros((11, 3, 3))
    turns[:, 0, 0] = turns[:, 1, 1] = np.cos(angles)
    turns[:, 1, 0] = np.sin(angles)
    turns[:, 0, 1] = -np.sin(angles)
    turns[:, 2, 2] = 1
    increments = []
    along = turns[:, :, 0]
    model.solve_periodic(np.pi, grid_points=11, guess_positions=[along, 2 * along],
                         guess_rotations=[turns, turns],
                         progress=lambda told: increments.append(told.increment))
    assert len(increments) == 1 and increments[0] < 1e-14
    # Of several nodes a march begins where it is told, too.
    march = model.solve_march(duration=1e-3, step=1e-3, positions=[[1, 0, 0], [2, 0, 0]],
                        rotations=[np.eye(3)] * 2, velocities=[[0, 0.6, 0, 0, 0, 0.6],
                                                               [0, 1.2, 0, 0, 0, 0.6]])
    np.testing.assert_allclose(
        march.sample(pdn.Quantity(pdn.NODE_POSITION, tip), [0.0])[0], [2, 0, 0], atol=1e-14
    )


def test_marches_start_where_they_are_told():
    model, body, *_ = oscillator(damping=0.0, force=0.0)
    march = model.solve_march(duration=1.0, step=0.01, positions=[[1, 0, 0]], rotations=[np.eye(3)],
                        velocities=np.zeros((1, 6)))
    assert march.march().steps == 100
    end = march.sample(pdn.Quantity(pdn.NODE_POSITION, body), 1.0)[0, 0]
    assert end == pytest.approx(np.cos(2.0), abs=2e-3)
    with pytest.raises(pdn.Error, match="positions: expected an array of 1 x 3, got 2 x 3"):
        model.solve_march(duration=1.0, step=0.01, positions=np.zeros((2, 3)))


def test_reports_are_data_for_json():
    model, *_ = oscillator()
    solution = model.solve_periodic(2 * np.pi)
    told = json.loads(json.dumps(solution.as_dict(), allow_nan=False))
    figures = solution.diagnostics()
    assert told["outcome"] == "converged" and told["report"] == solution.report()
    assert told["kind"] == "periodic" and told["is_solution"] and told["explanation"] == ""
    assert told["grid_points"] == figures.grid_points and told["nodes"] == model.node_count()
    assert told["estimates"]["error_estimate"] == figures.error_estimate
    assert told["estimates"]["mesh_error"] == figures.mesh_error
    assert told["grids"][-1]["grid_points"] == figures.grid_points
    assert told["grids"][-1]["error_estimate"] == pytest.approx(figures.error_estimate)
    assert len(told["attempts"]) == figures.attempts
    assert told["seconds"]["total"] == figures.total_seconds
    assert told["seconds"]["parts"]["assembly"] == figures.assembly_seconds
    assert len(told["iterations"]) == figures.iterations > 0
    assert told["iterations"][-1]["increment"] == figures.last_increment
    # also of what did not converge, of equilibria and of marches
    stopped = model.solve_periodic(2 * np.pi, iteration_limit=1, tolerance=1e-300)
    others = [stopped, model.solve_static(),
              model.solve_march(duration=1, period=1, steps_per_period=10)]
    for other in others:
        told = json.loads(json.dumps(other.as_dict(), allow_nan=False))
        assert told["outcome"].upper() == other.outcome_name
    assert stopped.as_dict()["kind"] == "periodic" and not stopped.as_dict()["is_solution"]
    march = others[-1].as_dict()
    assert march["kind"] == "march" and march["estimates"]["error_estimate"] is None
    assert march["grids"] is None
