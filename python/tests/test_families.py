"""Parameters, conditions, branches and stability of an oscillator, by closed forms."""

import numpy as np
import pytest
from models import oscillator

import periodyn as pdn

FORCE = pdn.Signal().set_harmonics(cosines=[1])


def driven():
    """The oscillator with an actuator whose mean is a parameter, and what its coordinate is."""
    model, body, joint, spring = oscillator(force=FORCE)
    actuator = model.add_actuator(joint, pdn.DISPLACEMENT, 0.0)
    mean = model.add_parameter("mean", 0.0, 1.0)
    model.move_signal(mean, actuator, 0, pdn.PART_MEAN, 1.0)
    coordinate = pdn.Quantity(kind=pdn.JOINT_COORDINATE, object=joint,
                              component=pdn.DISPLACEMENT)
    return model, body, mean, coordinate


def test_quantities_are_what_the_functions_of_old_give():
    model, body, _, coordinate = driven()
    solution = model.solve_periodic(2 * np.pi)
    times = np.linspace(0, 6, 7)
    position = pdn.Quantity(kind=pdn.NODE_POSITION, object=body)
    sampled = solution.sample(position, times)
    np.testing.assert_array_equal(
        sampled, solution.sample(pdn.Quantity(pdn.NODE_POSITION, body), times)
    )
    amplitude = 1 / abs(3 + 0.1j)
    mean, _rate, cosines, sines = solution.harmonics(coordinate, 2)
    assert np.hypot(cosines[0], sines[0]) == pytest.approx(amplitude)
    least, _, largest, at = solution.extremes(coordinate)
    assert np.ravel(largest)[0] == pytest.approx(amplitude, rel=1e-6)
    assert np.ravel(least)[0] == pytest.approx(-amplitude, rel=1e-6)
    assert np.ravel(at)[0] == pytest.approx(np.angle(3 + 0.1j), abs=1e-3)


def test_a_mean_force_for_a_mean_position():
    model, _, mean, coordinate = driven()
    conditions = pdn.Conditions()
    conditions.release(mean)
    conditions.add_quantity(coordinate, pdn.FEATURE_MEAN, 0, 0.25, 0)
    solution = model.solve_conditioned(2 * np.pi, conditions)
    assert solution.converged
    assert solution.parameter(mean) == pytest.approx(1.0, abs=1e-10)


def test_what_a_mean_force_does_to_the_position():
    model, _, mean, coordinate = driven()
    asked = pdn.Sensitivities()
    asked.add_quantity(coordinate, pdn.FEATURE_MEAN)
    asked.add_quantity(coordinate, pdn.FEATURE_COSINE, 1)
    asked.add_parameter(mean)
    solution = model.solve_periodic(2 * np.pi)
    for method in [pdn.SENSITIVITY_DIRECT, pdn.SENSITIVITY_ADJOINT]:
        derivatives = solution.sensitivities(asked, 2, 1, method=method)
        np.testing.assert_allclose(derivatives, [[0.25, 0]], atol=1e-10)


def test_a_branch_from_a_solution_on_a_mapped_grid():
    model, *_ = driven()
    start = model.solve_periodic(2 * np.pi, grid_points=21, time_map=pdn.TIME_MAP_EVENTS,
                                 event_count=1, event_times=[1.0], event_widths=[0.5],
                                 event_shares=[0.5])
    assert start.sharp_event_count() == 1
    periodic = pdn.PeriodicOptions(grid_points=21, initial=start)
    branch = model.follow_branch(2 * np.pi, pdn.FREQUENCY, periodic=periodic, from_=0.9, to=1.2)
    assert branch.end() == pdn.BRANCH_RANGE and len(branch) > 1
    assert branch.solution(0).sharp_event_count() == 0


def test_response_over_frequencies(tmp_path):
    model, body, _, coordinate = driven()
    seen = []
    branch = model.solve_frequency_response(
        0.5, 4.0, progress=lambda point, number: seen.append((number, point.parameter)))
    assert branch.end() == pdn.BRANCH_RANGE
    assert len(branch) > 5 and [number for number, _ in seen] == list(range(1, len(seen) + 1))
    for point, frequency in enumerate(branch.parameters):
        *_, cosines, sines = branch.solution(point).harmonics(coordinate, 1)
        exact = 1 / abs(4 - frequency**2 + 0.1j * frequency)
        assert np.hypot(cosines[0], sines[0]) == pytest.approx(exact, rel=1e-6)
    position = pdn.Quantity(kind=pdn.NODE_POSITION, object=body)
    branch.write_csv(tmp_path / "branch.csv", [position, coordinate])
    assert len((tmp_path / "branch.csv").read_text().splitlines()) == len(branch) + 1
    names = (tmp_path / "branch.csv").read_text().splitlines()[0].split(",")
    assert names[-16].endswith("position.x.mean") and names[-1].endswith(".max")
    with pytest.raises(pdn.Error, match="expected a Quantity"):
        branch.write_csv(tmp_path / "branch.csv", [body])
    branch.save(tmp_path / "branch.pdb")
    more = pdn.Branch.load(tmp_path / "branch.pdb").continue_branch(from_=0.5, to=5.0)
    assert more.end() == pdn.BRANCH_RANGE and len(more) > len(branch)
    assert more.parameters[-1] == pytest.approx(5.0)
    with pytest.raises(pdn.Error, match="no other branch begins"):
        branch.switch_branch(0, 0.1, from_=0.5, to=5.0)
    ended = model.solve_frequency_response(0.5, 4.0, progress=lambda _point, number: number == 3)
    assert ended.end() == pdn.BRANCH_CANCELLED and len(ended) == 3


def test_multipliers():
    model, body, *_ = driven()
    stability = model.solve_periodic(2 * np.pi).solve_stability()
    verdict, _limit = stability.verdict()
    assert verdict == pdn.STABLE
    exponents = np.roots([1, 0.1, 4])
    wanted = sorted(np.exp(2 * np.pi * exponents), key=lambda z: z.imag)
    found = sorted(stability.multipliers, key=lambda z: z.imag)
    np.testing.assert_allclose(found, wanted, atol=1e-9)
    # As many shapes as times, of which the last is the period.
    times, (real, imaginary) = stability.times(), stability.shape(0, body)
    assert len(times) == stability.time_count() and times[-1] == pytest.approx(2 * np.pi)
    assert real.shape == imaginary.shape == (len(times), 6)
    # The largest component is 1.
    assert np.max(np.hypot(real, imaginary)) == pytest.approx(1.0)


def test_like_blades_are_said_and_read():
    model = pdn.Model()
    bodies = [model.add_rigid_body(1.0, [np.cos(angle), np.sin(angle), 0], np.eye(3))
              for angle in 2 * np.pi * np.arange(3) / 3]
    model.set_rotor_symmetry([0, 0, 2], 3, bodies, [])
    axis, point, blades, of_blade, of_hub = model.rotor_symmetry()
    np.testing.assert_array_equal(axis, [0, 0, 1])
    np.testing.assert_array_equal(point, np.zeros(3))
    assert (blades, of_blade, of_hub) == (3, 1, 0)
    assert model.rotor_node(1, 0) == bodies[1]
    with pytest.raises(pdn.Error, match="blades: expected at least 2"):
        model.set_rotor_symmetry([0, 0, 1], 1, bodies[:1], [])


def test_a_frame_that_turns_softens_a_radial_spring():
    model, body, _, _ = driven()
    model.set_turning_frame([0, 0, 2], 1.0)
    axis, rate, point = model.turning_frame()
    np.testing.assert_array_equal(axis, [0, 0, 1])
    np.testing.assert_array_equal(point, np.zeros(3))
    assert rate == 1.0
    found = model.add_parameter("rate", 1.0, 1.0)
    model.move_number(found, pdn.NUMBER_FRAME_RATE, 0, 0, 1.0)
    position = pdn.Quantity(kind=pdn.NODE_POSITION, object=body, component=0)
    _, _, cosines, sines = model.solve_periodic(2 * np.pi).harmonics(position, 1)
    # 4 - rate^2 is what the spring has left.
    amplitude = 1 / abs(2 + 0.1j)
    assert np.hypot(cosines[0], sines[0]) == pytest.approx(amplitude)
    # The rate for a component of the response, from another start.
    conditions = pdn.Conditions()
    conditions.release(found)
    conditions.add_quantity(position, pdn.FEATURE_COSINE, 1, (1 / (2 + 0.1j)).real, 0)
    model.set_parameter(found, 1.1)
    solution = model.solve_conditioned(2 * np.pi, conditions)
    assert solution.converged
    assert abs(solution.parameter(found)) == pytest.approx(1.0, abs=1e-9)


def test_a_phase_and_a_momentum_need_a_direction():
    conditions = pdn.Conditions()
    conditions.add_rotation_phase([0, 0, 1])
    conditions.add_translation_phase([1, 0, 0])
    conditions.add_momentum([1, 0, 0], 2.0)
    conditions.add_angular_momentum([0, 0, 1], 2.0)
    with pytest.raises(pdn.Error, match="^axis: "):
        conditions.add_rotation_phase([0, 0, 0])
    with pytest.raises(pdn.Error, match="^direction: "):
        conditions.add_translation_phase([0, 0, 0])
    with pytest.raises(pdn.Error, match="^direction: "):
        conditions.add_momentum([0, 0, 0], 1.0)
    with pytest.raises(pdn.Error, match="^axis: "):
        conditions.add_angular_momentum([0, 0, 0], 1.0)
