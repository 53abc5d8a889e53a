#include "rotor_model.hpp"

int main()
{
    // Which pitch gives a mean thrust of 8 kN? The shaft holds the hub against it.
    Rotor rotor(5, 0.02);
    const auto pitch = rotor.model.add_parameter("collective pitch", 0.02, 0.1);
    for (const auto bearing : rotor.pitches) {
        rotor.model.move_signal(pitch, bearing, 0, pdn::SignalPart::mean, 1);
    }
    const auto held = pdn::Quantity(pdn::Kind::joint_reaction, rotor.shaft).with_component(0);
    pdn::Conditions conditions;
    conditions.release(pitch);
    conditions.add_quantity(held, pdn::Feature::mean, 0, -8e3);

    const auto solution = pdn::solve_conditioned(rotor.model, rotor.period, conditions);
    std::printf("converged: %s\n", solution.converged() ? "yes" : "no");
    std::printf("pitch: %.3f degrees\n", solution.parameter(pitch) * 180 / pi);
    std::printf("thrust: %.3f kN\n", -1e-3 * solution.harmonics(held, 1).mean[0]);
}
