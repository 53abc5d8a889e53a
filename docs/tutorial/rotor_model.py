import math

import numpy as np

import periodyn as pdn

# Metres, kilograms, seconds. The shaft is along x, as is the wind; blades of 10 m reach from the
# hub, the first one upwards at first. WIND is that at the rotor, which slows it down.
RADIUS, HUB, CHORD, WIND, SHEAR = 10.0, 1.0, 0.6, 6.0, 0.02
HALF_DENSITY, LIFT_SLOPE, DRAG = 0.6, 5.7, 0.01


def airload(width):
    """Lift across and drag along the air that meets a piece of a blade. Axis 2 of its node points
    to the leading edge, axis 3 downwind."""
    def load(state, values):
        height = state.positions[0, 2]
        wind = state.rotations[0].T @ [WIND * (1 + SHEAR * height), 0, 0]
        along, across = (wind - state.velocities[0, :3])[1:]
        factor = HALF_DENSITY * CHORD * width
        speed = math.hypot(along, across)
        values.forces[0, 1] = factor * (LIFT_SLOPE * across**2 + DRAG * speed * along)
        values.forces[0, 2] = factor * (-LIFT_SLOPE * across * along + DRAG * speed * across)
    return load


class Rotor:
    def __init__(self, speed, pitch):
        self.model = model = pdn.Model()
        self.period = 2 * math.pi / speed
        model.set_gravity([0, 0, -9.81])
        hub = model.add_rigid_body(200, [0, 0, 0], np.diag([100, 60, 60]))
        self.shaft = model.add_revolute(pdn.GROUND, hub, [0, 0, 0], [1, 0, 0])
        model.prescribe(self.shaft, pdn.ROTATION, pdn.Signal().set_harmonics(rate=speed))
        section = pdn.Section().set_diagonal(
            [4e8, 1e8, 1e8, 6e5, 6e6, 1e6], [16, 0.5, 0.05, 0.45])
        section.set_proportional_damping(2e-3)
        self.blades, self.pitches = [], []
        for azimuth in (0, 2 * math.pi / 3, 4 * math.pi / 3):
            span = np.array([0, -math.sin(azimuth), math.cos(azimuth)])
            forward = np.array([0, -math.cos(azimuth), -math.sin(azimuth)])
            blade = model.add_straight_beam(HUB * span, RADIUS * span, forward, section, 2, 3)
            bearing = model.add_revolute(hub, blade.first, HUB * span, -span)
            self.pitches.append(model.prescribe(bearing, pdn.ROTATION, pitch))
            self.blades.append(blade)
            for node in range(blade.first, blade.last + 1):
                before = model.node_frame(max(node - 1, blade.first))
                after = model.node_frame(min(node + 1, blade.last))
                width = math.dist(before.position, after.position) / 2
                model.add_user_force(
                    [node], pdn.FRAME_MATERIAL, pdn.TANGENTS_DIFFERENCED, airload(width))
