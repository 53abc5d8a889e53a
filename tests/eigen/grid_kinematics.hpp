// Velocity and acceleration of one node at the grid points, and their exact linearisation.
//
// As seen from the body at grid point l, the body at grid point k is rotated and displaced by
//
//     Q = R_l^T R_k,    s = R_l^T (r_k - r_l),
//
// the relative motion Q + eps s~ Q. Splitting v_l = sum_k D_lk axial(S_lk) and
// dv_l/dt = axial(sum_k T_lk S_lk - 2 v~_l sum_k D_lk S_lk) into primal and dual parts gives the
// sums below. The linearisation is the product rule applied to them, one unit increment at a time;
// it uses no identity for axial vectors of products.

#pragma once

#include "motion.hpp"

namespace reference {

struct GridKinematics {
    // Point k occupies rows 6k to 6k+5, ordered [linear; angular], material frame.
    Eigen::VectorXd velocity;
    Eigen::VectorXd acceleration;
    // Derivatives with respect to the material increments (R^T dr, dpsi), in the same order.
    Eigen::MatrixXd gamma_v;
    Eigen::MatrixXd gamma_a;
};

namespace detail {

struct Relative {
    Eigen::Matrix3d q;
    Eigen::Vector3d s;
};

inline Relative relative(const Motion &from, const Motion &to) {
    const Eigen::Matrix3d rt = from.rotation.transpose();
    return {rt * to.rotation, rt * (to.position - from.position)};
}

// What one grid point contributes to the velocity of another, for D_lk = 1.
inline Vector6 unit_velocity(const Relative &m) {
    Vector6 v;
    v << axial(skew(m.s) * m.q), axial(m.q);
    return v;
}

// Change of unit_velocity for changes dq, ds of the relative motion.
inline Vector6 unit_velocity_change(const Relative &m, const Relative &d) {
    Vector6 v;
    v << axial(skew(d.s) * m.q + skew(m.s) * d.q), axial(d.q);
    return v;
}

// axial(v~ S) with S the relative motion: the convective part of the acceleration, for D_lk = 1.
inline Vector6 convective(const Vector6 &v, const Relative &m) {
    const Eigen::Matrix3d u = skew(v.head<3>()), w = skew(v.tail<3>());
    Vector6 a;
    a << axial(u * m.q + w * skew(m.s) * m.q), axial(w * m.q);
    return a;
}

inline Vector6 convective_change(const Vector6 &v, const Relative &m, const Relative &d) {
    const Eigen::Matrix3d u = skew(v.head<3>()), w = skew(v.tail<3>());
    Vector6 a;
    a << axial(u * d.q + w * skew(d.s) * m.q + w * skew(m.s) * d.q), axial(w * d.q);
    return a;
}

// Change of the relative motion when point k (the one looked at) moves by its i-th unit increment.
inline Relative change_by_target(const Relative &m, int i) {
    const Eigen::Vector3d e = Eigen::Vector3d::Unit(i % 3);
    if (i < 3) return {Eigen::Matrix3d::Zero(), m.q * e};
    return {m.q * skew(e), Eigen::Vector3d::Zero()};
}

// The same when point l (the one looked from) moves.
inline Relative change_by_observer(const Relative &m, int i) {
    const Eigen::Vector3d e = Eigen::Vector3d::Unit(i % 3);
    if (i < 3) return {Eigen::Matrix3d::Zero(), -e};
    return {-skew(e) * m.q, -e.cross(m.s)};
}

}  // namespace detail

inline GridKinematics grid_kinematics(double period, const std::vector<Motion> &samples) {
    using namespace detail;
    const int n = static_cast<int>(samples.size());
    const Eigen::MatrixXd d = differentiation_matrix(n, period, 1);
    const Eigen::MatrixXd t = differentiation_matrix(n, period, 2);

    GridKinematics out;
    out.velocity.setZero(6 * n);
    out.acceleration.setZero(6 * n);
    out.gamma_v.setZero(6 * n, 6 * n);
    out.gamma_a.setZero(6 * n, 6 * n);

    for (int l = 0; l < n; ++l) {
        auto velocity = out.velocity.segment<6>(6 * l);
        auto gamma_v = out.gamma_v.middleRows<6>(6 * l);
        for (int k = 0; k < n; ++k) {
            const Relative m = relative(samples[l], samples[k]);
            velocity += d(l, k) * unit_velocity(m);
            for (int i = 0; i < 6; ++i) {
                gamma_v.col(6 * k + i) += d(l, k) * unit_velocity_change(m, change_by_target(m, i));
                gamma_v.col(6 * l + i) +=
                    d(l, k) * unit_velocity_change(m, change_by_observer(m, i));
            }
        }

        // The acceleration needs the whole velocity of its point, hence a second pass.
        const Vector6 v = velocity;
        auto acceleration = out.acceleration.segment<6>(6 * l);
        auto gamma_a = out.gamma_a.middleRows<6>(6 * l);
        Eigen::Matrix<double, 6, 6> by_velocity = Eigen::Matrix<double, 6, 6>::Zero();
        for (int k = 0; k < n; ++k) {
            const Relative m = relative(samples[l], samples[k]);
            const auto change = [&](const Relative &dm) -> Vector6 {
                return t(l, k) * unit_velocity_change(m, dm) -
                       2.0 * d(l, k) * convective_change(v, m, dm);
            };
            acceleration += t(l, k) * unit_velocity(m) - 2.0 * d(l, k) * convective(v, m);
            for (int i = 0; i < 6; ++i) {
                gamma_a.col(6 * k + i) += change(change_by_target(m, i));
                gamma_a.col(6 * l + i) += change(change_by_observer(m, i));
                by_velocity.col(i) -= 2.0 * d(l, k) * convective(Vector6::Unit(i), m);
            }
        }
        gamma_a += by_velocity * gamma_v;
    }
    return out;
}

}  // namespace reference
