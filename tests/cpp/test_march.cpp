// A march of the oscillator against its free vibration in closed form.
#include "check.hpp"

#include <utility>

int main()
{
    Oscillator o;
    pdn::MarchOptions options;
    options.duration = 2;
    options.step = 1e-3;
    options.spectral_radius = 1;
    options.positions = {origin};
    options.rotations = {identity};
    options.velocities = {{0, 0, 0, 0, 0, 0.3}};
    int steps = 0;
    options.progress = [&](const pdn_progress &progress) {
        // It is told within steps that last, too.
        steps += progress.iterated && progress.stage == pdn::detail::in(pdn::Stage::march);
        return true;
    };
    const auto free = pdn::solve_march(o.model, options);
    CHECK(free.converged() && steps == 2000);
    const auto figures = free.march();
    CHECK(figures.steps == 2000 && figures.last_time == 2);
    CHECK(free.grid_times().size() == 2001);
    // Second order: with rate 2.4 and step 1e-3 the error is a few 1e-7.
    const double rate = std::sqrt(6 - 0.04), t = 1.7;
    NEAR(free.sample({pdn::Kind::joint_coordinate, o.hinge, pdn::Coordinate::rotation}, {t})[0],
         0.3 / rate * std::exp(-0.2 * t) * std::sin(rate * t), 1e-6);

    // Until periodic, from a periodic solution; which a march then is the start of.
    o.model.add_load(o.body, pdn::Frame::space, pdn::Component::moment_3,
                     pdn::Signal().set_harmonics(0, 0, {0.6}, {0}));
    const auto periodic = pdn::solve_periodic(o.model, period);
    options = {};
    options.initial = &periodic;
    options.period = period;
    options.steps_per_period = 200;
    options.periodic_tolerance = 1e-2;
    const auto steady = pdn::solve_march(o.model, options);
    CHECK(steady.converged() && steady.march().periods <= 3 && steady.march().repetition < 1e-2);
    pdn::PeriodicOptions from;
    from.initial = &steady;
    CHECK(pdn::solve_periodic(o.model, period, from).converged());

    // By shooting: the free vibration decays by exp(-0.2 T) in a period.
    pdn::ShootingOptions shot;
    shot.steps_per_period = 400;
    const auto by_shooting = pdn::solve_shooting(o.model, period, shot);
    CHECK(by_shooting.converged());
    const auto largest = [](const pdn::SolutionFloquet &multipliers) {
        return std::hypot(multipliers.real[0], multipliers.imaginary[0]);
    };
    NEAR(largest(by_shooting.floquet()), std::exp(-0.2 * period), 1e-3);
    NEAR(by_shooting.sample({pdn::Kind::joint_coordinate, o.hinge, pdn::Coordinate::rotation},
                            {0.3 * period})[0],
         periodic.sample({pdn::Kind::joint_coordinate, o.hinge, pdn::Coordinate::rotation},
                         {0.3 * period})[0],
         1e-4);
    shot.initial = &periodic;
    shot.progress = [](const pdn_progress &) { return false; };
    CHECK(pdn::solve_shooting(o.model, period, shot).outcome() == pdn::Outcome::cancelled);
    shot.progress = nullptr;
    shot.tolerance = nan_value;
    REFUSED(pdn::solve_shooting(o.model, period, shot), PDN_ERR_NOT_FINITE, "options.tolerance: ");
    REFUSED(pdn::solve_shooting(o.model, -1), PDN_ERR_VALUE, "period: ");
    NEAR(largest(periodic.floquet()), std::exp(-0.2 * period), 1e-8);
    REFUSED(pdn::solve_static(o.model).floquet(), PDN_ERR_NOT_AVAILABLE, "stability: ");

    // The same of the periodic solution, to rounding.
    pdn::StabilityOptions asked;
    asked.tolerance = 1e-10;
    const auto stability = pdn::solve_stability(periodic, asked);
    CHECK(stability.outcome() == pdn::Outcome::converged);
    const auto [verdict, frequency_limit] = stability.verdict();
    CHECK(verdict == pdn::Verdict::stable && frequency_limit > 1e300);
    CHECK(stability.count().count == 2 && stability.count().states == 2);
    const auto multiplier = stability.multiplier(0);
    NEAR(std::hypot(multiplier.real, multiplier.imaginary), std::exp(-0.2 * period), 1e-10);
    CHECK(multiplier.trivial == 0 && multiplier.error < 1e-10);
    const auto mode = stability.shape(0, o.body);
    CHECK(mode.real.size() == stability.times().size() && mode.imaginary.size() > 5);
    CHECK(stability.report().find("Stability: stable") == 0);
    REFUSED(stability.multiplier(2), PDN_ERR_ID, "number: ");
    REFUSED(stability.shape(0, 1), PDN_ERR_ID, "node: ");
    asked.tolerance = nan_value;
    REFUSED(pdn::solve_stability(periodic, asked), PDN_ERR_NOT_FINITE, "options.tolerance: ");
    REFUSED(pdn::solve_stability(by_shooting), PDN_ERR_NOT_AVAILABLE, "stability: ");

    options.progress = [](const pdn_progress &) -> bool { throw std::domain_error("enough"); };
    try {
        pdn::solve_march(o.model, options);
        std::exit(1);
    } catch (const std::domain_error &e) {
        CHECK(e.what() == std::string("enough"));
    }
    options.progress = [](const pdn_progress &) { return false; };
    CHECK(pdn::solve_march(o.model, options).outcome() == pdn::Outcome::cancelled);

    REFUSED(pdn::solve_march(o.model, {}), PDN_ERR_VALUE, "options.");
    options = {};
    options.duration = 1;
    options.step = nan_value;
    REFUSED(pdn::solve_march(o.model, options), PDN_ERR_NOT_FINITE, "options.step: ");
    options.step = 0.1;
    options.velocities.resize(2);
    REFUSED(pdn::solve_march(o.model, options), PDN_ERR_SIZE, "options.velocities: ");
    options.velocities.clear();
    options.positions = {origin};
    REFUSED(pdn::solve_march(o.model, options), PDN_ERR_NULL, "options.rotations: ");
    REFUSED(periodic.march(), PDN_ERR_NOT_AVAILABLE, "solution: ");
    const pdn::Model moved = std::move(o.model);
    REFUSED(pdn::solve_march(o.model, options), PDN_ERR_NULL, "model: ");
    CHECK(moved.node_count() == 1);
    return 0;
}
