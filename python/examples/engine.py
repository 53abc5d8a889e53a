"""A four-cylinder engine of two litres over its speeds, on several processes.

    engine.py [PICTURE [PROCESSES]]

The model of c_examples/engine.c, which tells more of it: crankshaft, rods and pistons under the
gas pressure of a four-stroke cycle, whose period is two turns. Metres, newtons, kilograms, seconds.
"""

import sys

import numpy as np

import periodyn as pdn

BORE, CRANK, ROD, PITCH = 0.086, 0.043, 0.143, 0.096
YOUNG, SHEAR, DENSITY = 210e9, 81e9, 7850.0
SPEEDS = [1000, 2000, 3000, 4000, 5000, 6000]  # rpm
X, Z = [1, 0, 0], [0, 0, 1]


def gas_pressure(degrees):
    """Over that in the crankcase: compression, Wiebe's law of combustion, expansion, exhaust."""
    angle = np.radians(degrees)
    clearance, begins, lasts, opens = 2 * CRANK / 9, -15, 60, 140
    down = CRANK + ROD - CRANK * np.cos(angle) - np.sqrt(ROD**2 - (CRANK * np.sin(angle))**2)
    compressed = ((2 * CRANK + clearance) / (down + clearance))**1.32
    burnt = 1 - np.exp(-6.9 * (np.maximum(degrees - begins, 0) / lasts)**3)
    open_part = np.clip((degrees - opens) / (180 - opens), 0, 1)
    over = 1e5 * (compressed * (1 + 2.5 * burnt) - 1) * 0.5 * (1 + np.cos(np.pi * open_part))
    return np.where(abs(degrees) < 180, over, 0)


def section(area, second_2, second_3, torsion):
    made = pdn.Section().set_diagonal(
        [YOUNG * area, 0.85 * SHEAR * area, 0.85 * SHEAR * area,
         SHEAR * torsion, YOUNG * second_2, YOUNG * second_3],
        [DENSITY * area, DENSITY * (second_2 + second_3), DENSITY * second_2, DENSITY * second_3])
    return made.set_proportional_damping(2e-5)


def round_section(diameter):
    second = np.pi / 64 * diameter**4
    return section(np.pi / 4 * diameter**2, second, second, 2 * second)


class Engine:
    def __init__(self, speed):
        model = self.model = pdn.Model()
        model.set_gravity([0, 0, -9.81])
        thick, wide = 0.02, 0.075
        journal, pin = round_section(0.055), round_section(0.048)
        web = section(thick * wide, wide * thick**3 / 12, thick * wide**3 / 12,
                      0.28 * wide * thick**3)
        self.bearings, at, end = [], np.zeros(3), None
        for cylinder, throw in enumerate([CRANK, -CRANK, -CRANK, CRANK]):
            half_journal, half_pin = [0.024, 0, 0], [PITCH / 2 - 0.024, 0, 0]
            up, down = [0, 0, throw / 2], [0, 0, -throw / 2]
            parts = [(half_journal, journal), (up, web), (up, web), (half_pin, pin),
                     (half_pin, pin), (down, web), (down, web), (half_journal, journal)]
            for k, (step, profile) in enumerate(parts):
                part = model.add_straight_beam(at, at + step, [0, 1, 0], profile, 1, 2)
                if end is None:
                    self.front = part.first
                else:
                    model.add_rigid_joint(end, part.first, at)
                if k == 0:
                    self.add_bearing(part.first, at)
                if k in (1, 7):  # counterweights
                    model.add_mass(part.first, 0.6, [at[0], 0, -0.8 * throw])
                if k == 4:
                    self.add_cylinder([0, 540, 180, 360][cylinder], part.first, at)
                at, end = at + step, part.last
        self.add_bearing(end, at)
        behind = at + [0.04, 0, 0]
        flywheel = model.add_rigid_body(8, behind, np.diag([0.08, 0.045, 0.045]))
        model.add_rigid_joint(end, flywheel, at)
        self.drive = model.add_free_joint(pdn.GROUND, flywheel, behind)
        model.prescribe(self.drive, pdn.ROTATION, pdn.Signal().set_harmonics(rate=speed))
        model.add_spring_damper(self.drive, pdn.DISPLACEMENT, 1e8, 2e4)
        self.gauge = model.add_free_joint(flywheel, self.front, [0, 0, 0])  # measures only

    def add_bearing(self, node, at):
        joint = self.model.add_free_joint(pdn.GROUND, node, at)
        self.bearings.append([self.model.add_spring_damper(joint, across, 5e8, 5e4)
                              for across in (pdn.DISPLACEMENT_2, pdn.DISPLACEMENT_3)])

    def add_cylinder(self, fires, node, pin):
        model, wrist = self.model, [pin[0], 0, pin[2] + ROD]
        rod = model.add_straight_beam(pin, wrist, X, section(2.4e-4, 1.6e-8, 0.6e-8, 0.4e-8), 2, 2)
        model.add_mass(rod.first, 0.3, pin, np.diag([3e-4, 3e-4, 3e-4]))
        piston = model.add_rigid_body(0.5, wrist, np.diag([5e-4, 5e-4, 5e-4]))
        model.add_revolute(node, rod.first, pin, X)
        model.add_spherical(rod.last, piston, wrist)
        model.add_prismatic(pdn.GROUND, piston, wrist, Z)
        degrees = (np.arange(720) - fires + 1080) % 720 - 360  # two turns, from -360 on
        force = -np.pi / 4 * BORE**2 * gas_pressure(degrees)
        model.add_load(piston, pdn.FRAME_SPACE, pdn.FORCE_3, pdn.Signal().set_samples(force))


def respond(rpm):
    """Mean torque and its amplitude twice a turn [N m], largest twist of the shaft [degrees] and
    force on the middle bearing [kN] at a speed."""
    speed = rpm * np.pi / 30
    engine, period = Engine(speed), 4 * np.pi / speed
    solution = engine.model.solve_periodic(period, error_tolerance=1e-4)
    if not solution.converged:
        raise RuntimeError(solution.report())
    times = np.linspace(0, period, 721)
    mean, _, cosines, sines = solution.harmonics(
        pdn.Quantity(pdn.JOINT_DRIVING_EFFORT, engine.drive, pdn.ROTATION), 4)
    twist = solution.sample(pdn.Quantity(pdn.JOINT_COORDINATE, engine.gauge, pdn.ROTATION), times)
    sides = [solution.sample(pdn.Quantity(pdn.FORCE_EFFORT, force), times)
             for force in engine.bearings[2]]
    return (-float(mean), float(np.hypot(cosines[3], sines[3])),
            float(np.degrees(abs(twist).max())), float(np.hypot(*sides).max()) / 1e3)


def main():
    processes = int(sys.argv[2]) if len(sys.argv) > 2 else 2
    found = pdn.sweep(respond, SPEEDS, processes=processes)
    print("  rpm  torque [N m]  twice a turn  twist [deg]  middle bearing [kN]")
    for rpm, row in zip(SPEEDS, found):
        print(f"{rpm:5d} {row[0]:13.2f} {row[1]:13.2f} {row[2]:12.4f} {row[3]:20.3f}")
    if len(sys.argv) > 1:
        from matplotlib import pyplot

        pyplot.plot(SPEEDS, [row[1] for row in found], ".-")
        pyplot.xlabel("speed [rpm]")
        pyplot.ylabel("torque twice a turn [N m]")
        pyplot.savefig(sys.argv[1])


if __name__ == "__main__":
    main()
