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
    difference = found.node_position(node, times) - expected.node_position(node, times)
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
