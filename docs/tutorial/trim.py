import math

import periodyn as pdn
from rotor_model import Rotor

# Which pitch gives a mean thrust of 8 kN? The shaft holds the hub against it.
rotor = Rotor(speed=5.0, pitch=0.02)
model = rotor.model
pitch = model.add_parameter("collective pitch", 0.02, 0.1)
for bearing in rotor.pitches:
    model.move_signal(pitch, bearing, 0, pdn.PART_MEAN, 1.0)
held = pdn.Quantity(pdn.JOINT_REACTION, rotor.shaft, 0)
conditions = pdn.Conditions()
conditions.release(pitch)
conditions.add_quantity(held, pdn.FEATURE_MEAN, 0, -8e3)

solution = model.solve_conditioned(rotor.period, conditions)
print("converged:", "yes" if solution.converged else "no")
print(f"pitch: {math.degrees(solution.parameter(pitch)):.3f} degrees")
mean = solution.harmonics(held, 1)[0]
print(f"thrust: {-1e-3 * mean:.3f} kN")
