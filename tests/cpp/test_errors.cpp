// What is refused throws periodyn::error, with status and message, and leaves the model as it was.
#include "check.hpp"

#include <utility>

using pdn::Component;
using pdn::Coordinate;
using pdn::Frame;

// Constants of another role, and exchanged ones, are refused by the compiler.
template <class First, class Second, class = void> constexpr bool adds_load = false;
template <class First, class Second>
constexpr bool adds_load<First, Second,
                         std::void_t<decltype(std::declval<pdn::Model &>().add_load(
                             0, std::declval<First>(), std::declval<Second>(), 1.0))>> = true;
static_assert(adds_load<Frame, Component> && !adds_load<Component, Frame>);
static_assert(!adds_load<Frame, std::int32_t> && !adds_load<pdn::ShellPlace, Component>);
static_assert(std::is_assignable_v<decltype(pdn::PeriodicOptions::start) &, pdn::Start>);
static_assert(!std::is_assignable_v<decltype(pdn::PeriodicOptions::start) &, pdn::Linear>);
static_assert(!std::is_constructible_v<pdn::Quantity, pdn::Coordinate, std::int32_t>);

static void sections_lines_signals()
{
    REFUSED(pdn::Section().set_diagonal({1, 1, 1, 1, 1, 0}, {1, 1, 1, 1}), PDN_ERR_VALUE,
            "stiffness[5]: ");
    REFUSED(pdn::Section().set_diagonal({1, 1, 1, 1, 1, 1}, {nan_value, 1, 1, 1}),
            PDN_ERR_NOT_FINITE, "mass[0]: ");
    pdn::Section section = steel();
    REFUSED(section.set_proportional_damping(-1), PDN_ERR_VALUE, "seconds: ");
    REFUSED(pdn::Section().set_proportional_damping(1), PDN_ERR_VALUE, "section stiffness");
    REFUSED(pdn::Stations({0, 1}, {section}).get(), PDN_ERR_SIZE, "sections: ");
    REFUSED(pdn::Stations({0, 1}, {section, section}, {1}).get(), PDN_ERR_SIZE, "twists: ");

    REFUSED(pdn::Line().set_straight(origin, {nan_value, 0, 0}, axis_2), PDN_ERR_NOT_FINITE,
            "end[0]: ");
    REFUSED(pdn::Line().set_arc(origin, {0, infinity, 0}, axis_1, axis_2), PDN_ERR_NOT_FINITE,
            "point[1]: ");

    REFUSED(pdn::Signal{nan_value}, PDN_ERR_NOT_FINITE, "value: ");
    REFUSED(pdn::Signal().set_harmonics(0, infinity, {}, {}), PDN_ERR_NOT_FINITE, "rate: ");
    REFUSED(pdn::Signal().set_harmonics(0, 0, {1, 2}, {1}), PDN_ERR_SIZE, "sines: ");
    REFUSED(pdn::Signal().set_samples({}), PDN_ERR_SIZE, "count: ");
    REFUSED(pdn::Signal().set_samples({1, nan_value}), PDN_ERR_NOT_FINITE, "samples[1]: ");
}

static void model()
{
    Oscillator o;
    pdn::Model &m = o.model;
    const auto bad = static_cast<Coordinate>(17);
    pdn::Matrix6 indefinite{};
    indefinite[0] = -1;

    REFUSED(m.node_frame(7), PDN_ERR_ID, "node: ");
    REFUSED(pdn::Model().mass(), PDN_ERR_NOT_AVAILABLE, "centre: ");
    REFUSED(pdn::Model().summary(), PDN_ERR_MODEL, "model: ");
    REFUSED(pdn::Model().describe(), PDN_ERR_MODEL, "model: ");
    REFUSED(m.add_node({0, nan_value, 0}), PDN_ERR_NOT_FINITE, "position[1]: ");
    REFUSED(m.add_node(origin, {{2, 0, 0, 0, 1, 0, 0, 0, 1}}), PDN_ERR_VALUE, "rotation: ");
    REFUSED(m.add_rigid_body(0, origin, identity), PDN_ERR_VALUE, "mass: ");
    REFUSED(m.add_mass(9, 1, origin), PDN_ERR_ID, "node: ");
    REFUSED(m.add_mass(o.body, -1, origin, identity), PDN_ERR_VALUE, "mass: ");
    REFUSED(m.add_inertia(o.body, indefinite), PDN_ERR_VALUE, "matrix: ");
    REFUSED(m.add_inertia(o.body, indefinite, pdn_frame{{nan_value, 0, 0}, {}}), PDN_ERR_NOT_FINITE,
            "frame position[0]: ");

    REFUSED(m.add_rigid_joint(pdn::ground, 3, origin), PDN_ERR_ID, "second: ");
    REFUSED(m.add_revolute(pdn::ground, o.body, origin, origin), PDN_ERR_VALUE, "axis: ");
    REFUSED(m.add_prismatic(o.body, o.body, origin, axis_1), PDN_ERR_VALUE, "first, second: ");
    REFUSED(m.add_cylindrical(5, o.body, origin, axis_1), PDN_ERR_ID, "first: ");
    REFUSED(m.add_screw(pdn::ground, o.body, origin, axis_1, 0), PDN_ERR_VALUE, "pitch: ");
    REFUSED(m.add_planar(pdn::ground, o.body, origin, origin), PDN_ERR_VALUE, "normal: ");
    REFUSED(m.add_spherical(pdn::ground, o.body, {0, 0, infinity}), PDN_ERR_NOT_FINITE,
            "point[2]: ");
    REFUSED(m.add_universal(pdn::ground, o.body, origin, axis_1, axis_1), PDN_ERR_VALUE,
            "first_arm, second_arm: ");
    REFUSED(m.add_free_joint(pdn::ground, -2, origin), PDN_ERR_ID, "second: ");
    REFUSED(m.add_strut(pdn::ground, o.body, origin, origin), PDN_ERR_VALUE, "second_point: ");
    REFUSED(m.add_joint(static_cast<pdn::JointKind>(-1), pdn::ground, o.body, at_origin, at_origin),
            PDN_ERR_VALUE, "kind: ");
    REFUSED(m.add_screw_between(pdn::ground, o.body, at_origin, at_origin, nan_value),
            PDN_ERR_NOT_FINITE, "pitch: ");
    REFUSED(m.prescribe(o.hinge, Coordinate::displacement, 0.0), PDN_ERR_NOT_AVAILABLE,
            "coordinate: ");
    REFUSED(m.prescribe(o.hinge, bad, [](double) { return 0.0; }), PDN_ERR_VALUE, "coordinate: ");
    CHECK(m.kept().empty());

    REFUSED(m.add_beam_element({o.body}, steel()), PDN_ERR_SIZE, "count: ");
    REFUSED(m.add_straight_beam(origin, origin, axis_2, steel(), 1, 1), PDN_ERR_VALUE, "end: ");
    REFUSED(m.add_straight_beam(origin, axis_1, axis_2, steel(), 0, 1), PDN_ERR_SIZE, "elements: ");
    REFUSED(m.add_straight_beam(origin, axis_1, axis_2, pdn::Section(), 1, 1), PDN_ERR_VALUE,
            "section stiffness");
    REFUSED(m.add_beam(pdn::Line().set_straight(origin, axis_1, axis_1), steel(), 1, 1),
            PDN_ERR_VALUE, "line");
    REFUSED(m.add_beam(pdn::Line().set_straight(origin, axis_1, axis_2),
                       pdn::Stations({1, 0}, {steel(), steel()}), 1, 1),
            PDN_ERR_VALUE, "fractions[0]: ");

    REFUSED(m.add_load(o.body, static_cast<Frame>(2), Component::force_1, 1.0), PDN_ERR_VALUE,
            "frame: ");
    REFUSED(m.add_load(4, Frame::space, Component::force_1, 1.0), PDN_ERR_ID, "node: ");
    REFUSED(m.add_distributed_load(0, 1, Frame::space, Component::force_1, 1.0), PDN_ERR_ID,
            "first_element: ");
    REFUSED(m.add_distributed_load(0, 1, Frame::space, Component::force_1, 1.0, {0, 1}, {1}),
            PDN_ERR_SIZE, "factors: ");
    REFUSED(m.add_load_at_places(0, 1, Frame::space, {0, 1}, {}), PDN_ERR_SIZE, "signals: ");
    REFUSED(m.set_gravity({0, 0, nan_value}), PDN_ERR_NOT_FINITE, "acceleration[2]: ");

    REFUSED(m.add_spring_damper(5, Coordinate::rotation, 1), PDN_ERR_ID, "joint: ");
    REFUSED(m.add_nonlinear_spring_damper(o.hinge, Coordinate::rotation, {nan_value}, {}),
            PDN_ERR_NOT_FINITE, "stiffness: ");
    REFUSED(m.add_actuator(o.hinge, Coordinate::displacement, 1.0), PDN_ERR_NOT_AVAILABLE,
            "coordinate: ");
    REFUSED(m.add_viscoelastic(o.hinge, Coordinate::rotation, 1, 0, {1}, {-1}), PDN_ERR_VALUE,
            "relaxation_times[0]: ");
    REFUSED(m.add_viscoelastic(o.hinge, Coordinate::rotation, 1, 0, {1, 2}, {1}), PDN_ERR_SIZE,
            "relaxation_times: ");
    REFUSED(m.add_viscous_damper(pdn::ground, o.body, indefinite), PDN_ERR_VALUE, "matrix: ");
    REFUSED(m.add_bushing(pdn::ground, 3, at_origin, at_origin, {}, {},
                          pdn::BushingAngles::rotation_vector),
            PDN_ERR_ID, "second: ");
    REFUSED(m.add_relation({0, 0}, {pdn::Coordinate::rotation}, {1, 1}), PDN_ERR_SIZE,
            "coordinates: ");
    REFUSED(m.add_viscous_damper(pdn::ground, 3, indefinite, at_origin), PDN_ERR_ID, "second: ");
    REFUSED(
        m.add_coordinate_law(8, Coordinate::rotation, [](double, double, double) { return 0.0; }),
        PDN_ERR_ID, "joint: ");
    REFUSED(m.add_user_force({}, Frame::space, pdn::Tangents::given,
                             [](const pdn::ForceState &, pdn::ForceValues &) {}),
            PDN_ERR_SIZE, "count: ");
    REFUSED(m.check_tangents(o.spring, 1), PDN_ERR_NOT_AVAILABLE, "force 0: ");
    REFUSED(m.check_tangents(6, 1), PDN_ERR_ID, "force: ");

    // Nothing was added, and it still solves.
    CHECK(m.node_count() == 1 && m.joint_count() == 1 && m.element_count() == 0 &&
          m.force_count() == 1);
    CHECK(pdn::solve_periodic(m, period).converged());
}

static void solves()
{
    Oscillator o;
    pdn::PeriodicOptions options;
    REFUSED(pdn::solve_periodic(pdn::Model(), 1), PDN_ERR_MODEL, "model: ");
    REFUSED(pdn::solve_periodic(o.model, -1), PDN_ERR_VALUE, "period: ");
    options.grid_points = 8;
    REFUSED(pdn::solve_periodic(o.model, 1, options), PDN_ERR_SIZE, "options.grid_points: ");
    options = {};
    options.tolerance = nan_value;
    REFUSED(pdn::solve_periodic(o.model, 1, options), PDN_ERR_NOT_FINITE, "options.tolerance: ");
    options = {};
    options.error_tolerance = 0;
    REFUSED(pdn::solve_periodic(o.model, 1, options), PDN_ERR_VALUE, "options.error_tolerance: ");
    options = {};
    options.linear_solver = static_cast<pdn::Linear>(6);
    REFUSED(pdn::solve_periodic(o.model, 1, options), PDN_ERR_VALUE, "options.linear_solver: ");
    options = {};
    options.threads = -1;
    REFUSED(pdn::solve_periodic(o.model, 1, options), PDN_ERR_VALUE, "options.threads: ");
    options = {};
    options.largest_grid_points = 1;
    REFUSED(pdn::solve_periodic(o.model, 1, options), PDN_ERR_SIZE,
            "options.largest_grid_points: ");
    options = {};
    options.oversampling = 0;
    REFUSED(pdn::solve_periodic(o.model, 1, options), PDN_ERR_VALUE, "options.oversampling: ");
    options = {};
    options.struct_size = 3;
    REFUSED(pdn::solve_periodic(o.model, 1, options), PDN_ERR_STRUCT_SIZE, "options");
    options = {};
    options.grid_points = 3;
    options.guess_positions.resize(3);
    options.guess_rotations.resize(2);
    REFUSED(pdn::solve_periodic(o.model, 1, options), PDN_ERR_SIZE, "options.guess_rotations: ");
    o.model.prescribe(o.hinge, Coordinate::rotation, pdn::Signal().set_harmonics(0, 1, {}, {}));
    REFUSED(pdn::solve_periodic(o.model, 1), PDN_ERR_NOT_PERIODIC, "");

    pdn::StaticOptions at_rest;
    at_rest.load_steps = 0;
    REFUSED(pdn::solve_static(o.model, at_rest), PDN_ERR_VALUE, "options.load_steps: ");
}

static void solutions()
{
    Oscillator o;
    const auto s = pdn::solve_periodic(o.model, period);
    REFUSED(s.filtered(pdn::Filter::lanczos, 0), PDN_ERR_VALUE, "order: ");
    REFUSED(s.sample<3>({pdn::Kind::node_position, 1}, {0}), PDN_ERR_ID, "quantity.object: ");
    REFUSED(s.sample<9>({pdn::Kind::node_rotation, -1}, {0}), PDN_ERR_ID, "quantity.object: ");
    REFUSED(s.sample<4>({pdn::Kind::node_quaternion, pdn::first_node}, {0, nan_value}),
            PDN_ERR_NOT_FINITE, "times[1]: ");
    REFUSED(s.sample<6>(pdn::Quantity(pdn::Kind::node_velocity, pdn::first_node)
                            .with_frame(static_cast<Frame>(5)),
                        {0}),
            PDN_ERR_VALUE, "quantity.frame: ");
    REFUSED(s.sample<6>({pdn::Kind::node_acceleration, pdn::first_node}, {infinity}),
            PDN_ERR_NOT_FINITE, "times: ");
    REFUSED(
        s.sample({pdn::Kind::joint_coordinate, pdn::first_joint, Coordinate::displacement}, {0}),
        PDN_ERR_NOT_AVAILABLE, "coordinate: ");
    REFUSED(s.sample({pdn::Kind::joint_rate, 2, Coordinate::rotation}, {0}), PDN_ERR_ID,
            "quantity.object: ");
    REFUSED(s.sample({pdn::Kind::joint_acceleration, pdn::first_joint, static_cast<Coordinate>(9)},
                     {0}),
            PDN_ERR_VALUE, "quantity.component: ");
    REFUSED(
        s.sample({pdn::Kind::joint_driving_effort, pdn::first_joint, Coordinate::rotation}, {0}),
        PDN_ERR_NOT_AVAILABLE, "coordinate: ");
    REFUSED(s.sample<6>(pdn::Quantity(pdn::Kind::joint_reaction, pdn::first_joint)
                            .with_frame(static_cast<pdn::Frame>(4)),
                        {0}),
            PDN_ERR_VALUE, "quantity.frame: ");
    REFUSED(s.sample<6>({pdn::Kind::beam_strain, 0}, {0}), PDN_ERR_ID, "quantity.object: ");
    REFUSED(s.sample<6>(
                pdn::Quantity(pdn::Kind::beam_force, pdn::first_beam_element).with_station(2), {0}),
            PDN_ERR_VALUE, "station: ");
    REFUSED(s.sample({pdn::Kind::force_effort, 4}, {0}), PDN_ERR_ID, "quantity.object: ");
    REFUSED(s.sample(pdn::Quantity(pdn::Kind::force_branch_effort, pdn::first_force).with_branch(0),
                     {0}),
            PDN_ERR_NOT_AVAILABLE, "branch: ");
    REFUSED(
        s.sample(pdn::Quantity(pdn::Kind::force_branch_elongation, pdn::first_force).with_branch(0),
                 {0}),
        PDN_ERR_NOT_AVAILABLE, "branch: ");
    REFUSED(
        s.sample<6>(pdn::Quantity(pdn::Kind::force_on_node, pdn::first_force).with_node(7), {0}),
        PDN_ERR_ID, "quantity.node: ");
    const std::size_t huge = std::numeric_limits<std::size_t>::max() / 2;
    REFUSED(s.harmonics({pdn::Kind::node_position, pdn::first_node}, huge), PDN_ERR_SIZE,
            "harmonics: ");
    REFUSED(s.harmonics({static_cast<pdn::Kind>(50), pdn::first_node}, 1), PDN_ERR_VALUE,
            "quantity.kind: ");
    REFUSED(s.harmonics({pdn::Kind::joint_rate, pdn::first_joint, Coordinate::rotation}, huge),
            PDN_ERR_SIZE, "harmonics: ");
    REFUSED(s.harmonics({pdn::Kind::joint_reaction, 3}, 1), PDN_ERR_ID, "quantity.object: ");
    REFUSED(s.harmonics({pdn::Kind::beam_force, 0}, 1), PDN_ERR_ID, "quantity.object: ");
    REFUSED(s.sample<4>({pdn::Kind::node_position, pdn::first_node}, {0}), PDN_ERR_SIZE,
            "quantity: expected 4 components, got 3");
}

static void motions()
{
    REFUSED(pdn::motion_interpolate(1, {origin, origin}, {identity, identity}, {0}), PDN_ERR_SIZE,
            "points: ");
    REFUSED(pdn::motion_interpolate(1, {origin}, {identity, identity}, {0}), PDN_ERR_SIZE,
            "positions: expected 2 entries, got 1");
    REFUSED(pdn::motion_grid_kinematics(0, {origin}, {identity}), PDN_ERR_VALUE, "period: ");
    REFUSED(pdn::motion_grid_kinematics(1, {origin}, {{2, 0, 0, 0, 1, 0, 0, 0, 1}}), PDN_ERR_VALUE,
            "rotations");
}

static void moved_from()
{
    Oscillator o;
    pdn::Model model = std::move(o.model);
    REFUSED(o.model.node_count(), PDN_ERR_NULL, "model: ");
    REFUSED(o.model.add_node(origin), PDN_ERR_NULL, "model: ");
    REFUSED(o.model.describe(), PDN_ERR_NULL, "model: ");
    REFUSED(pdn::solve_periodic(o.model, 1), PDN_ERR_NULL, "model: ");
    REFUSED(pdn::solve_static(o.model), PDN_ERR_NULL, "model: ");

    pdn::Solution solution = pdn::solve_periodic(model, period);
    const pdn::Solution other = std::move(solution);
    REFUSED(solution.outcome(), PDN_ERR_NULL, "solution: ");
    REFUSED(solution.report(), PDN_ERR_NULL, "solution: ");
    REFUSED(solution.grid_times(), PDN_ERR_NULL, "solution: ");
    REFUSED(solution.sample<3>({pdn::Kind::node_position, pdn::first_node}, {0}), PDN_ERR_NULL,
            "solution: ");
    pdn::PeriodicOptions options;
    options.initial = &solution;
    REFUSED(pdn::solve_periodic(model, period, options), PDN_ERR_NULL, "options.initial: ");
    pdn::StaticOptions at_rest;
    at_rest.initial = &solution;
    REFUSED(pdn::solve_static(model, at_rest), PDN_ERR_NULL, "options.initial: ");
    CHECK(other.converged());
}

int main()
{
    sections_lines_signals();
    model();
    solves();
    solutions();
    motions();
    moved_from();
    return 0;
}
