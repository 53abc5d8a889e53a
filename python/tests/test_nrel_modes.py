"""Modes of the NREL 5-MW blade, at rest and at 12.1 rpm, against a linear model of its own.

That model is of small displacements about the straight blade: Timoshenko's beam with the tables'
matrices, the axial force that centrifugal loads make, and the terms of a turning frame. It is
written from the tables in the axes of BeamDyn, with nothing of the library.
"""

import functools
import pathlib

import numpy as np
import pytest

import periodyn as pdn

ROOT = pathlib.Path(__file__).parents[2]
RATED, RADIUS, MODES = 12.1 * np.pi / 30, 1.5, 6


@functools.cache
def table():
    return np.genfromtxt(ROOT / "tests/data/nrel_5mw_blade.csv", delimiter=",", skip_header=1)


def cross(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def matrices_at(row):
    """Stiffness and mass along the global axes: x downwind, y in the plane, z along the blade."""
    full = []
    for upper in (row[5:26], row[26:47]):
        matrix = np.zeros((6, 6))
        matrix[np.triu_indices(6)] = upper
        full.append(matrix + np.triu(matrix, 1).T)
    angle = -np.radians(row[4])
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0],
                     [0, 0, 1]])
    both = np.kron(np.eye(2), turn)
    return [both @ matrix @ both.T for matrix in full]


def axial_force(z, speed):
    """Of what is beyond z, by sums over short pieces."""
    places = np.linspace(0, table()[-1, 3], 20001)
    pull = np.interp(places, table()[:, 3], table()[:, 26]) * (RADIUS + places) * speed**2
    pieces = (pull[1:] + pull[:-1]) / 2 * np.diff(places)
    beyond = np.append(np.cumsum(pieces[::-1])[::-1], 0)
    return np.interp(z, places, beyond)


def second_order(force):
    """The matrix of the work of an axial force, in u' and turns."""
    out = np.zeros((6, 6))
    out[0, 4] = out[4, 0] = force
    out[1, 3] = out[3, 1] = -force
    out[3, 3] = out[4, 4] = -force
    return out


def frequencies_by_hand(speed, degree=3):
    """Hertz of the first modes, clamped at the root, turning about x."""
    spin = np.array([speed, 0, 0])
    stations = table()
    count = degree * (len(stations) - 1) + 1
    stiffness, mass, gyroscopic = (np.zeros((6 * count, 6 * count)) for _ in range(3))
    nodes = np.linspace(-1, 1, degree + 1)
    powers = np.linalg.inv(np.vander(nodes, increasing=True))
    points, weights = np.polynomial.legendre.leggauss(degree + 3)
    for e, (a, b) in enumerate(zip(stations[:-1], stations[1:])):
        length = b[3] - a[3]
        at = slice(6 * degree * e, 6 * (degree * (e + 1) + 1))
        for xi, weight in zip(points, weights * length / 2):
            shape = xi ** np.arange(degree + 1) @ powers
            slope = np.append(0, np.arange(1, degree + 1) * xi ** np.arange(degree)) @ powers
            slope *= 2 / length
            row = a + (b - a) * (1 + xi) / 2
            section, inertia = matrices_at(row)
            motion = np.kron(shape, np.eye(6))
            strain = np.kron(slope, np.eye(6))
            strain[:3] += np.kron(shape, np.hstack([np.zeros((3, 3)), cross([0, 0, 1])]))
            bent = np.vstack([np.kron(slope, np.eye(6)[:3]), motion[3:]])
            pull = second_order(axial_force(row[3], speed))
            m, moments = inertia[0, 0], inertia[3:, 3:]
            # Centrifugal terms, of the mass and of the moments of inertia.
            turned = cross(spin)
            by_turn = turned @ moments @ turned.T - _half(moments, spin)
            centrifugal = np.zeros((6, 6))
            centrifugal[:3, :3] = m * turned @ turned
            centrifugal[3:, 3:] = -by_turn
            coriolis = np.zeros((6, 6))
            coriolis[:3, :3] = 2 * m * turned
            stiffness[at, at] += weight * (strain.T @ section @ strain + bent.T @ pull @ bent
                                           + motion.T @ centrifugal @ motion)
            mass[at, at] += weight * motion.T @ inertia @ motion
            gyroscopic[at, at] += weight * motion.T @ coriolis @ motion
    return _oscillations(*(matrix[6:, 6:] for matrix in (mass, gyroscopic, stiffness)))


def _half(moments, spin):
    """The matrix H of turns t with t' H t = -spin' moments (t x (t x spin))."""
    j = moments @ spin
    return np.dot(j, spin) * np.eye(3) - (np.outer(j, spin) + np.outer(spin, j)) / 2


def _oscillations(mass, gyroscopic, stiffness):
    lower = np.linalg.inv(np.linalg.cholesky(mass))
    squares, shapes = np.linalg.eigh(lower @ stiffness @ lower.T)
    shapes = (lower.T @ shapes)[:, :40]
    small = shapes.T @ gyroscopic @ shapes
    zero, one = np.zeros_like(small), np.eye(len(small))
    states = np.block([[zero, one], [-np.diag(squares[:40]), -small]])
    found = np.linalg.eigvals(states).imag / (2 * np.pi)
    return np.sort(found[found > 0])[:MODES]


@functools.cache
def example():
    """python/examples/nrel_5mw_campbell.py, which makes the blade from the table."""
    text = (ROOT / "python/examples/nrel_5mw_campbell.py").read_text().split("\nrpm = ")[0]
    names = {"__file__": str(ROOT / "python/examples/nrel_5mw_campbell.py")}
    exec(compile(text, "nrel_5mw_campbell.py", "exec"), names)
    return names


def frequencies(speed, elements, degree):
    root = np.array([0, 0, RADIUS])
    line, stations = example()["from_table"](example()["TABLE"], root)
    model = pdn.Model()
    beam = model.add_beam(line, stations, elements, degree)
    model.add_rigid_joint(pdn.GROUND, beam.first, root)
    turning = {"angular_velocity": [speed, 0, 0]}
    return model.solve_modes(count=MODES, equilibrium=turning).frequencies


def test_the_linear_model_has_converged():
    # Elements between stations, of degree 3, as of degree 2.
    for speed in (0, RATED):
        np.testing.assert_allclose(frequencies_by_hand(speed, 2), frequencies_by_hand(speed),
                                   rtol=1e-4)


@pytest.mark.parametrize("speed", [0, RATED])
@pytest.mark.parametrize("elements, tolerance", [(4, 3e-3), (16, 3e-4)])
def test_modes_are_those_of_the_linear_model(speed, elements, tolerance):
    # Flap, edge, flap, edge, flap and torsion. What is left at 12.1 rpm on the finer mesh, 2e-4, is
    # that the equilibrium is not straight.
    found = frequencies(speed, elements, 4)
    np.testing.assert_allclose(found, frequencies_by_hand(speed), rtol=tolerance)
    if speed == 0 and elements == 16:
        np.testing.assert_allclose(found, frequencies_by_hand(speed), rtol=3e-5)


def test_speed_counts():
    # More than the tolerance above, so that a model without centrifugal terms would be noticed.
    assert frequencies_by_hand(RATED)[0] > 1.07 * frequencies_by_hand(0)[0]
