// An exact periodic motion to test interpolation with: the rotation of section 4.4 of Han and
// Bauchau (2018), joined here by a closed space curve whose harmonics never end.

#pragma once

#include "motion.hpp"

namespace reference {

constexpr double euler_motion_frequency = 9.0;  // rad/s
constexpr double euler_motion_period = 2.0 * pi / euler_motion_frequency;

inline MotionState euler_motion(double time) {
    const double f = euler_motion_frequency;
    const double x = f * time;

    // Precession, nutation, spin (3-1-3) with first and second time derivatives.
    const double phi = x, phi1 = f;
    const double nut = pi / 13 * std::sin(2 * x), nut1 = pi / 13 * 2 * f * std::cos(2 * x),
                 nut2 = -pi / 13 * 4 * f * f * std::sin(2 * x);
    const double psi = pi / 17 * (1 - std::cos(3 * x)), psi1 = pi / 17 * 3 * f * std::sin(3 * x),
                 psi2 = pi / 17 * 9 * f * f * std::cos(3 * x);

    const double sn = std::sin(nut), cn = std::cos(nut), sp = std::sin(psi), cp = std::cos(psi);
    const Eigen::Vector3d w(phi1 * sn * sp + nut1 * cp, phi1 * sn * cp - nut1 * sp,
                            phi1 * cn + psi1);
    const Eigen::Vector3d w1(
        phi1 * (nut1 * cn * sp + psi1 * sn * cp) + nut2 * cp - nut1 * psi1 * sp,
        phi1 * (nut1 * cn * cp - psi1 * sn * sp) - nut2 * sp - nut1 * psi1 * cp,
        -phi1 * nut1 * sn + psi2);

    // Position: exp(sin x), sin(2x + cos x), cos(3x) / 2.
    const double s = std::sin(x), c = std::cos(x), e = std::exp(s);
    const double a = 2 * x + c, a1 = f * (2 - s), a2 = -f * f * c;
    const Eigen::Vector3d r(e, std::sin(a), 0.5 * std::cos(3 * x));
    const Eigen::Vector3d r1(f * c * e, a1 * std::cos(a), -1.5 * f * std::sin(3 * x));
    const Eigen::Vector3d r2(f * f * (c * c - s) * e, a2 * std::cos(a) - a1 * a1 * std::sin(a),
                             -4.5 * f * f * std::cos(3 * x));

    const Eigen::Vector3d axis1 = Eigen::Vector3d::UnitX(), axis3 = Eigen::Vector3d::UnitZ();
    MotionState state;
    state.motion.rotation =
        rotation_about(axis3, phi) * rotation_about(axis1, nut) * rotation_about(axis3, psi);
    state.motion.position = r;
    const Eigen::Matrix3d rt = state.motion.rotation.transpose();
    state.velocity << rt * r1, w;
    state.acceleration << rt * r2 - w.cross(rt * r1), w1;
    return state;
}

inline std::vector<Motion> euler_motion_samples(int n) {
    std::vector<Motion> samples;
    for (int k = 0; k < n; ++k)
        samples.push_back(euler_motion(grid_time(k, n, euler_motion_period)).motion);
    return samples;
}

}  // namespace reference
