"""Models that the tests share; importable by the processes of a sweep."""

import numpy as np

import periodyn as pdn


def oscillator(stiffness=4.0, damping=0.1, force=np.cos):
    """A mass of 1 on a spring along axis 1; the model, its node, its joint and its spring."""
    model = pdn.Model()
    body = model.add_rigid_body(1, [0, 0, 0], np.eye(3))
    joint = model.add_prismatic(pdn.GROUND, body, [0, 0, 0], [1, 0, 0])
    spring = model.add_spring_damper(joint, pdn.DISPLACEMENT, stiffness, damping, 0)
    model.add_load(body, pdn.FRAME_SPACE, pdn.FORCE_1, force)
    return model, body, joint, spring


def response(stiffness):
    """The amplitude of the oscillator's response at frequency 1."""
    model, body, *_ = oscillator(stiffness)
    _, _, cosines, sines = model.solve_periodic(2 * np.pi).harmonics(
        pdn.Quantity(pdn.NODE_POSITION, body), 1
    )
    return float(np.hypot(cosines[0, 0], sines[0, 0]))


def solution_for(stiffness):
    """A solution, to be sent from one process to another."""
    model, *_ = oscillator(stiffness, force=pdn.Signal().set_harmonics(cosines=[1], sines=[0]))
    return model.solve_periodic(2 * np.pi)


def cantilever(elements=3, degree=3):
    """A steel rod of 1 m along axis 1, clamped, with a force of 1 N along axis 3 at its tip; and
    its bending stiffness."""
    bending = 200.0
    section = pdn.Section().set_diagonal([2e7, 7e6, 7e6, 150, bending, bending],
                                         [0.8, 2e-5, 1e-5, 1e-5])
    model = pdn.Model()
    beam = model.add_straight_beam([0, 0, 0], [1, 0, 0], [0, 1, 0], section, elements, degree)
    model.add_rigid_joint(pdn.GROUND, beam.first, [0, 0, 0])
    model.add_load(beam.last, pdn.FRAME_SPACE, pdn.FORCE_3, 1.0)
    return model, beam, bending
