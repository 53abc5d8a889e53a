"""The rotor of the NREL 5-MW turbine at 12.1 rpm: what its blades' roots bear, in harmonics.

    nrel_5mw_rotor.py [PICTURE]

Three blades of tests/data on a rigid shaft tilted by 5 degrees, coned by 2.5 degrees upwind, in
gravity and wind that grows with height and dips before the tower; one blade is solved for, as the
others do the same a third of a turn later. Blade elements: lift and drag by
the air that passes each node, whose own velocity counts; the wake by a constant induction, chords
and airfoil in round numbers. Metres, newtons, kilograms, seconds; x downwind, z up.
"""

import functools
import pathlib
import sys
import time

import numpy as np

import periodyn as pdn
from periodyn import beamdyn

TABLE = pathlib.Path(__file__).parents[2] / "tests/data/nrel_5mw_blade.csv"
SPEED, RADIUS, TILT, CONE = 12.1 * np.pi / 30, 1.5, np.radians(5), np.radians(2.5)
PERIOD = 2 * np.pi / SPEED
DAMPING = [1e-3, 1e-3, 1e-3, 2.2e-3, 1.4e-3, 2.2e-3]  # BeamDyn's, in this library's order
WIND, HUB_HEIGHT, INDUCTION, AIR = 11.4, 90, 1 / 3, 1.225
CHORDS = [[0, 3.5], [0.1, 4.0], [0.2, 4.6], [0.3, 4.4], [0.45, 3.8], [0.6, 3.2], [0.75, 2.8],
          [0.9, 2.2], [1, 1.4]]
SHAFT = np.array([np.cos(TILT), 0, -np.sin(TILT)])  # downwind
UP, AHEAD = np.array([np.sin(TILT), 0, np.cos(TILT)]), np.array([0, -1, 0])
LIFT_AT_ZERO, DRAG = 0.4, 0.01


def stations():
    table = np.genfromtxt(TABLE, delimiter=",", skip_header=1)
    sections = []
    for row in table:
        full = np.zeros((2, 6, 6))
        for matrix, upper in zip(full, (row[5:26], row[26:47])):
            matrix[np.triu_indices(6)] = upper
            matrix += np.triu(matrix, 1).T
        stiffness, mass = full[:, beamdyn.ORDER][:, :, beamdyn.ORDER]
        section = pdn.Section(stiffness=stiffness, mass=mass)
        sections.append(section.set_component_damping(DAMPING))
    twists = np.radians(table[:, 4])
    return pdn.Stations(fractions=table[:, 0], sections=sections, twists=-twists), twists


def wind(azimuth, radius):
    """Along the shaft, at the blade's azimuth from above: shear, and the tower's shadow below."""
    height = HUB_HEIGHT + radius * np.cos(azimuth)
    before_tower = np.exp((np.cos(azimuth - np.pi) - 1) / 0.03)
    return WIND * (1 - INDUCTION) * (height / HUB_HEIGHT)**0.2 * (1 - 0.25 * before_tower)


def element_forces(through, along, twist):
    """Force for each unit of chord and length on a blade element, downwind and ahead, by the air
    that comes through the rotor's plane and along it, from ahead."""
    speed = np.sqrt(through**2 + along**2)
    # Coefficients times the speed; of lift 2 pi times the sine of the angle of attack.
    lift = LIFT_AT_ZERO * speed + 2 * np.pi * (through * np.cos(twist) - along * np.sin(twist))
    drag = DRAG * speed
    pressure = 0.5 * AIR
    return (pressure * (lift * along + drag * through), pressure * (lift * through - drag * along))


def airloads(azimuth_0, radii, areas, twists, state, values):
    """Of several nodes of a blade, with tangents."""
    azimuth = azimuth_0 + SPEED * state.time
    ahead = np.cos(azimuth) * AHEAD - np.sin(azimuth) * UP
    moved = state.velocities[:, :3]
    through, along = wind(azimuth, radii) - moved @ SHAFT, moved @ ahead
    directions = np.array([SHAFT, ahead])
    forces = np.array(element_forces(through, along, twists)) * areas
    values.forces[:, :3] = forces.T @ directions
    if values.by_velocity is None:
        return
    step = 1e-30  # complex, so that derivatives are exact
    by_air = [np.imag(element_forces(*air, twists)) * areas / step
              for air in ((through + step * 1j, along + 0j), (through + 0j, along + step * 1j))]
    slopes = np.array([-by_air[0], by_air[1]])  # by the node's velocity downwind, and ahead
    for k, slope in enumerate(slopes.transpose(2, 1, 0)):
        at = slice(6 * k, 6 * k + 3)
        values.by_velocity[at, at] = directions.T @ slope @ directions


def build(elements=4, degree=4, alike=True):
    """The model, its blades, and the joints at their roots; `alike`: it is said that blades are."""
    model = pdn.Model()
    model.set_gravity([0, 0, -9.81])
    across = 1e5 * np.eye(3) + 0.15926e5 * np.outer(SHAFT, SHAFT)
    hub = model.add_rigid_body(56780, [0, 0, 0], across)
    bearing = model.add_revolute(pdn.GROUND, hub, [0, 0, 0], SHAFT)
    model.prescribe(bearing, pdn.ROTATION, pdn.Signal().set_harmonics(rate=SPEED))
    made, twists = stations()
    blades, roots = [], []
    for azimuth in 2 * np.pi / 3 * np.arange(3):
        radial = np.cos(azimuth) * UP + np.sin(azimuth) * AHEAD
        along = np.cos(CONE) * radial - np.sin(CONE) * SHAFT
        root = RADIUS * along
        line = pdn.Line().set_straight(root, (RADIUS + 61.5) * along, SHAFT)
        blade = model.add_beam(line, made, elements, degree)
        roots.append(model.add_rigid_joint(hub, blade.first, root))
        blades.append(blade)
        nodes = np.arange(blade.first, blade.last + 1)
        places = np.array([np.linalg.norm(model.node_frame(node).position) for node in nodes])
        fractions = (places - RADIUS) / 61.5
        chords = np.interp(fractions, *np.transpose(CHORDS))
        areas = chords * np.gradient(places) * np.where(fractions > 0.1, 1, 0)
        areas[-1] /= 2
        turned = np.interp(fractions, made.fractions, twists)
        for some in np.array_split(np.arange(len(nodes)), elements):
            function = functools.partial(airloads, azimuth, places[some], areas[some],
                                         turned[some])
            model.add_user_force(nodes[some], pdn.FRAME_SPACE, pdn.TANGENTS_GIVEN, function)
    if alike:
        nodes = [node for blade in blades for node in range(blade.first, blade.last + 1)]
        model.set_rotor_symmetry(SHAFT, 3, nodes, [hub])
    return model, blades, roots


def root_moments(solution, root, count=720):
    """Lag and flap moments on the first blade, which stands upright at first, about the axes of the
    hub, along the shaft and across it; evenly over a period."""
    times = PERIOD * np.arange(count) / count
    at_root = pdn.Quantity(pdn.JOINT_REACTION, root, frame=pdn.FRAME_FIRST)
    moments = -solution.sample(at_root, times)[:, 3:]
    return moments @ SHAFT, moments[:, 1]


def amplitudes(values, highest=6):
    """The mean, and the amplitude of each harmonic."""
    found = np.fft.rfft(values) / len(values)
    return np.append(abs(found[:1]), 2 * abs(found[1:highest + 1]))


def main():
    model, _, roots = build()
    start = time.process_time()
    solution = model.solve_periodic(PERIOD)
    taken = time.process_time() - start
    print(solution.outcome_name, "on", solution.diagnostics().grid_points, "points")
    lag, flap = root_moments(solution, roots[0])
    print("per turn     0        1        2        3        4        5        6")
    for name, moment in (("lag", lag), ("flap", flap)):
        print(f"{name:4s}", " ".join(f"{a / 1e3:8.2f}" for a in amplitudes(moment)), "kN m")
    print(f"{taken:.2f} s of processor time", file=sys.stderr)
    if len(sys.argv) > 1:
        from matplotlib import pyplot

        azimuth = np.linspace(0, 360, len(lag), endpoint=False)
        pyplot.plot(azimuth, np.transpose([lag, flap]) / 1e3, label=["lag", "flap"])
        pyplot.xlabel("azimuth [degrees]")
        pyplot.ylabel("root moment [kN m]")
        pyplot.legend()
        pyplot.savefig(sys.argv[1])


if __name__ == "__main__":
    main()
