"""The equations below the solve, with a solver of scipy's kind: a few lines of Newton's method."""

import numpy
import pytest

import periodyn as pdn


def test_newton_with_a_fixed_point_iteration_finds_what_the_library_finds():
    model, period = pendulum()
    expected = model.solve_periodic(period, grid_points=15)
    start = model.solve_periodic(period, grid_points=5)
    equations = pdn.Equations(model, period, 15, initial=start)
    sizes = equations.sizes()
    assert sizes.size == sizes.total and sizes.halo == 0
    assert (equations.numbers() == numpy.arange(sizes.size)).all()
    for _ in range(6):
        equations.linearise()
        residual = equations.residual()
        jacobian = numpy.stack([equations.product(x) for x in numpy.eye(sizes.size)], axis=1)
        increment = numpy.linalg.solve(jacobian, -residual)
        equations.update(increment)
    assert equations.norms(increment)[0] < 1e-9
    found = equations.solution()
    times = numpy.linspace(0, period, 7)
    node = int(equations.nodes()[0])
    difference = found.sample(pdn.Quantity(pdn.NODE_POSITION, node), times) - expected.sample(
        pdn.Quantity(pdn.NODE_POSITION, node), times
    )
    assert abs(difference).max() < 1e-10
    motions, own = equations.state()
    equations.set_state(motions, own)
    equations.factor(residual + 1)
    assert numpy.isfinite(equations.precondition(residual)).all()
    assert equations.compliance(increment) is None
    with pytest.raises(pdn.Error, match="x: expected an array"):
        equations.product(increment[1:])


def pendulum():
    model = pdn.Model()
    body = model.add_rigid_body(2.0, [0.5, 0, 0], numpy.eye(3) * 0.1)
    hinge = model.add_revolute(pdn.GROUND, body, [0, 0, 0], [0, 1, 0])
    model.add_spring_damper(hinge, pdn.ROTATION, 30.0, 0.5)
    model.set_gravity([0, 0, -9.81])
    push = pdn.Signal()
    push.set_harmonics(cosines=[1.0], sines=[0.5])
    model.add_load(body, pdn.FRAME_SPACE, pdn.FORCE_3, push)
    return model, 2.0


def test_the_pencil_has_the_multipliers_of_the_period():
    model, period = pendulum()
    solution = model.solve_periodic(period, grid_points=15)
    equations = pdn.Equations(model, period, 15, initial=solution,
                              preconditioner=pdn.LINEAR_TIME_LOCAL)
    equations.linearise()
    unit = numpy.eye(equations.sizes().size)

    def matrix(product):
        return numpy.stack([product(x) for x in unit], axis=1)

    stiffness = matrix(equations.product)
    numpy.testing.assert_allclose(matrix(equations.transposed_product), stiffness.T, rtol=0,
                                  atol=1e-13 * abs(stiffness).max())
    damping, mass = (matrix(lambda x, p=power: equations.power_product(p, x)) for power in (1, 2))
    # 1/mu of (x, mu x); the nearest to zero are the pair of the pendulum's freedom.
    step = numpy.linalg.solve(stiffness, numpy.hstack([-damping, -mass]))
    inverse = numpy.linalg.eigvals(numpy.vstack([step, numpy.hstack([unit, 0 * unit])]))
    exponents = 1 / inverse[numpy.argsort(-abs(inverse))[:2]]
    found = sorted(numpy.exp(exponents * period), key=lambda rho: rho.imag)
    real, imaginary = solution.floquet()
    expected = sorted(real + 1j * imaginary, key=lambda rho: rho.imag)
    # What 7 harmonics leave out.
    numpy.testing.assert_allclose(found, expected, atol=1e-6)
    with pytest.raises(pdn.Error, match="power: expected 1 or 2, got 3"):
        equations.power_product(3, unit[0])
