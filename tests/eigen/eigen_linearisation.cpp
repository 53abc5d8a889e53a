// Grid velocities and accelerations, and their linearisation against differences.

#include "check.hpp"
#include "euler_motion.hpp"
#include "linearisation_checks.hpp"

#include <algorithm>

using namespace reference;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

void check_against_differences(Checks &check, const std::string &name,
                               const std::vector<Motion> &samples) {
    const GridKinematics exact = grid_kinematics(euler_motion_period, samples);
    const auto [gamma_v, gamma_a] = differences_of_kinematics(euler_motion_period, samples);
    check.at_most("Gamma_v, " + name, relative_error(exact.gamma_v, gamma_v), 1e-7);
    check.at_most("Gamma_a, " + name, relative_error(exact.gamma_a, gamma_a), 1e-7);
}

// The interpolant at the grid points, derived in the inertial frame, must say the same.
void check_against_interpolant(Checks &check, const std::string &name,
                               const std::vector<Motion> &samples) {
    const int n = static_cast<int>(samples.size());
    const GridKinematics grid = grid_kinematics(euler_motion_period, samples);
    const MotionInterpolant interpolant(euler_motion_period, samples);
    VectorXd velocity(6 * n), acceleration(6 * n);
    double position = 0;
    for (int k = 0; k < n; ++k) {
        const MotionState state = interpolant.at(grid_time(k, n, euler_motion_period));
        velocity.segment<6>(6 * k) = state.velocity;
        acceleration.segment<6>(6 * k) = state.acceleration;
        position = std::max(position, (state.motion.position - samples[k].position).norm());
    }
    // Rounding, some N times eps.
    check.at_most("sample positions returned, " + name, position, 1e-13);
    check.at_most("grid velocity, " + name,
                  (velocity - grid.velocity).norm() / grid.velocity.norm(), 1e-12);
    check.at_most("grid acceleration, " + name,
                  (acceleration - grid.acceleration).norm() / grid.acceleration.norm(), 1e-12);
}

// Moving all samples by one and the same small motion of the inertial frame changes no velocity.
void check_rigid_increment(Checks &check) {
    const std::vector<Motion> samples = random_samples(9);
    const GridKinematics grid = grid_kinematics(euler_motion_period, samples);
    const Vector3d shift(0.3, -0.7, 0.2), turn(-0.5, 0.1, 0.9);
    VectorXd increment(6 * 9);
    for (int k = 0; k < 9; ++k) {
        const Eigen::Matrix3d rt = samples[k].rotation.transpose();
        increment.segment<6>(6 * k) << rt * (shift + turn.cross(samples[k].position)), rt * turn;
    }
    check.at_most("Gamma_v of a rigid increment",
                  (grid.gamma_v * increment).norm() / grid.gamma_v.norm(), 1e-13);
    check.at_most("Gamma_a of a rigid increment",
                  (grid.gamma_a * increment).norm() / grid.gamma_a.norm(), 1e-13);
}

// For smooth increments of a resolved motion, Gamma_v du tends to du/dt + v~ du.
void check_continuum_limit(Checks &check) {
    const int n = 63;
    const GridKinematics grid = grid_kinematics(euler_motion_period, euler_motion_samples(n));
    VectorXd increment(6 * n), expected(6 * n);
    for (int k = 0; k < n; ++k) {
        const double x = 2 * pi * k / n, f = euler_motion_frequency;
        Vector6 du, rate;
        du << std::cos(x), std::sin(2 * x), 1.0, std::sin(x), 0.5, std::cos(2 * x);
        rate << -f * std::sin(x), 2 * f * std::cos(2 * x), 0.0, f * std::cos(x), 0.0,
            -2 * f * std::sin(2 * x);
        const Vector3d u = grid.velocity.segment<3>(6 * k), w = grid.velocity.segment<3>(6 * k + 3);
        Vector6 v_du;
        v_du << w.cross(du.head<3>()) + u.cross(du.tail<3>()), w.cross(du.tail<3>());
        increment.segment<6>(6 * k) = du;
        expected.segment<6>(6 * k) = rate + v_du;
    }
    // The interpolation error of velocities at N = 63 is 1e-14; rounding adds some N eps.
    check.at_most("continuum limit of Gamma_v",
                  (grid.gamma_v * increment - expected).norm() / expected.norm(), 1e-11);
}

}  // namespace

int main() {
    Checks check;
    for (int n : {3, 7, 15}) {
        check_against_differences(check, "smooth motion, N = " + std::to_string(n),
                                  euler_motion_samples(n));
        check_against_interpolant(check, "smooth motion, N = " + std::to_string(n),
                                  euler_motion_samples(n));
    }
    for (int n : {1, 5, 11}) {
        check_against_differences(check, "random motion, N = " + std::to_string(n),
                                  random_samples(n));
        if (n > 1)
            check_against_interpolant(check, "random motion, N = " + std::to_string(n),
                                      random_samples(n));
    }
    check_against_interpolant(check, "smooth motion, N = 63", euler_motion_samples(63));
    check_rigid_increment(check);
    check_continuum_limit(check);
    return check.exit_code();
}
