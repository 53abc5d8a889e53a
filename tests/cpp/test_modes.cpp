// Modes of the oscillator, whose eigenvalues are known.
#include "check.hpp"

#include <utility>

int main()
{
    Oscillator o;
    int told = 0;
    pdn::ModesOptions options;
    options.count = 1;
    options.equilibrium.progress = [&](const pdn_progress &) { return ++told > 0; };
    const pdn::Modes modes = pdn::solve_modes(o.model, options);
    CHECK(modes.converged() && modes.count().count == 1 && told > 0);
    CHECK(modes.count().complete);
    CHECK(modes.report().find("mode") != std::string::npos);

    // 0.5 s^2 + 0.2 s + 3 = 0
    const auto mode = modes.mode(0);
    NEAR(mode.eigenvalue_real, -0.2, 1e-10);
    NEAR(std::abs(mode.eigenvalue_imaginary), std::sqrt(6 - 0.04), 1e-10);
    NEAR(mode.damping_ratio, 0.2 / std::sqrt(6.0), 1e-10);
    const auto shape = modes.shape(0, {o.body, o.body});
    CHECK(shape.real.size() == 2 && shape.real[0] == shape.real[1]);
    NEAR(std::hypot(shape.real[0][5], shape.imaginary[0][5]), 1, 1e-10);
    NEAR(shape.real[0][0], 0, 1e-10);
    const auto motion = modes.motion(0, 0.01);
    const auto angle =
        motion.harmonics({pdn::Kind::joint_coordinate, o.hinge, pdn::Coordinate::rotation}, 1);
    NEAR(std::hypot(angle.cosines[0], angle.sines[0]), 0.01, 1e-10);
    const auto equilibrium = modes.equilibrium();
    CHECK(equilibrium.converged());
    NEAR(equilibrium.sample({pdn::Kind::joint_coordinate, o.hinge, pdn::Coordinate::rotation},
                            {0})[0],
         0, 1e-12);

    // From that equilibrium; with a signal that modes and what they give keep.
    pdn::StaticOptions at_rest;
    at_rest.initial = &equilibrium;
    options.equilibrium = at_rest;
    CHECK(pdn::solve_modes(o.model, options).converged());
    const auto token = std::make_shared<int>(0);
    {
        pdn::Solution kept = [&] {
            Oscillator other;
            other.model.add_load(other.body, pdn::Frame::space, pdn::Component::moment_3,
                                 [token](double) { return 0.0 + *token; });
            return pdn::solve_modes(other.model).motion(0, 0.1);
        }();
        CHECK(token.use_count() == 2 && kept.grid_times().size() > 1);
    }
    CHECK(token.use_count() == 1);

    // A callback that throws.
    options = {};
    options.equilibrium.progress = [](const pdn_progress &) -> bool {
        throw std::domain_error("enough");
    };
    try {
        pdn::solve_modes(o.model, options);
        std::exit(1);
    } catch (const std::domain_error &e) {
        CHECK(e.what() == std::string("enough"));
    }

    options = {};
    options.count = 0;
    REFUSED(pdn::solve_modes(o.model, options), PDN_ERR_SIZE, "options.count: ");
    options.count = 1;
    options.near_frequency = nan_value;
    REFUSED(pdn::solve_modes(o.model, options), PDN_ERR_NOT_FINITE, "options.near_frequency: ");
    options.near_frequency = 0;
    options.equilibrium.load_steps = 0;
    REFUSED(pdn::solve_modes(o.model, options), PDN_ERR_VALUE,
            "options.equilibrium: options.load_steps: ");
    REFUSED(pdn::solve_modes(pdn::Model()), PDN_ERR_MODEL, "model: ");
    REFUSED(modes.mode(1), PDN_ERR_ID, "mode: ");
    REFUSED(modes.shape(0, {7}), PDN_ERR_ID, "nodes");
    REFUSED(modes.shape(-1, {0}), PDN_ERR_ID, "mode: ");
    REFUSED(modes.motion(0, infinity), PDN_ERR_NOT_FINITE, "amplitude: ");
    pdn::Modes moved = pdn::solve_modes(o.model), other = std::move(moved);
    REFUSED(moved.count(), PDN_ERR_NULL, "modes: ");
    REFUSED(moved.outcome(), PDN_ERR_NULL, "modes: ");
    REFUSED(moved.report(), PDN_ERR_NULL, "modes: ");
    REFUSED(moved.equilibrium(), PDN_ERR_NULL, "modes: ");
    return 0;
}
