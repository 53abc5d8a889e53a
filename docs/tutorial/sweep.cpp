#include "rotor_model.hpp"

#include <optional>

int main()
{
    std::optional<pdn::Solution> last;
    for (const double speed : {3.0, 4.0, 5.0, 6.0, 7.0}) {
        Rotor rotor(speed, 0.02);
        pdn::PeriodicOptions options;
        options.initial = last ? &*last : nullptr;
        auto solution = pdn::solve_periodic(rotor.model, rotor.period, options);
        const auto moment = solution.extremes(
            pdn::Quantity(pdn::Kind::beam_force, rotor.blades[0].first_element)
                .with_component(5)
                .with_station(-1));
        std::printf("%.0f rad/s: edgewise moment at the root %.3f to %.3f kN m, %s\n", speed,
                    1e-3 * moment.smallest[0], 1e-3 * moment.largest[0],
                    solution.converged() ? "converged" : "not converged");
        last = std::move(solution);
    }
}
