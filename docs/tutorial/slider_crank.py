import math

import numpy as np

import periodyn as pdn

# A motor turns the crank at 150 rad/s, a rod of steel pushes the piston against a damper.
speed = 150.0
young, shear, density, width = 210e9, 81e9, 7850.0, 0.012
area, bending = width**2, width**4 / 12
steel = pdn.Section().set_diagonal(
    [young * area, shear * area * 5 / 6, shear * area * 5 / 6,
     shear * 0.141 * width**4, young * bending, young * bending],
    [density * area, 2 * density * bending, density * bending, density * bending])
steel.set_proportional_damping(1e-5)

model = pdn.Model()
crank = model.add_rigid_body(1.0, [0, 0, 0], np.diag([2e-3, 2e-3, 3e-3]))
rod = model.add_straight_beam([0.1, 0, 0], [0.5, 0, 0], [0, 1, 0], steel, 4, 3)
piston = model.add_rigid_body(0.6, [0.5, 0, 0], np.diag([4e-4, 4e-4, 4e-4]))
motor = model.add_revolute(pdn.GROUND, crank, [0, 0, 0], [0, 0, 1])
model.add_revolute(crank, rod.first, [0.1, 0, 0], [0, 0, 1])
model.add_revolute(rod.last, piston, [0.5, 0, 0], [0, 0, 1])
slide = model.add_prismatic(pdn.GROUND, piston, [0.5, 0, 0], [1, 0, 0])
model.add_spring_damper(slide, pdn.DISPLACEMENT, stiffness=0, damping=20)
model.prescribe(motor, pdn.ROTATION, pdn.Signal().set_harmonics(rate=speed))

solution = model.solve_periodic(2 * math.pi / speed)
print("converged:", "yes" if solution.converged else "no")
torque = pdn.Quantity(pdn.JOINT_DRIVING_EFFORT, motor, pdn.ROTATION)
least, _, most, _ = solution.extremes(torque)
print(f"torque of the motor: {least:.2f} to {most:.2f} N m")
moment = pdn.Quantity(pdn.BEAM_FORCE, rod.first_element + 2, 5, station=-1)
least, _, most, _ = solution.extremes(moment)
print(f"moment in the middle of the rod: {least:.2f} to {most:.2f} N m")
