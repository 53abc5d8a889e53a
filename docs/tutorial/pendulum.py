import math

import numpy as np

import periodyn as pdn

# Metres, kilograms, seconds. Below its hinge hangs a bar of 1 m and 2 kg.
model = pdn.Model()
model.set_gravity([0, 0, -9.81])
bar = model.add_rigid_body(2.0, [0, 0, -0.5], np.diag([1 / 6, 1 / 6, 0.001]))
hinge = model.add_revolute(pdn.GROUND, bar, [0, 0, 0], [0, 1, 0])
model.add_spring_damper(hinge, pdn.ROTATION, stiffness=0, damping=0.5)

# A motor at the hinge pushes it to and fro, by 1.5 N m at 3 rad/s.
push = pdn.Signal().set_harmonics(cosines=[1.5], sines=[0])
model.add_actuator(hinge, pdn.ROTATION, push)

solution = model.solve_periodic(2 * math.pi / 3)
print("converged:", "yes" if solution.converged else "no")
angle = pdn.Quantity(pdn.JOINT_COORDINATE, hinge, pdn.ROTATION)
_, _, largest, time = solution.extremes(angle)
print(f"it swings to {math.degrees(largest):.3f} degrees, at {time:.3f} s")
