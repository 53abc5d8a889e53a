// pdn_motion_grid_kinematics against the reference, and its tangents against differences of it.

#include "check.hpp"
#include "euler_motion.hpp"
#include "library.hpp"
#include "linearisation_checks.hpp"

using namespace reference;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

GridKinematics from_library(double period, const std::vector<Motion> &samples) {
    const library::Columns given(samples);
    const int size = 6 * static_cast<int>(samples.size());
    GridKinematics out{VectorXd(size), VectorXd(size), MatrixXd(size, size), MatrixXd(size, size)};
    library::must(pdn_motion_grid_kinematics(
        period, given.positions.data(), given.rotations.data(), samples.size(), out.velocity.data(),
        out.acceleration.data(), out.gamma_v.data(), out.gamma_a.data()));
    return out;
}

// Where nothing is expected (N = 1 has no velocity), nothing may be found.
double relative(const VectorXd &found, const VectorXd &expected) {
    const double error = (found - expected).norm();
    return error == 0 ? 0 : error / expected.norm();
}

void compare(Checks &check, const std::string &name, const std::vector<Motion> &samples) {
    const GridKinematics found = from_library(euler_motion_period, samples);
    const GridKinematics expected = grid_kinematics(euler_motion_period, samples);
    // Rounding: sums of N terms, each relative to the largest.
    check.at_most("velocity, " + name, relative(found.velocity, expected.velocity), 1e-12);
    check.at_most("acceleration, " + name, relative(found.acceleration, expected.acceleration),
                  1e-12);
    check.at_most("Gamma_v, " + name, relative_error(found.gamma_v, expected.gamma_v), 1e-12);
    check.at_most("Gamma_a, " + name, relative_error(found.gamma_a, expected.gamma_a), 1e-12);
}

void compare_with_differences(Checks &check, const std::string &name,
                              const std::vector<Motion> &samples) {
    const GridKinematics found = from_library(euler_motion_period, samples);
    const auto [gamma_v, gamma_a] = differences_of_kinematics(euler_motion_period, samples);
    // The acceptance limit; truncation h^4 / 30 and rounding eps / h of the differences are some
    // 1e-13.
    check.at_most("Gamma_v against differences, " + name, relative_error(found.gamma_v, gamma_v),
                  1e-7);
    check.at_most("Gamma_a against differences, " + name, relative_error(found.gamma_a, gamma_a),
                  1e-7);
}

}  // namespace

int main() {
    Checks check;
    for (int n : {3, 7, 15, 31, 63})
        compare(check, "smooth motion, N = " + std::to_string(n), euler_motion_samples(n));
    for (int n : {1, 5, 11, 21})
        compare(check, "random motion, N = " + std::to_string(n), random_samples(n));
    for (int n : {3, 7, 15}) {
        compare_with_differences(check, "smooth motion, N = " + std::to_string(n),
                                 euler_motion_samples(n));
        compare_with_differences(check, "random motion, N = " + std::to_string(n),
                                 random_samples(n));
    }
    return check.exit_code();
}
