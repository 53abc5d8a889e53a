"""The flexible spatial four-bar mechanism of Han and Bauchau, Nonlinear Dynamics 92 (2018), section
7.2: crank, coupler and rocker of steel; a motor turns the crank at D unsteadily.

    spatial_four_bar.py [POINTS]
"""

import sys

import numpy as np

import periodyn as pdn

A, B, C, D = [-0.40, 0, 0], [-0.75, 0, 0.652], [0, 0.85, 0.2], [0, 0.85, 0]
AXIS_1, AXIS_2 = [1, 0, 0], [0, 1, 0]
ELEMENTS, DEGREE = 8, 1

# 16 x 16 mm and 8 x 8 mm
steel16 = pdn.Section().set_diagonal([52.99e6, 16.88e6, 16.88e6, 733.5, 1131, 1131],
                                     [1.997, 85.20e-6, 42.60e-6, 42.60e-6])
steel8 = pdn.Section().set_diagonal([13.25e6, 4.220e6, 4.220e6, 45.84, 70.66, 70.66],
                                    [0.4992, 5.324e-6, 2.662e-6, 2.662e-6])

model = pdn.Model()
rocker = model.add_straight_beam(A, B, AXIS_2, steel16, ELEMENTS, DEGREE)
coupler = model.add_straight_beam(B, C, AXIS_1, steel16, ELEMENTS, DEGREE)
crank = model.add_straight_beam(C, D, AXIS_1, steel8, ELEMENTS, DEGREE)
hinge = model.add_revolute(pdn.GROUND, rocker.first, A, AXIS_2)
model.add_spherical(rocker.last, coupler.first, B)
model.add_universal(coupler.last, crank.first, C, [0, 0.452, 0.85], AXIS_1)
motor = model.add_revolute(pdn.GROUND, crank.last, D, AXIS_1)
model.add_spring_damper(hinge, pdn.ROTATION, 18)

omega = 0.3
turn = pdn.Signal().set_harmonics(1 / 3 + 1 / 21, omega, [-1 / 3, 0, -1 / 21], [0, 0.1, 0])
model.prescribe(motor, pdn.ROTATION, turn)

period = 2 * np.pi / omega
solution = model.solve_periodic(period, grid_points=int(sys.argv[1]) if sys.argv[1:] else 21)
print(solution)

times = np.linspace(0, period, 401)
torque = solution.sample(pdn.Quantity(pdn.JOINT_DRIVING_EFFORT, motor, pdn.ROTATION), times)
low, high = torque.argmin(), torque.argmax()
print(f"Torque of the motor: {torque[low]:.4f} N m at {times[low] / period:.3f} T "
      f"to {torque[high]:.4f} N m at {times[high] / period:.3f} T")
