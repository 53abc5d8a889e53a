"""Periodic response of flexible multibody systems, by Fourier spectral collocation on SE(3).

    import periodyn as pdn

    model = pdn.Model()
    ...
    solution = model.solve_periodic(period)
    print(solution.report())

Numbers are in any consistent set of units; vectors are along the global axes unless said otherwise.
Functions and constants are those of periodyn.h, without their prefixes; what fails raises Error.
"""

from ._call import Error
from ._callbacks import ForceState, ForceValues
from ._interface import *  # noqa: F403
from ._interface import version
from .equations import Equations
from .sweeps import sweep

__version__ = version()
