"""Benchmark models in Exudyn: marched from rest until they are periodic.

Each function returns curves at SAMPLES times of each period, [period, time, curve], and seconds."""

import math
import time

import exudyn as exu
import exudyn.itemInterface as item
import numpy as np
from exudyn.rigidBodyUtilities import (
    AngularVelocity2EulerParameters_t,
    RotationMatrix2EulerParameters,
)

SAMPLES = 100  # a period, in what is returned; steps to a period are a multiple


def march(mbs, sensors, period, periods, steps, radius=0.9, sparse=False):
    """The sensors at SAMPLES times of each period, [period, time, curve], and the seconds of the
    processor it took. Generalised-alpha of this spectral radius, `steps` steps to a period.
    `sparse`: with the sparse solver and modified Newton's method."""
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = period / SAMPLES
    if sparse:
        settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
    integration = settings.timeIntegration
    integration.numberOfSteps = steps * periods
    integration.endTime = period * periods
    integration.adaptiveStep = False
    integration.verboseMode = 0
    integration.generalizedAlpha.spectralRadius = radius
    integration.newton.useModifiedNewton = sparse
    start = time.process_time()
    if not mbs.SolveDynamic(settings):
        raise RuntimeError("Exudyn's march failed")
    seconds = time.process_time() - start
    curves = np.hstack([mbs.GetSensorStoredData(sensor)[:, 1:] for sensor in sensors])
    return curves[:SAMPLES * periods].reshape(periods, SAMPLES, -1), seconds


def unsettled(curves):
    """How much the last two periods differ, relative to the range of each curve."""
    return (np.abs(curves[-1] - curves[-2]).max(axis=0) / np.ptp(curves[-1], axis=0)).max()


def sensors_of_node(mbs, node):
    """Position and velocity."""
    return [
        mbs.AddSensor(
            item.SensorNode(nodeNumber=node, storeInternal=True, outputVariableType=output)
        )
        for output in (exu.OutputVariableType.Position, exu.OutputVariableType.Velocity)
    ]


def forced_cantilever(elements, steps, periods=45, **scheme):
    """Tip's displacements along and upwards, bending moment at the root, the tip's velocity
    upwards. Plane three-node beams."""
    mbs = exu.SystemContainer().AddSystem()
    length, period, force = 1.0, 0.3, 12.0
    nodes = [mbs.AddNode(item.NodeRigidBody2D(referenceCoordinates=[x, 0, 0]))
             for x in np.linspace(0, length, 2 * elements + 1)]
    for i in range(elements):
        beam = mbs.AddObject(
            item.ObjectBeamGeometricallyExact2D(
                nodeNumbers=nodes[2 * i : 2 * i + 3],
                length=length / elements,
                massPerLength=0.361,
                crossSectionInertia=9.0e-6,
                axialStiffness=785e3,
                shearStiffness=250e3,
                bendingStiffness=19.6,
                bendingDamping=5e-3 * 19.6,
            )
        )
        whole = mbs.AddMarker(item.MarkerBodyMass(bodyNumber=beam))
        mbs.AddLoad(item.LoadMassProportional(markerNumber=whole, loadVector=[0, -9.81, 0]))

    ground = mbs.AddNode(item.NodePointGround())
    fixed = mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
    clamp = [
        mbs.AddObject(
            item.CoordinateConstraint(
                markerNumbers=[
                    fixed,
                    mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=nodes[0], coordinate=c)),
                ]
            )
        )
        for c in range(3)
    ]

    def shake(mbs, t, load):
        return [0, force * math.cos(2 * math.pi * t / period), 0]

    tip = mbs.AddMarker(item.MarkerNodePosition(nodeNumber=nodes[-1]))
    mbs.AddLoad(
        item.LoadForceVector(
            markerNumber=tip, loadVector=[0, force, 0], loadVectorUserFunction=shake
        )
    )
    sensors = [*sensors_of_node(mbs, nodes[-1]),
               mbs.AddSensor(item.SensorObject(objectNumber=clamp[2], storeInternal=True,
                                               outputVariableType=exu.OutputVariableType.Force))]
    curves, seconds = march(mbs, sensors, period, periods, steps, **scheme)
    return curves[:, :, [0, 1, 6, 4]] - [length, 0, 0, 0], seconds


def rotor_blade(elements, steps, periods=45, **scheme):
    """Tip's flap and lag deflection, flap, lag and torsional moment at the root, in the turning
    frame, and the rate of flap. Two-node beams on SE(3)."""
    mbs = exu.SystemContainer().AddSystem()
    root, length, pitch, omega = 0.5, 10.0, math.radians(8), 2 * math.pi
    axes = np.array(
        [[0, math.cos(pitch), -math.sin(pitch)], [0, math.sin(pitch), math.cos(pitch)], [1, 0, 0]]
    )
    # Angles about x, y, z. The shaft is x, so that the first counts the turns and none meets its
    # singularity.
    angles = [-math.pi / 2, -pitch, -math.pi / 2]
    stiffness = np.array([500e6, 100e6, 100e6, 500e3, 3.87e6, 1.30e6])
    section = exu.BeamSection()
    section.stiffnessMatrix = np.diag(stiffness)
    section.massPerLength = 20.0
    section.inertia = np.diag([0.20, 0.15, 0.05])

    nodes = [mbs.AddNode(item.NodeRigidBodyRxyz(referenceCoordinates=[0, 0, z] + angles,
                                                initialVelocities=[0, -omega * z, 0, omega, 0, 0]))
             for z in np.linspace(root, root + length, elements + 1)]
    markers = [mbs.AddMarker(item.MarkerNodeRigid(nodeNumber=node)) for node in nodes]
    size = length / elements
    for pair, ends in zip(zip(nodes, nodes[1:]), zip(markers, markers[1:])):
        beam = mbs.AddObject(item.ObjectBeamGeometricallyExact(nodeNumbers=list(pair), length=size,
                                                               sectionData=section))
        whole = mbs.AddMarker(item.MarkerBodyMass(bodyNumber=beam))
        mbs.AddLoad(item.LoadMassProportional(markerNumber=whole, loadVector=[0, 0, -9.81]))
        # The beam itself knows no damping. The difference of the ends' angular velocities, in the
        # axes half-way between, is its rate of curvature.
        damping = np.diag(0.01 * stiffness / size)
        damping[:3] = 0
        mbs.AddObject(item.RigidBodySpringDamper(markerNumbers=list(ends), damping=damping,
                                                 useIntrinsicFormulation=True))

    # The hub: a body whose first angle turns.
    hub = mbs.AddNode(item.NodeRigidBodyRxyz(initialVelocities=[0, 0, 0, omega, 0, 0]))
    body = mbs.AddObject(item.ObjectRigidBody(nodeNumber=hub, mass=1, inertia=[1, 1, 1, 0, 0, 0]))
    ground = mbs.AddNode(item.NodePointGround())
    fixed = mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))

    def turn(mbs, t, number, offset):
        return omega * t

    for c in range(6):
        coordinate = mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=hub, coordinate=c))
        prescribed = {"offsetUserFunction": turn} if c == 3 else {}
        mbs.AddObject(item.CoordinateConstraint(markerNumbers=[fixed, coordinate], **prescribed))
    seat = mbs.AddMarker(
        item.MarkerBodyRigid(bodyNumber=body, localHT=exu.HT(translation=[0, 0, root]))
    )
    foot = mbs.AddMarker(item.MarkerNodeRigid(nodeNumber=nodes[0], localHT=exu.HT(rotation=axes.T)))
    clamp = mbs.AddObject(item.GenericJoint(markerNumbers=[seat, foot]))

    def lift(mbs, t, load):
        return [3000 + 1000 * math.cos(omega * t) + 200 * math.sin(2 * omega * t), 0, 0]

    mbs.AddLoad(
        item.LoadForceVector(
            markerNumber=markers[-1], loadVector=[4000, 0, 0], loadVectorUserFunction=lift
        )
    )
    sensors = [
        *sensors_of_node(mbs, nodes[-1]),
        mbs.AddSensor(
            item.SensorObject(
                objectNumber=clamp,
                storeInternal=True,
                outputVariableType=exu.OutputVariableType.TorqueLocal,
            )
        ),
    ]
    curves, seconds = march(mbs, sensors, 1.0, periods, steps, **scheme)
    flap, y, z, rate, _, _, *torque = np.moveaxis(curves, 2, 0)
    angle = omega * np.arange(SAMPLES) / SAMPLES
    lag = np.cos(angle) * y + np.sin(angle) * z
    # The joint's torques about axes 1 and 2 are counted against, about axis 3 with our reactions'
    # sense. That of axis 1 can be told by the weight of the blade as it lies level, at t = 1/4 s.
    return np.stack([flap, lag, -torque[1], -torque[0], torque[2], rate], axis=2), seconds


def spatial_four_bar(elements, steps, periods=2, **scheme):
    """Height and vertical velocity of B, and the torque of the motor. Two-node beams on SE(3)."""
    mbs = exu.SystemContainer().AddSystem()
    a, b, c, d = np.array([[-0.4, 0, 0], [-0.75, 0, 0.652], [0, 0.85, 0.2], [0, 0.85, 0]])
    i1, i2 = np.array([1.0, 0, 0]), np.array([0, 1.0, 0])

    def steel(stiffness, mass, inertia):
        section = exu.BeamSection()
        section.stiffnessMatrix = np.diag(stiffness)
        section.massPerLength = mass
        section.inertia = np.diag(inertia)
        return section

    thick = steel(
        [52.99e6, 16.88e6, 16.88e6, 733.5, 1131.0, 1131.0], 1.997, [85.2e-6, 42.6e-6, 42.6e-6]
    )
    thin = steel(
        [13.25e6, 4.22e6, 4.22e6, 45.84, 70.66, 70.66], 0.4992, [5.324e-6, 2.662e-6, 2.662e-6]
    )

    def frame(third, first):
        """Axes, as columns, of which the third and the first are near these."""
        third = third / np.linalg.norm(third)
        second = np.cross(third, first)
        second /= np.linalg.norm(second)
        return np.column_stack([np.cross(second, third), second, third])

    # Velocities of the rigid mechanism in the beginning: they are those of the prescribed turn.
    cross = np.cross(i1, c - b)
    of_crank = 0.36 * i1
    at_c = np.cross(of_crank, c - d)
    of_rocker = i2 * (at_c @ (c - b)) / (np.cross(i2, b - a) @ (c - b))
    at_b = np.cross(of_rocker, b - a)
    of_coupler = np.cross(c - b, at_c - at_b) / ((c - b) @ (c - b))
    normal = np.cross(cross, i1)
    of_coupler += (c - b) * ((of_crank - of_coupler) @ normal) / ((c - b) @ normal)

    def bar(start, end, across, section, velocity, rate):
        """Nodes and the axes they have in the beginning; velocity of the first, rate of turning of
        all."""
        along = (end - start) / np.linalg.norm(end - start)
        axes = frame(np.cross(along, across), along)
        turn = RotationMatrix2EulerParameters(axes)
        turning = AngularVelocity2EulerParameters_t(rate, turn)
        nodes = [
            mbs.AddNode(
                item.NodeRigidBodyEP(
                    referenceCoordinates=[*(start + s * (end - start)), *turn],
                    initialVelocities=[*(velocity + s * np.cross(rate, end - start)), *turning],
                )
            )
            for s in np.linspace(0, 1, elements + 1)
        ]
        for pair in zip(nodes, nodes[1:]):
            mbs.AddObject(
                item.ObjectBeamGeometricallyExact(
                    nodeNumbers=list(pair),
                    length=np.linalg.norm(end - start) / elements,
                    sectionData=section,
                )
            )
        return nodes, axes

    rocker, rocker_axes = bar(a, b, i2, thick, 0 * a, of_rocker)
    coupler, coupler_axes = bar(b, c, i1, thick, at_b, of_coupler)
    crank, crank_axes = bar(c, d, i1, thin, at_c, of_crank)
    ground = mbs.AddObject(item.ObjectGround())

    def on_node(node, axes, wanted):
        return mbs.AddMarker(
            item.MarkerNodeRigid(nodeNumber=node, localHT=exu.HT(rotation=axes.T @ wanted))
        )

    # Rocker: turns about the third axis of the markers, against the spring.
    hinge = frame(i2, i1)
    markers = [
        mbs.AddMarker(
            item.MarkerBodyRigid(bodyNumber=ground, localHT=exu.HT(rotation=hinge, translation=a))
        ),
        on_node(rocker[0], rocker_axes, hinge),
    ]
    mbs.AddObject(item.GenericJoint(markerNumbers=markers, constrainedAxes=[1, 1, 1, 1, 1, 0]))
    mbs.AddObject(item.TorsionalSpringDamper(markerNumbers=markers, stiffness=18.0))
    mbs.AddObject(item.SphericalJoint(markerNumbers=[on_node(rocker[-1], rocker_axes, np.eye(3)),
                                                     on_node(coupler[0], coupler_axes, np.eye(3))]))
    # Universal: the first axis on the coupler stays normal to the second on the crank.
    mbs.AddObject(item.GenericJoint(
        markerNumbers=[on_node(coupler[-1], coupler_axes, frame(normal, cross)),
                       on_node(crank[0], crank_axes, frame(normal, cross))],
        constrainedAxes=[1, 1, 1, 0, 0, 1]))

    # The motor: a light body whose first angle turns.
    motor = mbs.AddNode(item.NodeRigidBodyRxyz(referenceCoordinates=[*d, 0, 0, 0],
                                                  initialVelocities=[0, 0, 0, 0.36, 0, 0]))
    body = mbs.AddObject(
        item.ObjectRigidBody(nodeNumber=motor, mass=1e-3, inertia=[1e-6, 1e-6, 1e-6, 0, 0, 0])
    )
    still = mbs.AddNode(item.NodePointGround())
    fixed = mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=still, coordinate=0))

    def turn(mbs, t, number, offset):
        return (
            0.3 * t
            + (1 - math.cos(0.3 * t)) / 3
            + math.sin(0.6 * t) / 10
            + (1 - math.cos(0.9 * t)) / 21
        )

    for coordinate in range(6):
        marker = mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=motor, coordinate=coordinate))
        prescribed = {"offsetUserFunction": turn} if coordinate == 3 else {}
        mbs.AddObject(item.CoordinateConstraint(markerNumbers=[fixed, marker], **prescribed))
    clamp = mbs.AddObject(
        item.GenericJoint(
            markerNumbers=[
                mbs.AddMarker(item.MarkerBodyRigid(bodyNumber=body)),
                on_node(crank[-1], crank_axes, np.eye(3)),
            ]
        )
    )

    sensors = [
        *sensors_of_node(mbs, rocker[-1]),
        mbs.AddSensor(
            item.SensorObject(
                objectNumber=clamp,
                storeInternal=True,
                outputVariableType=exu.OutputVariableType.TorqueLocal,
            )
        ),
    ]
    curves, seconds = march(mbs, sensors, 2 * math.pi / 0.3, periods, steps, **scheme)
    return curves[:, :, [2, 5, 6]] * [1, 1, -1], seconds  # the joint's torque is on the motor
