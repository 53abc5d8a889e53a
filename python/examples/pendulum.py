"""A pendulum with a torsional spring, driven by a moment."""

import numpy as np

import periodyn as pdn

model = pdn.Model()
model.set_gravity([0, 0, -9.81])
bob = model.add_rigid_body(2, [0, 0, -0.5], np.diag([0.1, 0.1, 0.1]))
hinge = model.add_revolute(pdn.GROUND, bob, [0, 0, 0], [0, 1, 0])
model.add_spring_damper(hinge, pdn.ROTATION, stiffness=3, damping=0.2, rest=0)
model.add_load(bob, pdn.FRAME_SPACE, pdn.MOMENT_2, lambda time: 4 * np.cos(2 * time))

solution = model.solve_periodic(np.pi)
print(solution.report())
print("angle", solution.sample(pdn.Quantity(pdn.JOINT_COORDINATE, hinge, pdn.ROTATION), 0.0)[0])
