"""The examples forced_cantilever and rotor_blade in Exudyn: marched from rest until they are periodic."""

import math
import time

import exudyn as exu
import exudyn.itemInterface as item
import numpy as np

SAMPLES = 100  # a period, in what is returned


def march(mbs, sensors, period, periods, steps):
    """The last period of the sensors at SAMPLES times, how much it differs from the one before relative to
    its range, and the seconds of the processor it took. Generalised-alpha, `steps` steps to a period."""
    mbs.Assemble()
    settings = exu.SimulationSettings()
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = period / SAMPLES
    integration = settings.timeIntegration
    integration.numberOfSteps = steps * periods
    integration.endTime = period * periods
    integration.adaptiveStep = False
    integration.verboseMode = 0
    integration.generalizedAlpha.spectralRadius = 0.9
    integration.newton.useModifiedNewton = False
    start = time.process_time()
    mbs.SolveDynamic(settings)
    seconds = time.process_time() - start
    curves = np.hstack([mbs.GetSensorStoredData(sensor)[:, 1:] for sensor in sensors])
    last, before = curves[-SAMPLES - 1:-1], curves[-2 * SAMPLES - 1:-SAMPLES - 1]
    unsettled = np.abs(last - before).max(axis=0) / np.maximum(np.ptp(last, axis=0), 1e-300)
    return last, unsettled, seconds


def sensor_of_node(mbs, node):
    return mbs.AddSensor(item.SensorNode(nodeNumber=node, storeInternal=True,
                                         outputVariableType=exu.OutputVariableType.Position))


def forced_cantilever(elements, steps, periods=45):
    """Tip's displacements along and upwards, bending moment at the root. Plane three-node beams."""
    mbs = exu.SystemContainer().AddSystem()
    length, period, force = 1.0, 0.3, 12.0
    nodes = [mbs.AddNode(item.NodeRigidBody2D(referenceCoordinates=[x, 0, 0]))
             for x in np.linspace(0, length, 2 * elements + 1)]
    for i in range(elements):
        beam = mbs.AddObject(item.ObjectBeamGeometricallyExact2D(
            nodeNumbers=nodes[2 * i:2 * i + 3], length=length / elements, massPerLength=0.361,
            crossSectionInertia=9.0e-6, axialStiffness=785e3, shearStiffness=250e3, bendingStiffness=19.6,
            bendingDamping=5e-3 * 19.6))
        whole = mbs.AddMarker(item.MarkerBodyMass(bodyNumber=beam))
        mbs.AddLoad(item.LoadMassProportional(markerNumber=whole, loadVector=[0, -9.81, 0]))

    ground = mbs.AddNode(item.NodePointGround())
    fixed = mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
    clamp = [mbs.AddObject(item.CoordinateConstraint(markerNumbers=[
        fixed, mbs.AddMarker(item.MarkerNodeCoordinate(nodeNumber=nodes[0], coordinate=c))])) for c in range(3)]

    def shake(mbs, t, load):
        return [0, force * math.cos(2 * math.pi * t / period), 0]

    tip = mbs.AddMarker(item.MarkerNodePosition(nodeNumber=nodes[-1]))
    mbs.AddLoad(item.LoadForceVector(markerNumber=tip, loadVector=[0, force, 0], loadVectorUserFunction=shake))
    sensors = [sensor_of_node(mbs, nodes[-1]),
               mbs.AddSensor(item.SensorObject(objectNumber=clamp[2], storeInternal=True,
                                               outputVariableType=exu.OutputVariableType.Force))]
    curves, unsettled, seconds = march(mbs, sensors, period, periods, steps)
    pick = [0, 1, 3]
    return curves[:, pick] - [length, 0, 0], unsettled[pick].max(), seconds


def rotor_blade(elements, steps, periods=45):
    """Tip's flap and lag deflection, flap, lag and torsional moment at the root, in the turning frame.
    Two-node beams on SE(3)."""
    mbs = exu.SystemContainer().AddSystem()
    root, length, pitch, omega = 0.5, 10.0, math.radians(8), 2 * math.pi
    axes = np.array([[0, math.cos(pitch), -math.sin(pitch)], [0, math.sin(pitch), math.cos(pitch)], [1, 0, 0]])
    # Angles about x, y, z. The shaft is x, so that the first counts the turns and none meets its singularity.
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
        # The beam itself knows no damping. The difference of the ends' angular velocities, in the axes
        # half-way between, is its rate of curvature.
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
    seat = mbs.AddMarker(item.MarkerBodyRigid(bodyNumber=body, localHT=exu.HT(translation=[0, 0, root])))
    foot = mbs.AddMarker(item.MarkerNodeRigid(nodeNumber=nodes[0], localHT=exu.HT(rotation=axes.T)))
    clamp = mbs.AddObject(item.GenericJoint(markerNumbers=[seat, foot]))

    def lift(mbs, t, load):
        return [3000 + 1000 * math.cos(omega * t) + 200 * math.sin(2 * omega * t), 0, 0]

    mbs.AddLoad(item.LoadForceVector(markerNumber=markers[-1], loadVector=[4000, 0, 0], loadVectorUserFunction=lift))
    sensors = [sensor_of_node(mbs, nodes[-1]),
               mbs.AddSensor(item.SensorObject(objectNumber=clamp, storeInternal=True,
                                               outputVariableType=exu.OutputVariableType.TorqueLocal))]
    curves, unsettled, seconds = march(mbs, sensors, 1.0, periods, steps)
    angle = omega * np.arange(SAMPLES) / SAMPLES
    lag = np.cos(angle) * curves[:, 1] + np.sin(angle) * curves[:, 2]
    # The joint's torques about axes 1 and 2 are counted against, about axis 3 with our reactions' sense. That of
    # axis 1 can be told by the weight of the blade as it lies level, at t = 1/4 s.
    turned = np.column_stack([curves[:, 0], lag, -curves[:, 4], -curves[:, 3], curves[:, 5]])
    return turned, unsettled.max(), seconds
