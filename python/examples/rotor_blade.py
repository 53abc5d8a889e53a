"""A flexible blade in gravity, on a hub that turns once a second: its root moments over a turn."""

import sys

import numpy as np
from matplotlib import pyplot

import periodyn as pdn

profile = pdn.Section().set_diagonal(
    [500e6, 100e6, 100e6, 500e3, 3.87e6, 1.30e6], [20, 0.2, 0.15, 0.05])
profile.set_component_damping([0, 0, 0, 0.01, 0.01, 0.01])

model = pdn.Model()
model.set_gravity([0, 0, -9.81])
hub = model.add_node([0, 0, 0])
blade = model.add_straight_beam([0, 0, 0.5], [0, 0, 10.5], [1, 0.14, 0], profile, 4, 4)
shaft = model.add_revolute(pdn.GROUND, hub, [0, 0, 0], [1, 0, 0])
clamp = model.add_rigid_joint(hub, blade.first, [0, 0, 0.5])
model.prescribe(shaft, pdn.ROTATION, pdn.Signal().set_harmonics(rate=2 * np.pi))
gust = pdn.Signal().set_harmonics(3000, cosines=[1000, 0], sines=[0, 200])
model.add_load(blade.last, pdn.FRAME_SPACE, pdn.FORCE_1, gust)

solution = model.solve_periodic(1.0)
print(solution.report())
times = np.linspace(0, 1, 201)
at_root = pdn.Quantity(pdn.JOINT_REACTION, clamp, frame=pdn.FRAME_FIRST)
moments = -solution.sample(at_root, times)[:, 3:5]
pyplot.plot(times, moments / 1e3, label=["lag", "flap"])
pyplot.xlabel("time [s]")
pyplot.ylabel("root moment [kN m]")
pyplot.legend()
pyplot.savefig(sys.argv[1] if len(sys.argv) > 1 else "rotor_blade.png")
