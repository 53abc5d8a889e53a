import periodyn as pdn
from rotor_model import Rotor

last = None
for speed in (3.0, 4.0, 5.0, 6.0, 7.0):
    rotor = Rotor(speed, pitch=0.02)
    last = rotor.model.solve_periodic(rotor.period, initial=last)
    at_root = pdn.Quantity(pdn.BEAM_FORCE, rotor.blades[0].first_element, 5, station=-1)
    least, _, most, _ = last.extremes(at_root)
    print(f"{speed:.0f} rad/s: edgewise moment at the root {1e-3 * least:.3f} to "
          f"{1e-3 * most:.3f} kN m, {'converged' if last.converged else 'not converged'}")
