// Grid velocities and accelerations, and their linearisation against differences.

#include "check.hpp"
#include "differences.hpp"
#include "euler_motion.hpp"
#include "grid_kinematics.hpp"

#include <algorithm>
#include <random>

using namespace reference;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

// The motion moved by a material increment: R exp(dpsi~), r + R dr.
Motion moved(const Motion &m, const Vector6 &increment) {
    const Vector3d turn = increment.tail<3>();
    const double angle = turn.norm();
    Motion out = m;
    out.position += m.rotation * increment.head<3>();
    if (angle > 0) out.rotation = m.rotation * rotation_about(turn, angle);
    return out;
}

// Motions unrelated from one grid point to the next: the linearisation is exact algebra and owes
// nothing to smoothness.
std::vector<Motion> random_samples(int n) {
    std::mt19937 generator(20180404);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto vector = [&] { return Vector3d(uniform(generator), uniform(generator), uniform(generator)); };
    std::vector<Motion> samples;
    for (int k = 0; k < n; ++k) {
        const Vector3d axis = vector();
        samples.push_back({rotation_about(axis, pi * uniform(generator)), vector()});
    }
    return samples;
}

// Largest error of the four sorts of entry (linear or angular row, linear or angular column), each
// relative to the largest entry of its sort, so that none hides behind the others.
double relative_error(const MatrixXd &found, const MatrixXd &expected) {
    double worst = 0;
    for (int row = 0; row < 6; row += 3)
        for (int column = 0; column < 6; column += 3) {
            double error = 0, scale = 0;
            for (int i = 0; i < found.rows(); ++i)
                for (int j = 0; j < found.cols(); ++j)
                    if (i % 6 / 3 == row / 3 && j % 6 / 3 == column / 3) {
                        error = std::max(error, std::abs(found(i, j) - expected(i, j)));
                        scale = std::max(scale, std::abs(expected(i, j)));
                    }
            // The angular velocity does not depend on the position: that sort is zero.
            worst = std::max(worst, scale > 0 ? error / scale : error);
        }
    return worst;
}

void check_against_differences(Checks &check, const std::string &name, const std::vector<Motion> &samples) {
    const int n = static_cast<int>(samples.size());
    const GridKinematics exact = grid_kinematics(euler_motion_period, samples);
    MatrixXd gamma_v(6 * n, 6 * n), gamma_a(6 * n, 6 * n);
    for (int j = 0; j < 6 * n; ++j) {
        const auto both = [&](double h) {
            std::vector<Motion> near = samples;
            near[j / 6] = moved(samples[j / 6], h * Vector6::Unit(j % 6));
            const GridKinematics grid = grid_kinematics(euler_motion_period, near);
            MatrixXd columns(6 * n, 2);
            columns << grid.velocity, grid.acceleration;
            return columns;
        };
        // Truncation h^4 / 30 and rounding eps / h are both about 1e-13 here.
        const MatrixXd columns = central_difference(both, 1e-3);
        gamma_v.col(j) = columns.col(0);
        gamma_a.col(j) = columns.col(1);
    }
    check.at_most("Gamma_v, " + name, relative_error(exact.gamma_v, gamma_v), 1e-7);
    check.at_most("Gamma_a, " + name, relative_error(exact.gamma_a, gamma_a), 1e-7);
}

// The interpolant at the grid points, derived in the inertial frame, must say the same.
void check_against_interpolant(Checks &check, const std::string &name, const std::vector<Motion> &samples) {
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
    check.at_most("grid velocity, " + name, (velocity - grid.velocity).norm() / grid.velocity.norm(), 1e-12);
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
    check.at_most("Gamma_v of a rigid increment", (grid.gamma_v * increment).norm() / grid.gamma_v.norm(), 1e-13);
    check.at_most("Gamma_a of a rigid increment", (grid.gamma_a * increment).norm() / grid.gamma_a.norm(), 1e-13);
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
        rate << -f * std::sin(x), 2 * f * std::cos(2 * x), 0.0, f * std::cos(x), 0.0, -2 * f * std::sin(2 * x);
        const Vector3d u = grid.velocity.segment<3>(6 * k), w = grid.velocity.segment<3>(6 * k + 3);
        Vector6 v_du;
        v_du << w.cross(du.head<3>()) + u.cross(du.tail<3>()), w.cross(du.tail<3>());
        increment.segment<6>(6 * k) = du;
        expected.segment<6>(6 * k) = rate + v_du;
    }
    // The interpolation error of velocities at N = 63 is 1e-14; rounding adds some N eps.
    check.at_most("continuum limit of Gamma_v", (grid.gamma_v * increment - expected).norm() / expected.norm(), 1e-11);
}

}  // namespace

int main() {
    Checks check;
    for (int n : {3, 7, 15}) {
        check_against_differences(check, "smooth motion, N = " + std::to_string(n), euler_motion_samples(n));
        check_against_interpolant(check, "smooth motion, N = " + std::to_string(n), euler_motion_samples(n));
    }
    for (int n : {1, 5, 11}) {
        check_against_differences(check, "random motion, N = " + std::to_string(n), random_samples(n));
        if (n > 1) check_against_interpolant(check, "random motion, N = " + std::to_string(n), random_samples(n));
    }
    check_against_interpolant(check, "smooth motion, N = 63", euler_motion_samples(63));
    check_rigid_increment(check);
    check_continuum_limit(check);
    return check.exit_code();
}
