// Functions of the caller: called, kept, disposed of, and what they throw comes out of the call.
#include "check.hpp"

#include <memory>
#include <utility>

using pdn::Component;
using pdn::Coordinate;
using pdn::Frame;

// An exception of the caller, not derived from std::exception.
struct Mine {
    int number;
};

#define THROWS(statement, Type, condition)                                                         \
    do {                                                                                           \
        bool thrown_ = false;                                                                      \
        try {                                                                                      \
            statement;                                                                             \
        } catch (const Type &e) {                                                                  \
            thrown_ = (condition);                                                                 \
        }                                                                                          \
        CHECK(thrown_);                                                                            \
    } while (0)

static void throwing()
{
    {
        Oscillator o;
        o.model.add_load(o.body, Frame::space, Component::moment_3, [](double time) -> double {
            if (time > 1) {
                throw Mine{42};
            }
            return 0;
        });
        THROWS(pdn::solve_periodic(o.model, period), Mine, e.number == 42);
        CHECK(pdn::last_callback_code() == 1);
        // The model stays usable, and the exception does not come twice.
        CHECK(o.model.node_count() == 1);
        REFUSED(o.model.node_frame(3), PDN_ERR_ID, "node: ");
        THROWS(pdn::solve_periodic(o.model, period), Mine, e.number == 42);
    }
    {
        Oscillator o;
        o.model.add_coordinate_law(
            o.hinge, Coordinate::rotation,
            [](double, double, double) -> double { throw std::domain_error("no law"); });
        THROWS(pdn::solve_periodic(o.model, period), std::domain_error,
               e.what() == std::string("no law"));
        THROWS(pdn::solve_static(o.model), std::domain_error, e.what() == std::string("no law"));
    }
    {
        Oscillator o;
        o.model.add_user_force({o.body}, Frame::space, pdn::Tangents::differenced,
                               [](const pdn::ForceState &state, pdn::ForceValues &values) {
                                   values.forces(0, state.node_count) = 1;
                               });
        THROWS(pdn::solve_periodic(o.model, period), std::out_of_range,
               std::string(e.what()) == "Entries: index 1 is not below 1");
    }
    {
        pdn::Model model;
        THROWS(model.add_beam(
                   pdn::Line().set_curve(
                       [](double) -> std::pair<pdn::Vector3, pdn::Vector3> { throw Mine{1}; }),
                   steel(), 2, 2),
               Mine, e.number == 1);
        CHECK(model.node_count() == 0);
    }
    {
        Oscillator o;
        pdn::PeriodicOptions options;
        options.progress = [](const pdn_progress &) -> bool { throw Mine{7}; };
        THROWS(pdn::solve_periodic(o.model, period, options), Mine, e.number == 7);
        pdn::StaticOptions at_rest;
        at_rest.progress = [](const pdn_progress &) -> bool { throw Mine{8}; };
        THROWS(pdn::solve_static(o.model, at_rest), Mine, e.number == 8);
    }
    {
        // A callback that uses another model, and fails by it.
        Oscillator o;
        o.model.add_load(o.body, Frame::space, Component::moment_3,
                         [](double) -> double { return pdn::Model().mass().mass; });
        REFUSED(pdn::solve_periodic(o.model, period), PDN_ERR_NOT_AVAILABLE, "centre: ");
    }
    {
        // Not finite is an error of the library's own.
        Oscillator o;
        o.model.add_load(o.body, Frame::space, Component::moment_3,
                         [](double) { return nan_value; });
        REFUSED(pdn::solve_periodic(o.model, period), PDN_ERR_CALLBACK, "");
    }
}

// A law and user forces give what the linear elements give, with and without tangents.
static void laws_and_forces()
{
    const auto moment = pdn::Signal().set_harmonics(0, 0, {0.6}, {0});
    const auto expected = oscillator_angle(5, 0.3)[0];
    const auto angle = [&](Oscillator &o) {
        o.model.add_load(o.body, Frame::space, Component::moment_3, moment);
        const auto solution = pdn::solve_periodic(o.model, period);
        CHECK(solution.converged());
        return solution.sample({pdn::Kind::joint_coordinate, o.hinge, Coordinate::rotation},
                               {0})[0];
    };
    {
        Oscillator o;
        o.model.add_coordinate_law(
            o.hinge, Coordinate::rotation,
            [](double, double q, double rate) { return 2 * q + 0.1 * rate; });
        NEAR(angle(o), expected, 1e-9);
    }
    {
        Oscillator o;
        const auto law = o.model.add_coordinate_law(
            o.hinge, Coordinate::rotation,
            [](double, double q, double rate) { return pdn::Effort{2 * q + 0.1 * rate, 2, 0.1}; });
        CHECK(o.model.check_tangents(law, period).error < 1e-7);
        NEAR(angle(o), expected, 1e-12);
    }
    {
        // About axis 3 alone the turn of the body is in its rotation matrix.
        Oscillator o;
        const auto force = o.model.add_user_force(
            {o.body}, Frame::material, pdn::Tangents::given,
            [](const pdn::ForceState &state, pdn::ForceValues &values) {
                CHECK(state.node_count == 1 && state.time >= 0);
                CHECK(std::abs(state.positions(0, 0)) < 1);
                values.forces(5, 0) =
                    -2 * std::atan2(state.rotations(1, 0), state.rotations(0, 0)) -
                    0.1 * state.velocities(5, 0);
                if (values.by_motion) {
                    values.by_motion(5, 0, 5, 0) = -2;
                    values.by_velocity(5, 0, 5, 0) = -0.1;
                }
            });
        NEAR(angle(o), expected, 1e-12);
        const auto check = o.model.check_tangents(force, period);
        CHECK(check.tangent == pdn::detail::in(pdn::Tangent::motion) ||
              check.tangent == pdn::detail::in(pdn::Tangent::velocity));
    }
    // A lift along a beam by a function is the load.
    const auto bent = [](bool by_function) {
        pdn::Model model;
        const auto beam = model.add_straight_beam({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, steel(), 2, 2);
        model.add_rigid_joint(pdn::ground, beam.first, {0, 0, 0});
        if (by_function) {
            const auto force = model.add_line_force(
                beam.first_element + 1, 1, Frame::material, {}, pdn::Tangents::given,
                [&beam](const pdn::SurfaceState &state, pdn::SurfaceValues &values) {
                    CHECK(state.element == beam.first_element + 1 && state.point_count >= 3);
                    for (std::size_t k = 0; k < state.point_count; ++k) {
                        CHECK(std::abs(state.places(0, k)) < 1 && state.places(1, k) == 0);
                        values.forces(2, k) = 1000;
                    }
                });
            CHECK(model.check_tangents(force, period).error == 0);
            CHECK(model.force(force).beam_element == beam.first_element + 1);
        } else {
            model.add_distributed_load(beam.first_element + 1, 1, Frame::material,
                                       Component::force_3, 1000);
        }
        return pdn::solve_static(model).sample<3>({pdn::Kind::node_position, beam.last}, {0})[0][2];
    };
    CHECK(bent(false) > 1e-3);
    NEAR(bent(true), bent(false), 1e-12);
}

// Closures live as long as a model or solution needs them, and no longer.
static void lifetimes()
{
    const auto token = std::make_shared<int>(0);
    {
        auto model = std::make_unique<Oscillator>();
        model->model.add_load(model->body, Frame::space, Component::moment_3,
                              [token](double t) { return std::cos(omega * t) + *token; });
        model->model.add_coordinate_law(model->hinge, Coordinate::rotation,
                                        [token](double, double q, double) { return q + *token; });
        CHECK(token.use_count() == 3);
        auto solution = std::make_unique<pdn::Solution>(pdn::solve_periodic(model->model, period));
        const auto hinge = model->hinge;
        model.reset();
        CHECK(token.use_count() == 3); // the solution has a copy of the model
        CHECK(solution->sample({pdn::Kind::joint_coordinate, hinge, Coordinate::rotation}, {0.1})
                  .size() == 1);
        solution.reset();
        CHECK(token.use_count() == 1);
    }
    {
        // Refused closures are gone at once.
        Oscillator o;
        REFUSED(
            o.model.add_coordinate_law(99, Coordinate::rotation,
                                       [token](double, double, double) { return 0.0 + *token; }),
            PDN_ERR_ID, "joint: ");
        REFUSED(o.model.add_load(99, Frame::space, Component::force_1,
                                 [token](double) { return 0.0 + *token; }),
                PDN_ERR_ID, "node: ");
        CHECK(token.use_count() == 1);
    }
}

int main()
{
    throwing();
    laws_and_forces();
    lifetimes();
    return 0;
}
