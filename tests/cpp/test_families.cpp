// Parameters, conditions and branches of the oscillator, by closed forms.
#include "check.hpp"

#include <complex>

namespace
{

// The oscillator under the moment 0.6 cos(omega t) about a mean, which a parameter is.
struct Driven : Oscillator {
    std::int32_t moment;

    Driven() : moment(model.add_parameter("moment", 0, 1))
    {
        const auto drive = pdn::Signal().set_harmonics(0, 0, {0.6}, {0});
        const auto force = model.add_actuator(hinge, pdn::Coordinate::rotation, drive);
        model.move_signal(moment, force, 0, pdn::SignalPart::mean, 1);
    }
    pdn::Quantity angle() const
    {
        return {pdn::Kind::joint_coordinate, hinge, pdn::Coordinate::rotation};
    }
};

void moment_for_a_mean_angle()
{
    Driven o;
    pdn::Conditions conditions;
    conditions.release(o.moment);
    conditions.add_quantity(o.angle(), pdn::Feature::mean, 0, 0.1);
    const auto solution = pdn::solve_conditioned(o.model, period, conditions);
    CHECK(solution.converged());
    NEAR(solution.parameter(o.moment), 0.3, 1e-10);

    // The same with the parameter given.
    o.model.set_parameter(o.moment, 0.3);
    const auto given = pdn::solve_periodic(o.model, period).harmonics(o.angle(), 1);
    NEAR(given.mean[0], 0.1, 1e-10);

    // What the mean angle gains from the moment, and the first harmonic does not.
    pdn::Sensitivities sensitivities;
    sensitivities.add_quantity(o.angle(), pdn::Feature::mean);
    sensitivities.add_quantity(o.angle(), pdn::Feature::cosine, 1);
    sensitivities.add_parameter(o.moment);
    for (const auto method : {pdn::SensitivityMethod::direct, pdn::SensitivityMethod::adjoint}) {
        pdn::SensitivityOptions options;
        options.method = method;
        const auto found = solution.sensitivities(sensitivities, 2, 1, nullptr, options);
        NEAR(found[0], 1 / 3.0, 1e-10);
        NEAR(found[1], 0, 1e-10);
    }
    REFUSED(solution.sensitivities(sensitivities, 2, 1, &conditions), PDN_ERR_VALUE,
            "parameters: ");

    REFUSED(conditions.add_quantity(o.angle(), pdn::Feature(7), 0, 0.1), PDN_ERR_VALUE,
            "feature: ");
    REFUSED(o.model.set_parameter(9, 1), PDN_ERR_ID, "parameter: ");
}

void response_over_frequencies()
{
    const Driven o;
    const auto branch = pdn::solve_frequency_response(o.model, 1, 4);
    CHECK(branch.end() == pdn::BranchEnd::range && branch.count() > 5);
    CHECK(!branch.report().empty());
    for (std::int32_t i = 0; i < branch.count(); ++i) {
        const auto point = branch.point(i);
        NEAR(point.parameter * point.period, 2 * pi, 1e-12);
        const auto angle = branch.solution(i).harmonics(o.angle(), 1);
        const double w = point.parameter;
        const std::complex<double> stiffness(3 - 0.5 * w * w, 0.2 * w);
        NEAR(std::hypot(angle.cosines[0], angle.sines[0]), 0.6 / std::abs(stiffness), 1e-8);
    }
    branch.write_csv("test_families_cpp.csv", {{pdn::Kind::node_position, o.body}, o.angle()});
    REFUSED(branch.write_csv("x.csv", {{pdn::Kind(99), o.body}}), PDN_ERR_VALUE, "quantities[0]: ");
    branch.write_campbell("test_families_cpp.csv");
    REFUSED(branch.write_campbell("x.csv", {o.body}), PDN_ERR_SIZE, "blades: ");

    // Saved, loaded, and followed on.
    branch.save("test_families_cpp.pdb");
    const auto loaded = pdn::Branch::load("test_families_cpp.pdb");
    CHECK(loaded.count() == branch.count());
    pdn::BranchOptions options;
    options.from = 1;
    options.to = 5;
    const auto more = pdn::continue_branch(loaded, options);
    CHECK(more.end() == pdn::BranchEnd::range && more.count() > branch.count());
    NEAR(more.point(more.count() - 1).parameter, 5, 1e-12);
    REFUSED(pdn::switch_branch(branch, 0, 0.1, options), PDN_ERR_NOT_AVAILABLE,
            "point: no other branch begins");
    REFUSED(pdn::follow_locus(branch, 0, o.moment, options), PDN_ERR_NOT_AVAILABLE,
            "point: nothing happens");
    REFUSED(pdn::Branch::load("test_families_cpp.csv"), PDN_ERR_FORMAT, "path: ");
    REFUSED(branch.point(branch.count()), PDN_ERR_ID, "point: ");
}

// Told of each point: it may end the branch, and what it throws comes out.
void progress_of_branches()
{
    const Driven o;
    std::vector<double> told;
    pdn::BranchOptions options;
    options.progress = [&](const pdn_branch_point &point, std::int32_t number) {
        told.push_back(point.parameter);
        CHECK(number == static_cast<std::int32_t>(told.size()));
        return number < 3;
    };
    const auto cut_off = pdn::solve_frequency_response(o.model, 1, 4, options);
    CHECK(cut_off.end() == pdn::BranchEnd::cancelled && cut_off.count() == 3);
    CHECK(told.size() == 3 && told.back() == cut_off.point(2).parameter);
    options.progress = [](const pdn_branch_point &, std::int32_t) -> bool {
        throw std::domain_error("enough");
    };
    try {
        pdn::solve_frequency_response(o.model, 1, 4, options);
        std::exit(1);
    } catch (const std::domain_error &e) {
        CHECK(e.what() == std::string("enough"));
    }
    // That of the solves is told, too.
    int iterations = 0;
    options.progress = nullptr;
    options.periodic.progress = [&](const pdn_progress &) { return ++iterations > 0; };
    CHECK(pdn::solve_frequency_response(o.model, 1, 4, options).count() > 3 && iterations > 3);
}

// Grid points about events, which are arrays of one length.
void events()
{
    const Driven o;
    pdn::PeriodicOptions options;
    options.grid_points = 41;
    options.time_map = pdn::TimeMap::events;
    options.event_times = {1};
    options.event_widths = {0.5};
    REFUSED(pdn::solve_periodic(o.model, period, options), PDN_ERR_NULL, "options.event_shares");
    options.event_shares = {0.5, 0.5};
    REFUSED(pdn::solve_periodic(o.model, period, options), PDN_ERR_SIZE,
            "event_times: expected 2 entries, got 1");
    options.event_shares = {0.5};
    const auto solution = pdn::solve_periodic(o.model, period, options);
    CHECK(solution.converged() && solution.sharp_event_count() == 1);
    const auto [times, widths, shares] = solution.sharp_events();
    CHECK(times.size() == 1 && widths.size() == 1 && shares[0] == 0.5);
    NEAR(times[0], 1, 1e-15); // kept as phases
    NEAR(widths[0], 0.5, 1e-15);
    NEAR(solution.sample(o.angle(), {0})[0], oscillator_angle()[0], 1e-6);
}

} // namespace

int main()
{
    moment_for_a_mean_angle();
    response_over_frequencies();
    progress_of_branches();
    events();
    std::cout << "families: as they should be\n";
    return 0;
}
