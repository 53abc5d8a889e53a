"""The blade of the NREL 5-MW turbine: its modes against the rotor's speed, a Campbell diagram.

    nrel_5mw_campbell.py [PICTURE [BEAMDYN_FILE]]

With BeamDyn's main input file of a blade, that blade; else the table of tests/data.
"""

import pathlib
import sys

import numpy as np
from matplotlib import pyplot

import periodyn as pdn
from periodyn import beamdyn

HUB_RADIUS, MODES = 1.5, 5
TABLE = pathlib.Path(__file__).parents[2] / "tests/data/nrel_5mw_blade.csv"


def from_table(path, root):
    """Line and stations of the table: BeamDyn's axes, upper triangles of its matrices."""
    table = np.genfromtxt(path, delimiter=",", skip_header=1)

    def matrix(upper):
        full = np.zeros((6, 6))
        full[np.triu_indices(6)] = upper
        full += np.triu(full, 1).T
        return full[np.ix_(beamdyn.ORDER, beamdyn.ORDER)]

    sections = [pdn.Section(stiffness=matrix(row[5:26]), mass=matrix(row[26:47])) for row in table]
    line = pdn.Line().set_straight(root, root + table[-1, 1:4], [1, 0, 0])
    return line, pdn.Stations(fractions=table[:, 0], sections=sections,
                              twists=-np.radians(table[:, 4]))


def frequencies(speed):
    """Of the blade, clamped to a hub that turns about axis 1 at `speed` rad/s."""
    root = np.array([0, 0, HUB_RADIUS])
    if len(sys.argv) > 2:
        blade = beamdyn.read_blade(sys.argv[2], root)
        line, stations = blade.line, blade.stations
    else:
        line, stations = from_table(TABLE, root)
    model = pdn.Model()
    beam = model.add_beam(line, stations, 4, 4)
    model.add_rigid_joint(pdn.GROUND, beam.first, root)
    modes = model.solve_modes(count=MODES, equilibrium={"angular_velocity": [speed, 0, 0]})
    return modes.frequencies


rpm = np.linspace(0, 15, 7)
lines = np.array([frequencies(2 * np.pi * speed / 60) for speed in rpm])
print("  rpm " + " ".join(f"mode {i + 1:d} Hz" for i in range(MODES)))
for speed, row in zip(rpm, lines):
    print(f"{speed:5.1f} " + " ".join(f"{f:9.4f}" for f in row))

pyplot.plot(rpm, lines, ".-")
for order in range(1, 10):
    pyplot.plot(rpm, order * rpm / 60, "k:", linewidth=0.5)
    pyplot.annotate(f"{order}P", (rpm[-1], order * rpm[-1] / 60), fontsize=7)
pyplot.axvline(12.1, color="grey", linewidth=0.8)
pyplot.ylim(0, 5)
pyplot.xlabel("rotor speed [rpm]; rated: 12.1")
pyplot.ylabel("frequency [Hz]")
pyplot.savefig(sys.argv[1] if len(sys.argv) > 1 else "nrel_5mw_campbell.png", dpi=120)
