// What is needed to check a linearisation of grid_kinematics, whoever computed it.

#pragma once

#include "differences.hpp"
#include "grid_kinematics.hpp"

#include <algorithm>
#include <random>
#include <utility>

namespace reference {

// The motion moved by a material increment: R exp(dpsi~), r + R dr.
inline Motion moved(const Motion &m, const Vector6 &increment) {
    const Eigen::Vector3d turn = increment.tail<3>();
    const double angle = turn.norm();
    Motion out = m;
    out.position += m.rotation * increment.head<3>();
    if (angle > 0) out.rotation = m.rotation * rotation_about(turn, angle);
    return out;
}

// Motions unrelated from one grid point to the next: the linearisation is exact algebra and owes
// nothing to smoothness.
inline std::vector<Motion> random_samples(int n) {
    std::mt19937 generator(20180404);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto vector = [&] {
        return Eigen::Vector3d(uniform(generator), uniform(generator), uniform(generator));
    };
    std::vector<Motion> samples;
    for (int k = 0; k < n; ++k) {
        const Eigen::Vector3d axis = vector();
        samples.push_back({rotation_about(axis, pi * uniform(generator)), vector()});
    }
    return samples;
}

// Largest error of the four sorts of entry (linear or angular row, linear or angular column), each
// relative to the largest entry of its sort, so that none hides behind the others.
inline double relative_error(const Eigen::MatrixXd &found, const Eigen::MatrixXd &expected) {
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

// Gamma_v and Gamma_a by differences of the velocities and accelerations of grid_kinematics.
inline std::pair<Eigen::MatrixXd, Eigen::MatrixXd>
differences_of_kinematics(double period, const std::vector<Motion> &samples) {
    const int size = 6 * static_cast<int>(samples.size());
    Eigen::MatrixXd gamma_v(size, size), gamma_a(size, size);
    for (int j = 0; j < size; ++j) {
        const auto both = [&](double h) {
            std::vector<Motion> near = samples;
            near[j / 6] = moved(samples[j / 6], h * Vector6::Unit(j % 6));
            const GridKinematics grid = grid_kinematics(period, near);
            Eigen::MatrixXd columns(size, 2);
            columns << grid.velocity, grid.acceleration;
            return columns;
        };
        // Truncation h^4 / 30 and rounding eps / h are both about 1e-13 here.
        const Eigen::MatrixXd columns = central_difference(both, 1e-3);
        gamma_v.col(j) = columns.col(0);
        gamma_a.col(j) = columns.col(1);
    }
    return {gamma_v, gamma_a};
}

}  // namespace reference
