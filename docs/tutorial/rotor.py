import periodyn as pdn
from rotor_model import Rotor

rotor = Rotor(speed=5.0, pitch=0.02)
solution = rotor.model.solve_periodic(rotor.period)
print("converged:", "yes" if solution.converged else "no")
torque = pdn.Quantity(pdn.JOINT_DRIVING_EFFORT, rotor.shaft, pdn.ROTATION)
print(f"power: {-1e-3 * 5.0 * solution.harmonics(torque, 1)[0]:.3f} kW")
at_root = pdn.Quantity(pdn.BEAM_FORCE, rotor.blades[0].first_element, 4, station=-1)
mean, _, cosines, sines = solution.harmonics(at_root, 2)
print(f"flapwise moment at the root: mean {1e-3 * mean:.3f} kN m")
for order, (cosine, sine) in enumerate(zip(cosines, sines), 1):
    print(f"  {order} a turn: {1e-3 * cosine:.3f} cos, {1e-3 * sine:.3f} sin")
