// Every function of periodyn.hpp at least once, against closed forms where there are results.
#include "check.hpp"

#include <utility>

using pdn::Coordinate;

static std::int32_t node(std::int32_t number)
{
    return pdn::first_node + number;
}

static std::int32_t joint(std::int32_t number)
{
    return pdn::first_joint + number;
}

static void library()
{
    CHECK(pdn::version() == std::to_string(PDN_VERSION_MAJOR) + "." +
                                std::to_string(PDN_VERSION_MINOR) + "." +
                                std::to_string(PDN_VERSION_PATCH));
    CHECK(pdn::build_info().find(pdn::version()) != std::string::npos);
    CHECK(pdn::status_name(PDN_ERR_VALUE) == "PDN_ERR_VALUE");
    CHECK(!pdn::status_message(PDN_ERR_VALUE).empty());
    pdn::set_panic_printing(true);
    pdn::release_memory();
}

// The closed form of the oscillator, by each kind of access.
static void solution()
{
    Oscillator o;
    o.model.add_load(o.body, pdn::Frame::space, pdn::Component::moment_3,
                     pdn::Signal().set_harmonics(0, 0, {0.6}, {0}));
    pdn::PeriodicOptions options;
    options.grid_points = 31;
    int told = 0;
    options.progress = [&](const pdn_progress &progress) {
        told += progress.stage == pdn::detail::in(pdn::Stage::newton);
        return true;
    };
    const pdn::Solution solution = pdn::solve_periodic(o.model, period, options);
    CHECK(solution.converged() && solution.outcome() == pdn::Outcome::converged);
    CHECK(solution.report().find("converged") != std::string::npos);
    CHECK(told > 0);

    const auto figures = solution.diagnostics();
    // A coarser grid's iterations are told, too, where one leads to the solution.
    CHECK(figures.grid_points == 31 && figures.iterations > 0 && figures.iterations <= told);
    const auto history = solution.history();
    CHECK(history.increments.size() == static_cast<std::size_t>(figures.iterations));
    CHECK(history.increments.back() < 1e-9 && history.steps.back() == 1);
    CHECK(history.residuals.size() == history.steps.size());
    CHECK(solution.decay().size() == 16);
    const auto times = solution.grid_times();
    CHECK(times.size() == 31);
    NEAR(times[1], period / 31, 1e-15);

    const auto [real, imaginary] = oscillator_angle();
    const auto angle =
        solution.sample({pdn::Kind::joint_coordinate, o.hinge, Coordinate::rotation}, times);
    const auto rate =
        solution.sample({pdn::Kind::joint_rate, o.hinge, Coordinate::rotation}, times);
    const auto acceleration =
        solution.sample({pdn::Kind::joint_acceleration, o.hinge, Coordinate::rotation}, times);
    const auto rotation = solution.sample<9>({pdn::Kind::node_rotation, o.body}, times);
    const auto quaternion = solution.sample<4>({pdn::Kind::node_quaternion, o.body}, times);
    const auto position = solution.sample<3>({pdn::Kind::node_position, o.body}, times);
    const auto velocity = solution.sample<6>({pdn::Kind::node_velocity, o.body}, times);
    const auto turning = solution.sample<6>(
        pdn::Quantity(pdn::Kind::node_acceleration, o.body).with_frame(pdn::Frame::material),
        times);
    const auto reaction = solution.sample<6>(
        pdn::Quantity(pdn::Kind::joint_reaction, o.hinge).with_frame(pdn::Frame::first), times);
    const auto effort = solution.sample({pdn::Kind::force_effort, o.spring}, times);
    const auto on_body = solution.sample<6>(
        pdn::Quantity(pdn::Kind::force_on_node, o.spring).with_node(o.body), times);
    for (std::size_t k = 0; k < times.size(); ++k) {
        const double phase = omega * times[k];
        const double expected = real * std::cos(phase) + imaginary * std::sin(phase);
        const double slope = omega * (imaginary * std::cos(phase) - real * std::sin(phase));
        NEAR(angle[k], expected, 1e-12);
        NEAR(rate[k], slope, 1e-12);
        NEAR(acceleration[k], -omega * omega * expected, 1e-11);
        NEAR(rotation[k][1], std::sin(expected), 1e-12);
        NEAR(quaternion[k][3], std::sin(expected / 2), 1e-12);
        NEAR(position[k][0], 0, 1e-12);
        NEAR(velocity[k][5], slope, 1e-12);
        NEAR(turning[k][5], acceleration[k], 1e-11);
        NEAR(reaction[k][0], 0, 1e-11);
        NEAR(effort[k], 3 * expected + 0.2 * slope, 1e-11);
        NEAR(on_body[k][5], -effort[k], 1e-11);
    }

    const auto harmonics =
        solution.harmonics({pdn::Kind::joint_coordinate, o.hinge, Coordinate::rotation}, 2);
    CHECK(harmonics.mean.size() == 1 && harmonics.cosines.size() == 2);
    NEAR(harmonics.mean[0], 0, 1e-12);
    NEAR(harmonics.rate[0], 0, 1e-12);
    NEAR(harmonics.cosines[0], real, 1e-12);
    NEAR(harmonics.sines[0], imaginary, 1e-12);
    const auto of_force = solution.harmonics({pdn::Kind::force_effort, o.spring}, 1);
    NEAR(of_force.cosines[0], 3 * real + 0.2 * omega * imaginary, 1e-11);
    CHECK(solution.harmonics(pdn::Quantity(pdn::Kind::force_on_node, o.spring).with_node(o.body), 2)
              .sines.size() == 12);
    CHECK(solution.harmonics({pdn::Kind::joint_reaction, o.hinge}, 2).sines.size() == 12);
    const auto of_node = solution.harmonics({pdn::Kind::node_velocity, o.body}, 3);
    CHECK(of_node.mean.size() == 6 && of_node.cosines.size() == 18);
    NEAR(of_node.cosines[5], omega * imaginary, 1e-12);
    CHECK(solution.harmonics({pdn::Kind::node_rotation, o.body}, 1).cosines.size() == 9);
    CHECK(solution.harmonics({pdn::Kind::node_quaternion, o.body}, 1).cosines.size() == 4);
    CHECK(solution.harmonics({pdn::Kind::node_position, o.body}, 1).cosines.size() == 3);

    // From the solution on another grid, and from its motions: one iteration each.
    options.grid_points = 33;
    options.initial = &solution;
    CHECK(pdn::solve_periodic(o.model, period, options).diagnostics().iterations == 1);
    options = {};
    options.grid_points = 31;
    options.guess_positions = position;
    options.guess_rotations = rotation;
    CHECK(pdn::solve_periodic(o.model, period, options).diagnostics().iterations == 1);

    // An outcome is no exception.
    const auto smooth = solution.filtered(pdn::Filter::exponential, 2);
    const auto angle_at = [&](const pdn::Solution &s) {
        return s.sample({pdn::Kind::joint_coordinate, o.hinge, Coordinate::rotation}, {0})[0];
    };
    NEAR(angle_at(smooth), angle_at(solution) * std::exp(-36.0 / (16 * 16)), 1e-12);

    options = {}; // adaptive
    options.error_tolerance = 1e-9;
    const auto adapted = pdn::solve_periodic(o.model, period, options).diagnostics();
    CHECK(adapted.error_estimate <= 1e-9 && adapted.grids > 0);
    CHECK(static_cast<pdn::Decay>(adapted.decay) != pdn::Decay::slow);
    options.error_tolerance = 1e-30;
    CHECK(pdn::solve_periodic(o.model, period, options).outcome() ==
          pdn::Outcome::tolerance_not_met);

    options = {};
    options.progress = [](const pdn_progress &) { return false; };
    const auto cancelled = pdn::solve_periodic(o.model, period, options);
    CHECK(cancelled.outcome() == pdn::Outcome::cancelled && !cancelled.converged());
}

// A section of a motion about axis 3 with angle 0.4 cos(omega t), and its derivatives.
static void motions()
{
    constexpr std::size_t points = 21;
    pdn::Series<3> positions(points);
    pdn::Series<9> rotations(points);
    for (std::size_t k = 0; k < points; ++k) {
        const double angle = 0.4 * std::cos(2 * pi * static_cast<double>(k) / points);
        const double c = std::cos(angle), s = std::sin(angle);
        positions[k] = {c, s, 0};
        rotations[k] = {c, s, 0, -s, c, 0, 0, 0, 1};
    }
    const auto motion = pdn::motion_interpolate(period, positions, rotations, {0.3, 7.7});
    NEAR(motion.position[0][1], std::sin(0.4 * std::cos(omega * 0.3)), 1e-12);
    NEAR(motion.rotation[1][0], std::cos(0.4 * std::cos(omega * 7.7)), 1e-12);
    NEAR(motion.velocity[0][5], -0.4 * omega * std::sin(omega * 0.3), 1e-11);
    NEAR(motion.acceleration[0][5], -0.4 * omega * omega * std::cos(omega * 0.3), 1e-10);

    const auto grid = pdn::motion_grid_kinematics(period, positions, rotations);
    NEAR(grid.acceleration[0][5], -0.4 * omega * omega, 1e-10);
    NEAR(grid.velocity[5][5], -0.4 * omega * std::sin(2 * pi * 5 / points), 1e-10);
    CHECK(grid.velocity_tangent.size() == 36 * points * points);
    CHECK(grid.acceleration_tangent.size() == 36 * points * points);
}

// A cantilever of varying section: elongation by a force at its end; and access to beams.
static void beams()
{
    pdn::Section thin = steel(), thick = steel();
    for (double &entry : thick.stiffness) {
        entry *= 2;
    }
    thin.set_proportional_damping(1e-4);
    CHECK(thin.damping[0] == 1e-4 * thin.stiffness[0]);

    pdn::Model model;
    const auto beam =
        model.add_beam(pdn::Line().set_straight(origin, {2, 0, 0}, axis_2),
                       pdn::Stations({0, 0.5, 0.5, 1}, {thick, thick, thin, thin}), 4, 2);
    const auto root = model.add_node({0, 0, 0}, identity);
    model.add_rigid_joint(pdn::ground, root, origin);
    model.add_rigid_joint(root, beam.first, origin);
    model.add_load(beam.last, pdn::Frame::material, pdn::Component::force_1, 530.0);
    const auto solution = pdn::solve_static(model);
    CHECK(solution.converged());
    // 530 / (2 EA) + 530 / EA, each over 1
    NEAR(solution.sample<3>({pdn::Kind::node_position, beam.last}, {0})[0][0] - 2, 1.5e-5, 1e-12);
    NEAR(solution.sample<6>({pdn::Kind::beam_strain, beam.first_element}, {0})[0][0], 5e-6, 1e-12);
    NEAR(solution.sample<6>(
             pdn::Quantity(pdn::Kind::beam_force, beam.first_element + 3).with_station(0.3),
             {0.1, 0.2})[1][0],
         530, 1e-5);
    NEAR(solution
             .harmonics(pdn::Quantity(pdn::Kind::beam_force, beam.first_element).with_station(1), 0)
             .mean[0],
         530, 1e-5);
    CHECK(model.element_count() == 4 && model.node_count() == 10 && model.joint_count() == 2);

    pdn::StaticOptions options;
    options.initial = &solution;
    options.load_steps = 3;
    int told = 0;
    options.progress = [&](const pdn_progress &) { return ++told > 0; };
    CHECK(pdn::solve_static(model, options).converged() && told > 0);

    // A quarter circle, with a twist; a curve that is the same line; an element over own nodes.
    const double half = std::sqrt(0.5);
    pdn::Model curved;
    const auto arc = curved.add_beam(pdn::Line().set_arc(axis_1, {half, half, 0}, axis_2, axis_3),
                                     pdn::Stations({0, 1}, {thin, thin}, {0, 0.1}), 3, 3);
    const auto curve = curved.add_beam(pdn::Line().set_curve([](double fraction) {
        const double angle = fraction * pi / 2;
        return std::pair(pdn::Vector3{std::cos(angle), std::sin(angle), 5}, axis_3);
    }),
                                       thin, 3, 3);
    const auto middle = curved.node_frame((arc.first + arc.last) / 2);
    const auto same = curved.node_frame((curve.first + curve.last) / 2);
    NEAR(middle.position[0], same.position[0], 1e-12);
    NEAR(middle.rotation[0], same.rotation[0], 1e-10);
    const auto one = curved.add_node({0, 0, 9}), other = curved.add_node({1, 0, 9});
    CHECK(curved.add_beam_element({one, other}, thin) == pdn::first_beam_element + 6);
    NEAR(curved.mass().mass, 2 * (pi / 2) * 2 + 2, 1e-4); // the error of the mesh

    const auto growing =
        curved.add_distributed_load(arc.first_element, arc.elements, pdn::Frame::space,
                                    pdn::Component::force_3, 2.0, {0, 1}, {1, 2});
    CHECK(growing == pdn::first_beam_load);
    curved.add_distributed_load(curve.first_element, 1, pdn::Frame::material,
                                pdn::Component::moment_1, [](double) { return 0.0; });
    const auto at_start = curved.add_load_at_places(
        curve.first_element, curve.elements, pdn::Frame::untwisted, {0, 1},
        {{0.0, 1.0, [](double) { return 2.0; }, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}},
        axis_3);
    CHECK(at_start == pdn::first_beam_load + 2 && curved.beam_load_count() == 4);
    const auto grown = curved.beam_load(growing);
    CHECK(grown.first_element == arc.first_element && grown.elements == arc.elements);
    CHECK(grown.frame == pdn::Frame::space && grown.places == 2);
    const auto [fraction, factor] = curved.beam_load_factor(growing, 1);
    CHECK(fraction == 1 && factor == 2);
    CHECK(curved.beam_load(at_start).axis_2 == axis_3);
    CHECK(curved.sample_signal(at_start, PDN_FORCE_3, 1, {0.3})[0] == 2);
    const auto held =
        curved.add_load_on_beam(arc.first_element, arc.elements, 0.4, pdn::Frame::material,
                                pdn::Component::force_2, 3.0, pdn::Vector3{0, 0, 0.5});
    const auto point = curved.load_at(held);
    CHECK(point.node == -1 && point.first_element == arc.first_element);
    CHECK(point.elements == arc.elements && point.fraction == 0.4 && point.offset[2] == 0.5);
    curved.set_load_frame(held, pdn::Frame::space);
    CHECK(curved.load_at(held).frame == pdn::Frame::space);
    const auto off = curved.add_load_at_point(one, {0.1, 0, 0}, pdn::Frame::space,
                                              pdn::Component::moment_1, 3.0);
    CHECK(off == held + 1 && curved.load_at(off).node == one);
    thin.set_component_damping({1e-4, 1e-4, 1e-4, 2e-4, 2e-4, 2e-4});
    CHECK(thin.damping[21] == 2e-4 * thin.stiffness[21]);
}

// All joints and forces can be made, and are counted.
static void everything()
{
    pdn::Model m;
    const pdn::Matrix6 unit = [] {
        pdn::Matrix6 matrix{};
        for (std::size_t i = 0; i < 6; ++i) {
            matrix[7 * i] = 1;
        }
        return matrix;
    }();
    const auto a = m.add_rigid_body(1, origin, identity);
    const auto b = m.add_rigid_body(2, {3, 0, 0}, identity);
    CHECK(m.add_mass(a, 1, axis_1) == pdn::first_inertia + 2);
    CHECK(m.add_mass(a, 1, axis_1, identity) == pdn::first_inertia + 3);
    CHECK(m.add_inertia(b, unit) == pdn::first_inertia + 4);
    CHECK(m.add_inertia(b, unit, at_origin) == pdn::first_inertia + 5);
    std::int32_t joints = 0;
    for (const auto joint : {
             m.add_prismatic(pdn::ground, a, origin, axis_3),
             m.add_cylindrical(a, b, origin, axis_3),
             m.add_screw(a, b, origin, axis_3, 0.1),
             m.add_planar(a, b, origin, axis_3),
             m.add_spherical(a, b, origin),
             m.add_universal(a, b, origin, axis_1, axis_2),
             m.add_free_joint(a, b, origin),
             m.add_strut(a, b, origin, axis_1),
             m.add_revolute(a, b, origin, axis_2),
             m.add_joint(pdn::JointKind::spherical, a, b, at_origin, at_origin),
             m.add_screw_between(a, b, at_origin, at_origin, -0.2),
         }) {
        CHECK(joint == pdn::first_joint + joints++);
    }
    CHECK(m.joint_count() == joints);
    CHECK(m.prescribe(pdn::first_joint, Coordinate::displacement, 0.1) == pdn::first_prescribed);
    CHECK(m.prescribe(joint(8), Coordinate::rotation, pdn::Signal().set_samples({0, 0.1, 0})) ==
          pdn::first_prescribed + 1);
    m.set_gravity({0, 0, -9.81});
    m.set_gravity_signals(0.0, 0.0, [](double) { return -9.81; });
    m.set_turning_frame({0, 0, 2}, 1.5, axis_1);
    const pdn::ModelTurningFrame frame = m.turning_frame();
    CHECK(frame.rate == 1.5 && frame.axis[2] == 1 && frame.point[0] == 1);
    m.set_frame_advance(0.5);
    CHECK(m.frame_advance() == 0.5);
    pdn::Model rotor;
    for (const double x : {0.0, 1.0, 2.0, 3.0})
        rotor.add_node({x, 0, 0});
    rotor.set_rotor_symmetry({0, 0, 2}, 3, {node(0), node(1), node(2)}, {node(3)}, axis_1);
    const pdn::ModelRotorSymmetry said = rotor.rotor_symmetry();
    CHECK(said.axis[2] == 1 && said.point[0] == 1 && said.blades == 3);
    CHECK(said.nodes_of_blade == 1 && said.hub_nodes == 1);
    CHECK(rotor.rotor_node(2, 0) == node(2) && rotor.rotor_node(-1, 0) == node(3));
    pdn::Conditions phases;
    phases.add_rotation_phase(frame.axis);
    phases.add_translation_phase({1, 0, 0});
    phases.add_momentum({1, 0, 0}, 2);
    phases.add_angular_momentum(frame.axis, 2, axis_1);
    std::int32_t forces = 0;
    for (const auto force : {
             m.add_spring_damper(joint(6), Coordinate::displacement_2, 1),
             m.add_nonlinear_spring_damper(joint(6), Coordinate::displacement_3, {1, 0, 2}, {0.1}),
             m.add_actuator(joint(6), Coordinate::rotation_2, 0.5),
             m.add_viscoelastic(joint(6), Coordinate::rotation_3, 1, 0, {2, 3}, {0.1, 0.2}),
             m.add_viscous_damper(a, b, unit),
             m.add_viscous_damper(pdn::ground, b, unit, at_origin),
             m.add_bushing(pdn::ground, b, at_origin, at_origin, unit, unit,
                           pdn::BushingAngles::rotation_vector),
             m.add_bushing(a, b, at_origin, at_origin, {}, unit, pdn::BushingAngles::tilt_and_spin),
             m.add_coordinate_law(joint(6), Coordinate::rotation,
                                  [](double, double q, double rate) { return q + rate; }),
             m.add_user_force({a, b}, pdn::Frame::space, pdn::Tangents::differenced,
                              [](const pdn::ForceState &, pdn::ForceValues &) {}),
             m.add_controller({joint(6), joint(8)}, {Coordinate::rotation_2, Coordinate::rotation},
                              {joint(6)}, {Coordinate::rotation_2}, {0.5}, {2},
                              pdn::Tangents::given,
                              [](const pdn::ControllerState &at, pdn::ControllerValues &out) {
                                  out.efforts(0) = -at.states(0) * at.inputs(1);
                                  out.state_rates(0) = at.input_rates(0) - at.states(0);
                                  if (out.by_inputs) {
                                      out.by_inputs(0, 1) = -at.states(0);
                                      out.by_states(0, 0) = -at.inputs(1);
                                      out.by_input_rates(1, 0) = 1;
                                      out.by_states(1, 0) = -1;
                                  }
                              }),
         }) {
        CHECK(force == pdn::first_force + forces++);
    }
    const std::int32_t controller = pdn::first_force + forces - 1;
    const auto [inputs, outputs, states] = m.controller_counts(controller);
    CHECK(inputs == 2 && outputs == 1 && states == 1);
    CHECK(m.controller_coordinate(controller, 1).coordinate == Coordinate::rotation);
    CHECK(m.controller_coordinate(controller, 2).joint == joint(6));
    CHECK(m.controller_state(controller, 0).initial == 0.5);
    CHECK(m.controller_state(controller, 0).size == 2);
    CHECK(m.check_tangents(controller, 2).error < 1e-7);
    m.bind_controller(controller, pdn::Tangents::differenced,
                      [](const pdn::ControllerState &, pdn::ControllerValues &) {});
    CHECK(m.add_relation({joint(6), joint(8)}, {Coordinate::rotation_2, Coordinate::rotation},
                         {1, -2}) == pdn::first_relation);
    CHECK(m.add_relation({joint(6), joint(8)}, {Coordinate::rotation_3, Coordinate::rotation},
                         {1, 3}, 0.5) == pdn::first_relation + 1);
    CHECK(m.relation_count() == 2);
    m.set_label(joint(8), "shaft");
    CHECK(m.label(joint(8)) == "shaft");
    CHECK(m.label(joint(7)).empty());
    CHECK(m.find_label(pdn::ObjectKind::joint, "shaft") == joint(8));
    CHECK(m.joint(joint(0)).kind == PDN_JOINT_PRISMATIC && m.joint(joint(0)).first == pdn::ground);
    CHECK(m.force(pdn::first_force + 1).stiffness_count == 3);
    CHECK(m.force_number(pdn::first_force + 1, pdn::Number::stiffness, 2) == 2);
    CHECK(m.relation_term(pdn::first_relation, 1).coefficient == -2);
    CHECK(m.relation_term(pdn::first_relation, 1).coordinate == Coordinate::rotation);
    CHECK(m.prescribed(pdn::first_prescribed + 1).joint == joint(8));
    CHECK(m.inertia_count() == 6 && m.inertia(pdn::first_inertia + 4).node == b);
    CHECK(m.inertia_of(b) == pdn::first_inertia + 1);
    m.set_spin(m.inertia_of(b), {0, 3, 0}, 2.5);
    const pdn::ModelSpin spin = m.spin(m.inertia_of(b));
    CHECK(spin.rate == 2.5 && spin.axis[1] == 1);
    CHECK(m.load_count() == 0 && m.shell_load_count() == 0);
    const auto speed = m.add_parameter("speed", 3, 2);
    CHECK(m.parameter_count() == 1 && m.parameter_name(speed) == "speed");
    CHECK(m.find_parameter("speed") == speed && m.parameter(speed).value == 3);
    CHECK(m.sample_signal(pdn::gravity, 2, 1, {0, 0.3})[1] == -9.81);
    CHECK(m.force_count() == forces);
    NEAR(m.mass().mass, 7, 1e-15);
    const auto summary = m.summary();
    CHECK(summary.nodes == 2 && summary.joints == joints && summary.prescribed == 2);
    CHECK(m.describe().find("mass") != std::string::npos);
}

// The internal states of a Maxwell branch: those of its closed form.
static void viscoelastic()
{
    Oscillator o;
    const auto branch = o.model.add_viscoelastic(o.hinge, Coordinate::rotation, 0, 0, {2}, {0.4});
    o.model.add_load(o.body, pdn::Frame::space, pdn::Component::moment_3,
                     pdn::Signal().set_harmonics(0, 0, {0.6}, {0}));
    pdn::PeriodicOptions options;
    options.grid_points = 31;
    const auto solution = pdn::solve_periodic(o.model, period, options);
    // 2 i w t / (1 + i w t) adds to stiffness and damping.
    const double wt = omega * 0.4, storage = 2 * wt * wt / (1 + wt * wt),
                 loss = 2 * wt / (1 + wt * wt);
    const auto [real, imaginary] = oscillator_angle(3 + storage, 0.2 + loss / omega);
    NEAR(solution.sample({pdn::Kind::joint_coordinate, o.hinge, Coordinate::rotation}, {0})[0],
         real, 1e-12);
    const double effort = storage * real + loss * imaginary;
    NEAR(solution.sample(pdn::Quantity(pdn::Kind::force_branch_effort, branch).with_branch(0),
                         {0})[0],
         effort, 1e-12);
    NEAR(solution.sample(pdn::Quantity(pdn::Kind::force_branch_elongation, branch).with_branch(0),
                         {0})[0],
         real - effort / 2, 1e-12);
}

// The driving effort of a prescribed coordinate; handles move, and outlive what they were made of.
static void handles()
{
    Oscillator o;
    o.model.prescribe(o.hinge, Coordinate::rotation,
                      [](double t) { return 0.1 * std::cos(omega * t); });
    pdn::Model moved = std::move(o.model);
    CHECK(o.model.get() == nullptr && moved.node_count() == 1);
    pdn::PeriodicOptions options;
    options.grid_points = 31;
    pdn::Solution solution = pdn::solve_periodic(moved, period, options);
    moved = pdn::Model();
    pdn::Solution other = std::move(solution);
    CHECK(solution.get() == nullptr && other.converged());
    NEAR(other.sample({pdn::Kind::joint_driving_effort, o.hinge, Coordinate::rotation}, {0})[0],
         0.1 * (3 - 0.5 * omega * omega), 1e-11);
}

int main()
{
    library();
    solution();
    motions();
    beams();
    everything();
    viscoelastic();
    handles();
    return 0;
}
