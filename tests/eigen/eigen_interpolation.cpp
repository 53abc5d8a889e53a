// Interpolation of a periodic motion: section 4.4 of Han and Bauchau (2018), with a translation.

#include "check.hpp"
#include "differences.hpp"
#include "euler_motion.hpp"

#include <algorithm>

using namespace reference;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

// The differentiation matrices, summed over harmonics, against their closed forms.
void check_fourier(Checks &check) {
    const int n = 15;
    const double period = 1.7, omega = 2 * pi / period;
    const Eigen::MatrixXd d = differentiation_matrix(n, period, 1),
                          t = differentiation_matrix(n, period, 2);
    Eigen::MatrixXd d_closed = Eigen::MatrixXd::Zero(n, n), t_closed = d_closed;
    for (int l = 0; l < n; ++l)
        for (int k = 0; k < n; ++k) {
            const double x = pi * (l - k) / n, sign = (l - k) % 2 == 0 ? 1.0 : -1.0;
            if (l == k) t_closed(l, k) = omega * omega * (1.0 - n * n) / 12;
            else {
                d_closed(l, k) = omega * sign / (2 * std::sin(x));
                t_closed(l, k) =
                    -omega * omega * sign * std::cos(x) / (2 * std::sin(x) * std::sin(x));
            }
        }
    // Rounding only: n terms, each relative to the largest entry.
    check.at_most("D against its closed form", (d - d_closed).norm() / d.norm(), 1e-14);
    check.at_most("T against its closed form", (t - t_closed).norm() / t.norm(), 1e-14);
    check.at_most("T - D D", (t - d * d).norm() / t.norm(), 1e-14);

    // A trigonometric polynomial of the highest harmonic the grid carries is reproduced exactly.
    const double w = 7 * omega;
    Eigen::MatrixXd samples(1, n);
    for (int k = 0; k < n; ++k) samples(0, k) = 0.3 + std::sin(w * grid_time(k, n, period) + 0.4);
    const TrigonometricInterpolant series(period, samples);
    double value = 0, first = 0, second = 0;
    for (double time = -1.0; time < 3.0; time += 0.037) {
        const double x = w * time + 0.4;
        value = std::max(value, std::abs(series.at(time)(0) - 0.3 - std::sin(x)));
        first = std::max(first, std::abs(series.at(time, 1)(0) / w - std::cos(x)));
        second = std::max(second, std::abs(series.at(time, 2)(0) / (w * w) + std::sin(x)));
    }
    check.at_most("highest harmonic, value", value, 1e-13);
    check.at_most("highest harmonic, first derivative", first, 1e-13);
    check.at_most("highest harmonic, second derivative", second, 1e-13);
}

// The exact velocities and accelerations of the test motion, against differences of the motion.
void check_exact_motion(Checks &check) {
    double worst_velocity = 0, worst_acceleration = 0;
    for (double time = 0.0; time < euler_motion_period; time += 0.0137) {
        const MotionState exact = euler_motion(time);
        const Matrix3d rt = exact.motion.rotation.transpose();
        const Matrix3d rate = central_difference(
            [&](double h) { return euler_motion(time + h).motion.rotation; }, 1e-4);
        const Vector3d r1 = central_difference(
            [&](double h) { return euler_motion(time + h).motion.position; }, 1e-4);
        const Vector6 acceleration =
            central_difference([&](double h) { return euler_motion(time + h).velocity; }, 1e-4);
        Vector6 velocity;
        velocity << rt * r1, axial(rt * rate);
        worst_velocity =
            std::max(worst_velocity, (velocity - exact.velocity).norm() / exact.velocity.norm());
        worst_acceleration =
            std::max(worst_acceleration,
                     (acceleration - exact.acceleration).norm() / exact.acceleration.norm());
    }
    // Truncation (Omega h)^4 = 1e-12 with a factor for the higher harmonics.
    check.at_most("exact velocity against differences", worst_velocity, 1e-8);
    check.at_most("exact acceleration against differences", worst_acceleration, 1e-8);
}

struct Errors {
    double rotation, angular_velocity, angular_acceleration;
    double position, velocity, acceleration;
};

// e_R and e_omega as defined below figure 3 of the paper, at tau_k = k T / (60 N), k = 1 ... 60 N:
//     e_R = sum |R^T R_e - I|_F / (180 N),    e_omega = sum |w - w_e| / |w_e| / (60 N).
// The others are the mean error over the mean magnitude.
Errors interpolation_errors(int n) {
    const MotionInterpolant interpolant(euler_motion_period, euler_motion_samples(n));
    Errors e{};
    double alpha = 0, r = 0, u = 0, a = 0;
    const int points = 60 * n;
    for (int k = 1; k <= points; ++k) {
        const double time = euler_motion_period * k / points;
        const MotionState x = interpolant.at(time), exact = euler_motion(time);
        const Vector6 dv = x.velocity - exact.velocity, da = x.acceleration - exact.acceleration;
        e.rotation +=
            (x.motion.rotation.transpose() * exact.motion.rotation - Matrix3d::Identity()).norm() /
            (3.0 * points);
        e.angular_velocity += dv.tail<3>().norm() / exact.velocity.tail<3>().norm() / points;
        e.angular_acceleration += da.tail<3>().norm();
        e.position += (x.motion.position - exact.motion.position).norm();
        e.velocity += dv.head<3>().norm();
        e.acceleration += da.head<3>().norm();
        alpha += exact.acceleration.tail<3>().norm();
        r += exact.motion.position.norm();
        u += exact.velocity.head<3>().norm();
        a += exact.acceleration.head<3>().norm();
    }
    e.angular_acceleration /= alpha, e.position /= r, e.velocity /= u, e.acceleration /= a;
    return e;
}

void check_convergence(Checks &check) {
    const int grids[] = {3, 7, 15, 31, 63};
    const double listed_rotation[] = {1.2e-1, 3.6e-2, 2.6e-4, 2.3e-8};
    const double listed_angular_velocity[] = {5.9e-1, 3.0e-1, 4.5e-3, 8.1e-7};
    Errors e[5];
    std::printf("  N   e_R        e_omega    angular acc. position   velocity   acceleration\n");
    for (int i = 0; i < 5; ++i) {
        e[i] = interpolation_errors(grids[i]);
        std::printf("%3d   %.3e  %.3e  %.3e    %.3e  %.3e  %.3e\n", grids[i], e[i].rotation,
                    e[i].angular_velocity, e[i].angular_acceleration, e[i].position, e[i].velocity,
                    e[i].acceleration);
    }
    for (int i = 0; i < 4; ++i) {
        const std::string at = " at N = " + std::to_string(grids[i]) + " over its listed value";
        check.within("e_R" + at, e[i].rotation / listed_rotation[i], 0.5, 2.0);
        check.within("e_omega" + at, e[i].angular_velocity / listed_angular_velocity[i], 0.5, 2.0);
    }
    check.at_most("e_R at N = 63", e[4].rotation, 1e-14);
    check.at_most("e_omega at N = 63", e[4].angular_velocity, 1e-12);

    // Rounding grows with each derivative by the highest frequency, (N - 1) / 2 times Omega.
    check.at_most("position at N = 63", e[4].position, 1e-14);
    check.at_most("velocity at N = 63", e[4].velocity, 1e-12);
    check.at_most("acceleration at N = 63", e[4].acceleration, 1e-11);
    check.at_most("angular acceleration at N = 63", e[4].angular_acceleration, 1e-11);
    // Exponential convergence: each doubling of N squares the error, but for constants. From 1e-2
    // on, a factor of 500 a doubling is a mild demand that no algebraic order below 9 meets.
    for (int i = 3; i < 5; ++i) {
        const std::string fall =
            " from N = " + std::to_string(grids[i - 1]) + " to " + std::to_string(grids[i]);
        check.at_most("position," + fall, e[i].position / e[i - 1].position, 2e-3);
        check.at_most("velocity," + fall, e[i].velocity / e[i - 1].velocity, 2e-3);
        check.at_most("acceleration," + fall, e[i].acceleration / e[i - 1].acceleration, 2e-3);
        check.at_most("angular acceleration," + fall,
                      e[i].angular_acceleration / e[i - 1].angular_acceleration, 2e-3);
    }
}

// On a grid too coarse for the motion, the interpolant is still a definite smooth motion: its own
// velocity and acceleration must be the derivatives of its own position and rotation.
void check_consistency(Checks &check) {
    const MotionInterpolant interpolant(euler_motion_period, euler_motion_samples(7));
    double worst_velocity = 0, worst_acceleration = 0;
    for (double time = 0.003; time < euler_motion_period; time += 0.0137) {
        const MotionState x = interpolant.at(time);
        const Matrix3d rt = x.motion.rotation.transpose();
        const Matrix3d rate = central_difference(
            [&](double h) { return interpolant.at(time + h).motion.rotation; }, 1e-4);
        const Vector3d r1 = central_difference(
            [&](double h) { return interpolant.at(time + h).motion.position; }, 1e-4);
        const Vector6 acceleration =
            central_difference([&](double h) { return interpolant.at(time + h).velocity; }, 1e-4);
        Vector6 velocity;
        velocity << rt * r1, axial(rt * rate);
        worst_velocity =
            std::max(worst_velocity, (velocity - x.velocity).norm() / x.velocity.norm());
        worst_acceleration = std::max(worst_acceleration, (acceleration - x.acceleration).norm() /
                                                              x.acceleration.norm());
    }
    // As for the exact motion, with poles of the interpolant nearer to the real axis.
    check.at_most("coarse interpolant, velocity against differences", worst_velocity, 1e-7);
    check.at_most("coarse interpolant, acceleration against differences", worst_acceleration, 1e-7);
}

// Interpolation commutes with a change of the inertial frame and with a change of the body's frame.
void check_frame_indifference(Checks &check) {
    const Motion left{rotation_about(Vector3d(1, 2, -1), 2.1), Vector3d(3, -1, 2)};
    const Motion right{rotation_about(Vector3d(-1, 1, 4), -1.3), Vector3d(0.4, 0.7, -0.2)};
    const auto compose = [](const Motion &a, const Motion &b) {
        return Motion{a.rotation * b.rotation, a.position + a.rotation * b.position};
    };
    const std::vector<Motion> samples = euler_motion_samples(7);
    std::vector<Motion> moved;
    for (const Motion &m : samples) moved.push_back(compose(compose(left, m), right));
    const MotionInterpolant original(euler_motion_period, samples),
        other(euler_motion_period, moved);
    double worst = 0;
    for (double time = 0.0; time < euler_motion_period; time += 0.0137) {
        const Motion expected = compose(compose(left, original.at(time).motion), right);
        const Motion found = other.at(time).motion;
        worst = std::max(worst, (expected.rotation - found.rotation).norm());
        worst = std::max(worst, (expected.position - found.position).norm());
    }
    // Rounding, times the condition number of tr(S) I - S on this coarse grid.
    check.at_most("change of frames", worst, 1e-12);
}

void check_polar_decomposition(Checks &check) {
    // det G < 0: a stretch with one negative eigenvalue, the smallest in magnitude.
    const Matrix3d rotation = rotation_about(Vector3d(1, -2, 3), 2.5),
                   axes = rotation_about(Vector3d(0, 1, 1), 0.7);
    const Matrix3d stretch = axes * Vector3d(0.9, 0.5, -0.2).asDiagonal() * axes.transpose();
    check.at_most("polar decomposition with det G < 0",
                  (polar_rotation(rotation * stretch) - rotation).norm(), 1e-14);

    // Two eigenvalues that cancel: no rotation is nearer than the others.
    bool refused = false;
    try {
        polar_rotation(rotation * Vector3d(1.0, 0.5, -0.5).asDiagonal());
    } catch (const std::domain_error &) {
        refused = true;
    }
    check.is_true("singular tr(S) I - S is refused", refused);
}

}  // namespace

int main() {
    Checks check;
    check_fourier(check);
    check_exact_motion(check);
    check_polar_decomposition(check);
    check_convergence(check);
    check_consistency(check);
    check_frame_indifference(check);
    return check.exit_code();
}
