"""The equations of a periodic motion below the solve, for solvers of one's own."""

import numpy

from ._abi import ffi
from ._call import LIBRARY as lib
from ._call import Error, call
from ._extras import Handle
from ._interface import CONVERGED, LINEAR_AUTOMATIC, EquationsOptions, EquationsSizes, Solution
from ._numbers import ids, reals
from ._structs import pointer


class Equations(Handle):
    """Residual, Jacobian as an operator, preconditioner, and steps of the motions.

    Of one rank; the functions by which several tell each other numbers are for C. Vectors have
    sizes().size numbers: six increments of each node at each grid point, then own unknowns of
    elements, then stress resultants where the preconditioner has them. `residual`, `product` and
    the like fit scipy's LinearOperator, `update` moves along the manifold of motions.

    Args:
        model: the model
        period: the period
        grid_points: number of grid points, odd
        initial: where to begin, a Solution; None for the reference configuration
        preconditioner: LINEAR_TIME_LOCAL, LINEAR_BODY_CIRCULANT, LINEAR_CIRCULANT, or
            LINEAR_AUTOMATIC
        threads: threads that share the work
    """

    _free = lib.pdn_equations_free

    def __init__(self, model, period, grid_points, initial=None,
                 preconditioner=LINEAR_AUTOMATIC, threads=1):
        options = EquationsOptions(
            grid_points=grid_points,
            initial=initial,
            preconditioner=preconditioner,
            threads=threads,
        )
        out = ffi.new("pdn_equations **")
        self._kept = model._kept
        call(lib.pdn_equations_new, pointer(model), period, options._c, out)
        self._own(out[0])
        self._size = self.sizes().size

    def sizes(self):
        """Sizes of the equations and of vectors, EquationsSizes."""
        out = EquationsSizes()
        call(lib.pdn_equations_get_sizes, self._c, out._c)
        return out

    def nodes(self):
        """Ids of the nodes, in the order of vectors."""
        nodes = ids("nodes", range(self.sizes().nodes))
        call(lib.pdn_equations_nodes, self._c, ffi.from_buffer("int32_t[]", nodes), len(nodes))
        return nodes

    def numbers(self):
        """Numbers of the unknowns among those of all ranks."""
        numbers = numpy.empty(self._size, dtype=numpy.uintp)
        buffer = ffi.from_buffer("size_t[]", numbers)
        call(lib.pdn_equations_numbers, self._c, buffer, len(numbers))
        return numbers

    def state(self):
        """Motions, 12 numbers at each grid point of each node (position, then rotation matrix
        column by column), and own unknowns."""
        sizes = self.sizes()
        motions, own = reals.empty(sizes.motions), reals.empty(sizes.own_unknowns)
        call(lib.pdn_equations_state, self._c, pointer(motions), len(motions), pointer(own),
             len(own))
        return motions, own

    def set_state(self, motions, own_unknowns):
        """Sets motions and own unknowns as `state` gives them."""
        motions = reals("motions", motions, (None,))
        own = reals("own_unknowns", own_unknowns, (None,))
        call(lib.pdn_equations_set_state, self._c, pointer(motions), len(motions), pointer(own),
             len(own))

    def residual(self):
        """The scaled residual."""
        out = reals.empty(self._size)
        call(lib.pdn_equations_residual, self._c, pointer(out), len(out))
        return out

    def linearise(self):
        """Linearises the equations at the present state, which `update` then begins at."""
        call(lib.pdn_equations_linearise, self._c)

    def product(self, x):
        """The product of the scaled Jacobian and a vector."""
        return self._mapped(lib.pdn_equations_product, x)

    def transposed_product(self, x):
        """The product of the transposed scaled Jacobian and a vector."""
        return self._mapped(lib.pdn_equations_transposed_product, x)

    def power_product(self, power, x):
        """The product of a vector and what multiplies mu**power, 1 or 2, in the scaled Jacobian for
        disturbances exp(mu t)."""
        return self._mapped(lambda c, *rest: lib.pdn_equations_power_product(c, power, *rest), x)

    def factor(self, right_side):
        """Factors the preconditioner; right sides are to be about as large as this one.

        Raises:
            Error: if it is singular
        """
        right_side = reals("right_side", right_side, (None,))
        regular = ffi.new("int32_t *")
        call(lib.pdn_equations_factor, self._c, pointer(right_side), len(right_side), regular)
        if not regular[0]:
            raise Error("equations: the preconditioner is singular", "PDN_ERR_NOT_AVAILABLE")

    def precondition(self, x):
        """The solution of the preconditioner's equations with a right side."""
        return self._mapped(lib.pdn_equations_precondition, x)

    def compliance(self, increment):
        """What an increment leaves of constraints by their compliance, None if they have none."""
        increment = reals("increment", increment, (self._size,))
        out, compliant = reals.empty(self._size), ffi.new("int32_t *")
        call(lib.pdn_equations_compliance, self._c, pointer(increment), pointer(out), len(out),
             compliant)
        return out if compliant[0] else None

    def update(self, increment, step=1.0):
        """Moves the state of the last linearisation by a fraction of an increment."""
        increment = reals("increment", increment, (self._size,))
        call(lib.pdn_equations_update, self._c, pointer(increment), len(increment), step)

    def norms(self, increment):
        """Largest motion in an increment, and largest relative change of an own unknown."""
        increment = reals("increment", increment, (self._size,))
        motion, own = ffi.new("double *"), ffi.new("double *")
        call(lib.pdn_equations_norms, self._c, pointer(increment), len(increment), motion, own)
        return motion[0], own[0]

    def solution(self, outcome=CONVERGED):
        """The present state as a Solution; `outcome` says how the solve ended."""
        out = ffi.new("pdn_solution **")
        call(lib.pdn_equations_solution, self._c, -1, outcome, out)
        return Solution._made(out[0], self._kept)

    def _mapped(self, function, x):
        x = reals("x", x, (self._size,))
        out = reals.empty(self._size)
        call(function, self._c, pointer(x), pointer(out), len(out))
        return out
