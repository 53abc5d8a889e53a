#include "rotor_model.hpp"

int main()
{
    const double speed = 5;
    Rotor rotor(speed, 0.02);
    const auto solution = pdn::solve_periodic(rotor.model, rotor.period);
    std::printf("converged: %s\n", solution.converged() ? "yes" : "no");
    const auto torque = solution.harmonics(
        {pdn::Kind::joint_driving_effort, rotor.shaft, pdn::Coordinate::rotation}, 1);
    std::printf("power: %.3f kW\n", -1e-3 * speed * torque.mean[0]);
    const auto at_root = pdn::Quantity(pdn::Kind::beam_force, rotor.blades[0].first_element)
                             .with_component(4)
                             .with_station(-1);
    const auto moment = solution.harmonics(at_root, 2);
    std::printf("flapwise moment at the root: mean %.3f kN m\n", 1e-3 * moment.mean[0]);
    for (std::size_t j = 0; j < 2; ++j) {
        std::printf("  %d a turn: %.3f cos, %.3f sin\n", static_cast<int>(j) + 1,
                    1e-3 * moment.cosines[j], 1e-3 * moment.sines[j]);
    }
}
