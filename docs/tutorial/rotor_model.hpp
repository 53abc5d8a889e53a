#include <array>
#include <cmath>
#include <cstdio>
#include <periodyn.hpp>

namespace pdn = periodyn;

// Metres, kilograms, seconds. The shaft is along x, as is the wind; blades of 10 m reach from the
// hub, the first one upwards at first. wind is that at the rotor, which slows it down.
constexpr double pi = 3.14159265358979323846, radius = 10, hub_radius = 1, chord = 0.6;
constexpr double wind = 6, shear = 0.02, half_density = 0.6, lift_slope = 5.7, drag = 0.01;

// Lift across and drag along the air that meets a piece of a blade. Axis 2 of its node points to
// the leading edge, axis 3 downwind.
inline auto airload(double width)
{
    return [width](const pdn::ForceState &state, pdn::ForceValues &values) {
        const double here = wind * (1 + shear * state.positions(2, 0));
        const double along = here * state.rotations(3, 0) - state.velocities(1, 0);
        const double across = here * state.rotations(6, 0) - state.velocities(2, 0);
        const double factor = half_density * chord * width, speed = std::hypot(along, across);
        values.forces(1, 0) = factor * (lift_slope * across * across + drag * speed * along);
        values.forces(2, 0) = factor * (-lift_slope * across * along + drag * speed * across);
    };
}

struct Rotor {
    pdn::Model model;
    double period;
    std::int32_t shaft;
    std::array<std::int32_t, 3> pitches;
    std::array<pdn_beam, 3> blades;

    Rotor(double speed, double pitch) : period(2 * pi / speed)
    {
        model.set_gravity({0, 0, -9.81});
        const auto hub = model.add_rigid_body(200, {0, 0, 0}, {100, 0, 0, 0, 60, 0, 0, 0, 60});
        shaft = model.add_revolute(pdn::ground, hub, {0, 0, 0}, {1, 0, 0});
        model.prescribe(shaft, pdn::Coordinate::rotation, pdn::Signal().set_harmonics(0, speed));
        pdn::Section section;
        section.set_diagonal({4e8, 1e8, 1e8, 6e5, 6e6, 1e6}, {16, 0.5, 0.05, 0.45});
        section.set_proportional_damping(2e-3);
        for (std::size_t b = 0; b < blades.size(); ++b) {
            const double azimuth = 2 * pi * static_cast<double>(b) / 3;
            const double s = std::sin(azimuth), c = std::cos(azimuth);
            const pdn::Vector3 root{0, -hub_radius * s, hub_radius * c};
            const auto blade = blades[b] = model.add_straight_beam(
                root, {0, -radius * s, radius * c}, {0, -c, -s}, section, 2, 3);
            const auto bearing = model.add_revolute(hub, blade.first, root, {0, s, -c});
            pitches[b] = model.prescribe(bearing, pdn::Coordinate::rotation, pitch);
            for (auto node = blade.first; node <= blade.last; ++node) {
                const auto before = model.node_frame(std::max(node - 1, blade.first));
                const auto after = model.node_frame(std::min(node + 1, blade.last));
                const double width = std::hypot(after.position[1] - before.position[1],
                                                after.position[2] - before.position[2]) / 2;
                model.add_user_force({node}, pdn::Frame::material, pdn::Tangents::differenced,
                                     airload(width));
            }
        }
    }
};
