// What functions of the caller throw, at each call that there is, in each kind of solve: it comes
// out of the call, nothing else does, and the model is as good as before.
#include "check.hpp"

#include <functional>
#include <iostream>
#include <optional>
#include <vector>

using pdn::Component;
using pdn::Coordinate;
using pdn::Frame;

// Not derived from std::exception.
struct Mine {
    int call;
};

struct Theirs : std::runtime_error {
    int call;
    explicit Theirs(int number) : std::runtime_error("thrown as planned"), call(number)
    {
    }
};

// What is counted, and at which call it throws: in functions of the model, or in progress.
static struct {
    int calls = 0, at = 0;
    bool in_progress = false, of_std = false;
} plan;

static void maybe(bool in_progress)
{
    if (in_progress != plan.in_progress || ++plan.calls != plan.at) {
        return;
    }
    if (plan.of_std) {
        throw Theirs(plan.at);
    }
    throw Mine{plan.at};
}

static bool progress(const pdn_progress &)
{
    maybe(true);
    return true;
}

// An oscillator with a load, a law and a force of the caller.
static pdn::Model model_of_callbacks(std::int32_t &hinge)
{
    Oscillator o;
    o.model.add_load(o.body, Frame::space, Component::moment_3, [](double time) {
        maybe(false);
        return 0.6 * std::cos(omega * time);
    });
    o.model.add_coordinate_law(
        o.hinge, Coordinate::rotation, [](double, double angle, double rate) {
            maybe(false);
            return pdn::Effort{angle * angle * angle + 0.1 * rate, 3 * angle * angle, 0.1};
        });
    o.model.add_user_force({o.body}, Frame::space, pdn::Tangents::differenced,
                           [](const pdn::ForceState &state, pdn::ForceValues &values) {
                               maybe(false);
                               values.forces(5, 0) = -0.1 * state.velocities(5, 0);
                           });
    hinge = o.hinge;
    return std::move(o.model);
}

using Solve = std::function<pdn::Solution(const pdn::Model &)>;

static pdn::Solution periodic(const pdn::Model &model)
{
    pdn::PeriodicOptions options;
    options.grid_points = 7;
    options.progress = progress;
    options.progress_interval = 0;
    return pdn::solve_periodic(model, period, options);
}

static pdn::Solution adaptive(const pdn::Model &model)
{
    pdn::PeriodicOptions options;
    options.error_tolerance = 1e-3;
    options.progress = progress;
    options.progress_interval = 0;
    return pdn::solve_periodic(model, period, options);
}

static pdn::Solution statics(const pdn::Model &model)
{
    pdn::StaticOptions options;
    options.period = period;
    options.progress = progress;
    return pdn::solve_static(model, options);
}

static pdn::Solution march(const pdn::Model &model)
{
    pdn::MarchOptions options;
    options.period = period;
    options.duration = 0.5;
    options.step = 0.05;
    options.progress = progress;
    return pdn::solve_march(model, options);
}

static pdn::Solution shooting(const pdn::Model &model)
{
    pdn::ShootingOptions options;
    options.steps_per_period = 10;
    options.progress = progress;
    return pdn::solve_shooting(model, period, options);
}

static pdn::Solution modes(const pdn::Model &model)
{
    pdn::ModesOptions options;
    options.equilibrium.period = period;
    options.equilibrium.progress = progress;
    options.count = 1;
    return pdn::solve_modes(model, options).equilibrium();
}

// The angle at some times, of what is found where nothing throws.
static std::vector<double> look(const pdn::Model &model, std::int32_t hinge, const Solve &solve)
{
    plan = {};
    const auto solution = solve(model);
    CHECK(solution.converged());
    return solution.sample({pdn::Kind::joint_coordinate, hinge, Coordinate::rotation},
                           {0, 0.11, 0.4});
}

// The call at which something was thrown that came out, or nothing if nothing did.
static std::optional<int> thrown_by(const pdn::Model &model, const Solve &solve)
{
    try {
        (void)solve(model);
    } catch (const Mine &mine) {
        CHECK(!plan.of_std);
        return mine.call;
    } catch (const Theirs &theirs) {
        CHECK(plan.of_std && theirs.what() == std::string("thrown as planned"));
        return theirs.call;
    }
    return std::nullopt;
}

static void each_call(const char *what, const Solve &solve)
{
    std::int32_t hinge = 0;
    const pdn::Model model = model_of_callbacks(hinge);
    const auto before = look(model, hinge, solve);
    for (const bool in_progress : {false, true}) {
        plan = {};
        plan.in_progress = in_progress;
        (void)solve(model);
        const int calls = plan.calls;
        CHECK(calls > 0);
        int came_out = 0, kept_back = 0;
        // Each of the first, then one in so many.
        for (int at = 1; at <= calls; at += 1 + at / 16) {
            plan = {};
            plan.at = at;
            plan.in_progress = in_progress;
            plan.of_std = at % 2 == 0;
            const auto by = thrown_by(model, solve);
            if (by) {
                CHECK(*by == at);
                came_out++;
            } else {
                // A machine that was slow before tells less often now; laws and forces may refuse
                // motions that are made up, or tell later that they have no value to show.
                CHECK(plan.calls < at || !in_progress);
                kept_back++;
            }
        }
        std::cout << what << (in_progress ? ", progress: " : ": ") << calls << " calls, "
                  << came_out << " tried came out, " << kept_back << " did not\n";
        CHECK(came_out > kept_back);
        CHECK(look(model, hinge, solve) == before);
    }
}

int main()
{
    each_call("periodic", periodic);
    each_call("adaptive", adaptive);
    each_call("static", statics);
    each_call("march", march);
    each_call("shooting", shooting);
    each_call("modes", modes);
    return 0;
}
