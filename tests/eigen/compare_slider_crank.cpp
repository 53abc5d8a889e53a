// A rigid slider-crank against its equation of motion in the crank's angle: turned by a drive, and
// swung by a torque.

#include "check.hpp"
#include "library.hpp"
#include "periodic_orbit.hpp"

#include <cmath>
#include <memory>

using namespace reference;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using library::must;
using library::values_of;

namespace {

const double pi = std::acos(-1.0), period = 1.6, omega = 2 * pi / period;

// In the plane of motion: the slide is along axis 1, `offset` beside the shaft.
const double crank_length = 0.3, rod_length = 0.8, offset = 0.1;
const double crank_mass = 2.0, crank_centre = 0.12, crank_inertia = 0.03;  // centre from the shaft
const double rod_mass = 1.2, rod_centre = 0.35, rod_inertia = 0.08;  // centre from the crank's pin
const double slider_mass = 1.5, slider_inertia = 0.01;
const double spring = 150, slide_damping = 6, shaft_damping = 1.5;
const Vector2d gravity(2.0, -9.0);
const double start = 1.1;  // angle of the crank in the reference configuration

struct Wave {
    double mean, cosine, sine;
    double at(double t) const {
        return mean + cosine * std::cos(omega * t) + sine * std::sin(omega * t);
    }
};
const Wave load = {-10, 25, 8};  // on the slider, along the slide

// Points of the mechanism by the crank's angle, with two derivatives.
struct Point {
    Vector2d place, first, second;
};

struct Configuration {
    Point crank, rod;      // their centres
    double slide[3];       // the slider's position
    double tilt[3];        // the rod's angle

    explicit Configuration(double angle) {
        const double c = std::cos(angle), s = std::sin(angle), ratio = crank_length / rod_length;
        tilt[0] = std::asin((offset - crank_length * s) / rod_length);
        const double ct = std::cos(tilt[0]), st = std::sin(tilt[0]);
        tilt[1] = -ratio * c / ct;
        tilt[2] = (ratio * s + st * tilt[1] * tilt[1]) / ct;
        const Point turned = {Vector2d(c, s), Vector2d(-s, c), Vector2d(-c, -s)};
        const auto on_rod = [&](double distance) {
            const Vector2d along(ct, st), across(-st, ct);
            return Point{crank_length * turned.place + distance * along,
                         crank_length * turned.first + distance * tilt[1] * across,
                         crank_length * turned.second +
                             distance * (tilt[2] * across - tilt[1] * tilt[1] * along)};
        };
        crank = {crank_centre * turned.place, crank_centre * turned.first,
                 crank_centre * turned.second};
        rod = on_rod(rod_centre);
        const Point end = on_rod(rod_length);
        slide[0] = end.place.x(), slide[1] = end.first.x(), slide[2] = end.second.x();
    }
};

// Torque on the crank for a motion of it: Lagrange's equation.
struct Equation {
    double inertia, rest;  // torque = inertia * acceleration + rest

    Equation(double t, double angle, double rate) {
        const Configuration q(angle);
        inertia = crank_inertia + crank_mass * q.crank.first.squaredNorm() +
                  rod_mass * q.rod.first.squaredNorm() + rod_inertia * q.tilt[1] * q.tilt[1] +
                  slider_mass * q.slide[1] * q.slide[1];
        const double half_slope = crank_mass * q.crank.first.dot(q.crank.second) +
                                  rod_mass * q.rod.first.dot(q.rod.second) +
                                  rod_inertia * q.tilt[1] * q.tilt[2] +
                                  slider_mass * q.slide[1] * q.slide[2];
        const double on_slider = load.at(t) + slider_mass * gravity.x() -
                                 spring * (q.slide[0] - Configuration(start).slide[0]) -
                                 slide_damping * q.slide[1] * rate;
        const double weights = gravity.dot(crank_mass * q.crank.first + rod_mass * q.rod.first);
        rest = half_slope * rate * rate + shaft_damping * rate - on_slider * q.slide[1] - weights;
    }
};

struct SliderCrank {
    std::unique_ptr<pdn_model, decltype(&pdn_model_free)> model{nullptr, pdn_model_free};
    int32_t shaft = 0, slide = 0, crank = 0, rod = 0, slider = 0;
    Matrix3d axes;  // of the plane of motion
    Vector3d origin{0.2, -0.5, 0.9};

    Vector3d in_space(const Vector2d &p) const { return axes.leftCols(2) * p; }
};

void add_load(pdn_model *model, int32_t node, int32_t first_component, const Vector3d &direction,
              const Wave &wave) {
    for (int c = 0; c < 3; ++c) {
        const double cosine = wave.cosine * direction(c), sine = wave.sine * direction(c);
        pdn_signal signal;
        PDN_INIT(pdn_signal, &signal);
        must(pdn_signal_set_harmonics(&signal, wave.mean * direction(c), 0, &cosine, &sine, 1));
        must(pdn_model_add_load(model, node, PDN_FRAME_SPACE, first_component + c, &signal,
                                nullptr));
    }
}

// In an oblique plane, so that no axis is special. One ball and one cross: nothing is constrained
// twice.
SliderCrank slider_crank() {
    SliderCrank m;
    pdn_model *model = nullptr;
    must(pdn_model_new(&model));
    m.model.reset(model);
    m.axes = Eigen::AngleAxisd(1.2, Vector3d(0.3, -0.8, 0.5).normalized()).toRotationMatrix();
    const Vector3d normal = m.axes.col(2), along = m.axes.col(0);
    const Configuration q(start);
    const auto point = [&](const Vector2d &p) -> Vector3d { return m.origin + m.in_space(p); };
    const auto add_body = [&](double mass, const Vector2d &centre, double inertia, int32_t *node) {
        // Motion in a plane feels the moment of inertia about its normal alone.
        const Matrix3d moments =
            inertia * (0.6 * Matrix3d::Identity() + 0.4 * normal * normal.transpose());
        must(pdn_model_add_rigid_body(model, mass, point(centre).data(), moments.data(), node));
    };
    const Vector2d pin = crank_length * Vector2d(std::cos(start), std::sin(start)),
                   wrist(q.slide[0], offset);
    add_body(crank_mass, q.crank.place, crank_inertia, &m.crank);
    add_body(rod_mass, q.rod.place, rod_inertia, &m.rod);
    add_body(slider_mass, wrist, slider_inertia, &m.slider);
    const Vector3d gravity_3d = m.in_space(gravity), arm = normal.cross(point(wrist) - point(pin));
    must(pdn_model_set_gravity(model, gravity_3d.data()));
    int32_t ball, cross;
    must(pdn_model_add_revolute(model, PDN_GROUND, m.crank, m.origin.data(), normal.data(),
                                &m.shaft));
    must(pdn_model_add_spherical(model, m.crank, m.rod, point(pin).data(), &ball));
    must(pdn_model_add_universal(model, m.rod, m.slider, point(wrist).data(), arm.data(),
                                 normal.data(), &cross));
    must(pdn_model_add_prismatic(model, PDN_GROUND, m.slider, point(wrist).data(), along.data(),
                                 &m.slide));
    must(pdn_model_add_spring_damper(model, m.slide, PDN_DISPLACEMENT, spring, slide_damping, 0,
                                     nullptr));
    must(pdn_model_add_spring_damper(model, m.shaft, PDN_ROTATION, 0, shaft_damping, 0, nullptr));
    add_load(model, m.slider, PDN_FORCE_1, along, load);
    return m;
}

// Crank's angle and its rate, slide's displacement and its rate, and the velocity of the rod's
// centre.
using Curves = Eigen::Matrix<double, 6, Eigen::Dynamic>;
const char *const names[] = {
    "crank's angle", "its rate", "slide", "its rate", "velocity of the rod, along", "and across"};

Eigen::Matrix<double, 6, 1> expected(double angle, double rate) {
    const Configuration q(angle);
    Eigen::Matrix<double, 6, 1> out;
    out << angle - start, rate, q.slide[0] - Configuration(start).slide[0], q.slide[1] * rate,
        q.rod.first * rate;
    return out;
}

Curves found(const SliderCrank &m, const pdn_solution *solution, const std::vector<double> &times) {
    const size_t n = times.size();
    Eigen::RowVectorXd row(n);
    Curves out(6, n);
    values_of(solution, pdn_quantity_of(PDN_JOINT_COORDINATE, m.shaft, PDN_ROTATION), times,
              row.data());
    out.row(0) = row;
    values_of(solution, pdn_quantity_of(PDN_JOINT_RATE, m.shaft, PDN_ROTATION), times, row.data());
    out.row(1) = row;
    values_of(solution, pdn_quantity_of(PDN_JOINT_COORDINATE, m.slide, PDN_DISPLACEMENT), times,
              row.data());
    out.row(2) = row;
    values_of(solution, pdn_quantity_of(PDN_JOINT_RATE, m.slide, PDN_DISPLACEMENT), times,
              row.data());
    out.row(3) = row;
    MatrixXd velocity(6, n);
    values_of(solution, pdn_quantity_of(PDN_NODE_VELOCITY, m.rod, PDN_ALL_COMPONENTS), times,
              velocity.data());
    out.bottomRows(2) = m.axes.leftCols(2).transpose() * velocity.topRows(3);
    return out;
}

using Solution = std::unique_ptr<pdn_solution, decltype(&pdn_solution_free)>;

Solution solve(Checks &check, const SliderCrank &m, size_t n) {
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = n;
    options.tolerance = 1e-11;
    pdn_solution *solution = nullptr;
    must(pdn_solve_periodic(m.model.get(), period, &options, &solution));
    Solution owner(solution, pdn_solution_free);
    char report[4096];
    pdn_solution_report(solution, report, sizeof report);
    std::printf("%s", report);
    check.is_true("converged", pdn_solution_outcome(solution) == PDN_CONVERGED);
    return owner;
}

void compare(Checks &check, const std::string &how, const Curves &found, const Curves &exact) {
    for (int i = 0; i < 6; ++i)
        check.at_most(how + ", " + names[i],
                      (found.row(i) - exact.row(i)).cwiseAbs().maxCoeff() /
                          exact.row(i).cwiseAbs().maxCoeff(),
                      1e-9);
}

// Once around in a period, not evenly.
void check_driven(Checks &check) {
    const size_t n = 81;
    const SliderCrank m = slider_crank();
    const double cosine = 0, sine = 0.2;
    pdn_signal turn;
    PDN_INIT(pdn_signal, &turn);
    must(pdn_signal_set_harmonics(&turn, 0, omega, &cosine, &sine, 1));
    must(pdn_model_prescribe(m.model.get(), m.shaft, PDN_ROTATION, &turn, nullptr));
    const Solution solution = solve(check, m, n);

    std::vector<double> times(n);
    must(pdn_solution_grid_times(solution.get(), times.data(), n));
    Curves exact(6, n);
    VectorXd torque(n), exact_torque(n);
    for (size_t k = 0; k < n; ++k) {
        const double phase = omega * times[k], angle = start + phase + sine * std::sin(phase);
        const double rate = omega * (1 + sine * std::cos(phase)),
                     acceleration = -omega * omega * sine * std::sin(phase);
        exact.col(k) = expected(angle, rate);
        const Equation equation(times[k], angle, rate);
        exact_torque(k) = equation.inertia * acceleration + equation.rest;
    }
    compare(check, "driven", found(m, solution.get(), times), exact);
    values_of(solution.get(), pdn_quantity_of(PDN_JOINT_DRIVING_EFFORT, m.shaft, PDN_ROTATION),
              times, torque.data());
    check.at_most(
        "driven, torque",
        (torque - exact_torque).cwiseAbs().maxCoeff() / exact_torque.cwiseAbs().maxCoeff(), 1e-9);
}

void check_swung(Checks &check) {
    const size_t n = 121;
    const Wave torque = {2, 5, -2};
    const Rate rate = [&](double t, const VectorXd &x) -> VectorXd {
        const Equation equation(t, x(0), x(1));
        return Vector2d(x(1), (torque.at(t) - equation.rest) / equation.inertia);
    };
    const auto orbit_from = [&](const Vector2d &x, int steps) {
        const auto states = periodic_orbit(rate, period, x, 40, n, steps);
        Curves out(6, n);
        for (size_t k = 0; k < n; ++k) out.col(k) = expected(states[k](0), states[k](1));
        return out;
    };
    const Curves exact = orbit_from(Vector2d(start, 0), 1);
    check.at_most("reference, halved steps",
                  (exact - orbit_from(Vector2d(start, 0), 2)).cwiseAbs().maxCoeff(), 1e-11);
    check.at_most("reference, from another start",
                  (exact - orbit_from(Vector2d(start + 0.5, 2), 1)).cwiseAbs().maxCoeff(), 1e-11);
    check.within("swing of the crank", exact.row(0).maxCoeff() - exact.row(0).minCoeff(), 0.8, 3.0);

    const SliderCrank m = slider_crank();
    add_load(m.model.get(), m.crank, PDN_MOMENT_1, m.axes.col(2), torque);
    const Solution solution = solve(check, m, n);
    std::vector<double> times(n);
    must(pdn_solution_grid_times(solution.get(), times.data(), n));
    compare(check, "swung", found(m, solution.get(), times), exact);
}

}  // namespace

int main() {
    Checks check;
    check_driven(check);
    check_swung(check);
    return check.exit_code();
}
