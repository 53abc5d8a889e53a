// pdn_motion_interpolate against the reference interpolant and against the exact motion.

#include "check.hpp"
#include "euler_motion.hpp"
#include "library.hpp"

#include <algorithm>

using namespace reference;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

struct Differences {
    double position = 0, rotation = 0, velocity = 0, acceleration = 0;

    double largest() const { return std::max({position, rotation, velocity, acceleration}); }
};

// Largest differences at any of the times, relative to the largest magnitudes; rates in radians.
Differences compare(double period, const std::vector<Motion> &samples,
                    const std::vector<double> &times) {
    const std::vector<MotionState> found = library::interpolate(period, samples, times);
    const MotionInterpolant interpolant(period, samples);
    Differences d, scale;
    for (size_t i = 0; i < times.size(); ++i) {
        const MotionState x = interpolant.at(times[i]), &y = found[i];
        d.position = std::max(d.position, (y.motion.position - x.motion.position).norm());
        d.rotation = std::max(d.rotation, (y.motion.rotation - x.motion.rotation).norm());
        d.velocity = std::max(d.velocity, (y.velocity - x.velocity).norm());
        d.acceleration = std::max(d.acceleration, (y.acceleration - x.acceleration).norm());
        scale.position = std::max(scale.position, x.motion.position.norm());
        scale.velocity = std::max(scale.velocity, x.velocity.norm());
        scale.acceleration = std::max(scale.acceleration, x.acceleration.norm());
    }
    return {d.position / scale.position, d.rotation, d.velocity / scale.velocity,
            d.acceleration / scale.acceleration};
}

void check_agreement(Checks &check) {
    const double period = euler_motion_period;
    std::printf("  N   times           position   rotation   velocity   acceleration\n");
    for (int n : {3, 5, 7, 15, 31, 63}) {
        // Offsets from a grid point, in periods: on it, beside it, where cardinal functions written
        // as quotients cancel, and between.
        const std::vector<std::pair<std::string, std::vector<double>>> kinds = {
            {"on", {0.0}}, {"1e-12 beside", {1e-12, -1e-12}}, {"1e-7 beside", {1e-7, -1e-7}},
            {"between", {0.13 / n, 0.5 / n, 0.91 / n}}};
        for (const auto &[kind, offsets] : kinds) {
            std::vector<double> times;
            for (int k = -2 * n; k < 3 * n; ++k)  // outside of [0, T), too
                for (double offset : offsets) times.push_back(period * (double(k) / n + offset));
            const Differences d = compare(period, euler_motion_samples(n), times);
            std::printf("%3d   %-13s   %.2e   %.2e   %.2e   %.2e\n", n, kind.c_str(), d.position,
                        d.rotation, d.velocity, d.acceleration);
            // Rounding: sums of N terms, and the condition of tr(S) I - S on the coarse grids. The
            // rounding of a time itself, eps times it, is a part of that. Derivatives multiply it
            // by (N - 1) / 2 each.
            const std::string at = ", N = " + std::to_string(n) + ", times " + kind;
            check.at_most("motion and velocity" + at,
                          std::max({d.position, d.rotation, d.velocity}), 1e-13);
            check.at_most("acceleration" + at, d.acceleration, 1e-12);
        }
    }
}

// The errors e_R and e_omega of section 4.4, at k T / (60 N), k = 1 ... 60 N.
void check_errors(Checks &check) {
    const int grids[] = {3, 7, 15, 31, 63};
    const double listed_rotation[] = {1.2e-1, 3.6e-2, 2.6e-4, 2.3e-8};
    const double listed_angular_velocity[] = {5.9e-1, 3.0e-1, 4.5e-3, 8.1e-7};
    std::printf("  N   e_R        e_omega\n");
    for (int i = 0; i < 5; ++i) {
        const int n = grids[i], points = 60 * n;
        std::vector<double> times;
        for (int k = 1; k <= points; ++k) times.push_back(euler_motion_period * k / points);
        const std::vector<MotionState> found =
            library::interpolate(euler_motion_period, euler_motion_samples(n), times);
        double rotation = 0, angular_velocity = 0;
        for (int k = 0; k < points; ++k) {
            const MotionState exact = euler_motion(times[k]);
            const Matrix3d between = found[k].motion.rotation.transpose() * exact.motion.rotation;
            rotation += (between - Matrix3d::Identity()).norm() / (3.0 * points);
            const Vector3d w = exact.velocity.tail<3>();
            angular_velocity += (found[k].velocity.tail<3>() - w).norm() / w.norm() / points;
        }
        std::printf("%3d   %.3e  %.3e\n", n, rotation, angular_velocity);
        const std::string at = " at N = " + std::to_string(n);
        if (n < 63) {
            check.within("e_R" + at + " over its listed value", rotation / listed_rotation[i], 0.5,
                         2.0);
            check.within("e_omega" + at + " over its listed value",
                         angular_velocity / listed_angular_velocity[i], 0.5, 2.0);
        } else {
            // The acceptance limits: rounding, times the highest frequency for the velocity.
            check.at_most("e_R" + at, rotation, 1e-14);
            check.at_most("e_omega" + at, angular_velocity, 1e-12);
        }
    }
}

// Rotations by 0, pi, 0 about one axis: G has the factor 1 - 2 I_1 across it, which vanishes where
// I_1 = (1 + 2 cos x) / 3 = 1/2. There no rotation is nearer than the others.
void check_refusal(Checks &check) {
    const double period = 2.0, omega = 2 * pi / period;
    const std::vector<Motion> samples = {
        {Matrix3d::Identity(), Vector3d(1, 2, 3)},
        {rotation_about(Vector3d(1, -2, 2), pi), Vector3d(-1, 1, 2)},
        {Matrix3d::Identity(), Vector3d(2, 0, 1)}};
    const double singular = period / 3 + std::acos(0.25) / omega;

    std::vector<MotionState> states;
    const pdn_status status = library::try_interpolate(period, samples, {singular}, states);
    check.is_true("a motion too coarse for the grid is refused", status == PDN_ERR_GRID_TOO_COARSE);
    // A hundredth of a grid interval from there, tr(S) I - S has an eigenvalue of some 0.03, which
    // may cost two digits for each derivative.
    const Differences d =
        compare(period, samples, {singular - 0.01 * period / 3, singular + 0.01 * period / 3});
    check.at_most("beside the singular time", d.largest(), 1e-10);
}

}  // namespace

int main() {
    Checks check;
    check_agreement(check);
    check_errors(check);
    check_refusal(check);
    return check.exit_code();
}
