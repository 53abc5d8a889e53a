// A double pendulum that swings far under a harmonic torque, against its equations in two angles.

#include "check.hpp"
#include "library.hpp"
#include "periodic_orbit.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

using namespace reference;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using library::must;
using library::values_of;

namespace {

const double period = 2.2, omega = 2 * std::acos(-1.0) / period;
const double gravity = 9.81;
// Torque on the upper rod: mean + cosine + a second harmonic.
const double torque_mean = 1.5, torque_cosine = 5.0, torque_sine_2 = 1.0;

// Upper and lower rod.
struct Rod {
    double mass, length, centre, inertia;  // centre of mass from the upper hinge; moment about it
    double damping;                        // of the upper hinge
};
const Rod upper = {1.0, 1.0, 0.45, 0.08, 0.9}, lower = {0.7, 0.8, 0.5, 0.05, 0.5};

double torque(double t) {
    return torque_mean + torque_cosine * std::cos(omega * t) +
           torque_sine_2 * std::sin(2 * omega * t);
}

// State: both rods' angles from the vertical, and their rates. Lagrange's equations.
VectorXd rate(double t, const VectorXd &x) {
    const double difference = x(0) - x(1), coupling = lower.mass * upper.length * lower.centre;
    Eigen::Matrix2d mass;
    mass << upper.inertia + upper.mass * upper.centre * upper.centre +
                lower.mass * upper.length * upper.length,
        coupling * std::cos(difference), coupling * std::cos(difference),
        lower.inertia + lower.mass * lower.centre * lower.centre;
    const double knee = lower.damping * (x(3) - x(2));
    const Vector2d force(
        torque(t) - upper.damping * x(2) + knee - coupling * std::sin(difference) * x(3) * x(3) -
            (upper.mass * upper.centre + lower.mass * upper.length) * gravity * std::sin(x(0)),
        -knee + coupling * std::sin(difference) * x(2) * x(2) -
            lower.mass * lower.centre * gravity * std::sin(x(1)));
    VectorXd out(4);
    out << x.tail(2), mass.ldlt().solve(force);
    return out;
}

struct Pendulum {
    std::unique_ptr<pdn_model, decltype(&pdn_model_free)> model{nullptr, pdn_model_free};
    int32_t body[2] = {}, hinge[2] = {};
    Vector3d axis, down, across;  // across: where the rods move to at first
};

// It hangs in an oblique plane, so that no axis is special.
Pendulum pendulum() {
    Pendulum p;
    pdn_model *model = nullptr;
    must(pdn_model_new(&model));
    p.model.reset(model);
    p.axis = Vector3d(0.3, -0.8, 0.5).normalized();
    p.down = p.axis.cross(Vector3d(0.2, 0.4, 0.7)).normalized();
    p.across = p.axis.cross(p.down);
    const Vector3d g = gravity * p.down;
    must(pdn_model_set_gravity(model, g.data()));
    Vector3d pivot(0.4, -0.2, 1.1);
    int32_t previous = PDN_GROUND;
    for (int i = 0; i < 2; ++i) {
        const Rod &rod = i == 0 ? upper : lower;
        const Vector3d centre = pivot + rod.centre * p.down;
        // Motion in a plane feels the moment of inertia about the axis alone.
        const Matrix3d along = p.down * p.down.transpose();
        const Matrix3d inertia = rod.inertia * (Matrix3d::Identity() - 0.7 * along);
        must(pdn_model_add_rigid_body(model, rod.mass, centre.data(), inertia.data(), &p.body[i]));
        must(pdn_model_add_revolute(model, previous, p.body[i], pivot.data(), p.axis.data(),
                                    &p.hinge[i]));
        must(pdn_model_add_spring_damper(model, p.hinge[i], PDN_ROTATION, 0, rod.damping, 0,
                                         nullptr));
        previous = p.body[i], pivot += rod.length * p.down;
    }
    for (int c = 0; c < 3; ++c) {
        const double cosines[] = {torque_cosine * p.axis(c), 0},
                     sines[] = {0, torque_sine_2 * p.axis(c)};
        pdn_signal moment;
        PDN_INIT(pdn_signal, &moment);
        must(pdn_signal_set_harmonics(&moment, torque_mean * p.axis(c), 0, cosines, sines, 2));
        must(pdn_model_add_load(model, p.body[0], PDN_FRAME_SPACE, PDN_MOMENT_1 + c, &moment,
                                nullptr));
    }
    return p;
}

// Angles, their rates, and position and velocity of the lower rod's centre: one column for each
// time.
using Curves = Eigen::Matrix<double, 8, Eigen::Dynamic>;
const char *const names[] = {"upper angle", "lower angle", "upper rate", "lower rate",
                             "centre across", "centre down", "velocity across", "velocity down"};

Curves expected(const std::vector<VectorXd> &orbit, int n) {
    Curves out(8, n);
    for (int k = 0; k < n; ++k) {
        const VectorXd &x = orbit[k];
        const auto towards = [](double angle) {
            return Vector2d(std::sin(angle), std::cos(angle));
        };
        const auto sideways = [](double angle) {
            return Vector2d(std::cos(angle), -std::sin(angle));
        };
        out.col(k) << x, upper.length * towards(x(0)) + lower.centre * towards(x(1)),
            upper.length * x(2) * sideways(x(0)) + lower.centre * x(3) * sideways(x(1));
    }
    return out;
}

Curves found(const Pendulum &p, const pdn_solution *solution, int n) {
    std::vector<double> times(n);
    must(pdn_solution_grid_times(solution, times.data(), n));
    VectorXd angle(n), rate(n);
    Curves out = Curves::Zero(8, n);
    for (int i = 0; i < 2; ++i) {
        values_of(solution, pdn_quantity_of(PDN_JOINT_COORDINATE, p.hinge[i], PDN_ROTATION), times,
                  angle.data());
        values_of(solution, pdn_quantity_of(PDN_JOINT_RATE, p.hinge[i], PDN_ROTATION), times,
                  rate.data());
        for (int k = i; k < 2; ++k)
            out.row(k) += angle.transpose(), out.row(2 + k) += rate.transpose();
    }
    MatrixXd position(3, n), velocity(6, n);
    values_of(solution, pdn_quantity_of(PDN_NODE_POSITION, p.body[1], PDN_ALL_COMPONENTS), times,
              position.data());
    values_of(solution, pdn_quantity_of(PDN_NODE_VELOCITY, p.body[1], PDN_ALL_COMPONENTS), times,
              velocity.data());
    position.colwise() -= Vector3d(0.4, -0.2, 1.1);
    out.row(4) = p.across.transpose() * position;
    out.row(5) = p.down.transpose() * position;
    out.row(6) = p.across.transpose() * velocity.topRows(3);
    out.row(7) = p.down.transpose() * velocity.topRows(3);
    return out;
}

}  // namespace

int main() {
    Checks check;
    const int n = 121;
    const auto orbit = periodic_orbit(rate, period, VectorXd::Zero(4), 60, n, 1);
    const Curves exact = expected(orbit, n);
    // The reference against itself: halved steps, and another start, which settles to the same.
    const Curves halved = expected(periodic_orbit(rate, period, VectorXd::Zero(4), 60, n, 2), n);
    check.at_most("reference, halved steps", (exact - halved).cwiseAbs().maxCoeff(), 1e-11);
    VectorXd other(4);
    other << 1.5, -1.0, 2.0, -3.0;
    const Curves again = expected(periodic_orbit(rate, period, other, 60, n, 1), n);
    check.at_most("reference, from another start", (exact - again).cwiseAbs().maxCoeff(), 1e-11);
    check.within("lower rod's largest angle", exact.row(1).cwiseAbs().maxCoeff(), 1.0, 3.0);

    const Pendulum p = pendulum();
    pdn_periodic_options options;
    PDN_INIT(pdn_periodic_options, &options);
    options.grid_points = n;
    pdn_solution *solution = nullptr;
    must(pdn_solve_periodic(p.model.get(), period, &options, &solution));
    const std::unique_ptr<pdn_solution, decltype(&pdn_solution_free)> owner(solution,
                                                                            pdn_solution_free);
    char report[4096];
    pdn_solution_report(solution, report, sizeof report);
    std::printf("%s", report);
    check.is_true("converged", pdn_solution_outcome(solution) == PDN_CONVERGED);
    const Curves difference = found(p, solution, n) - exact;
    for (int i = 0; i < 8; ++i)
        check.at_most(names[i],
                      difference.row(i).cwiseAbs().maxCoeff() / exact.row(i).cwiseAbs().maxCoeff(),
                      1e-9);
    return check.exit_code();
}
