// Interpolation of a rigid-body motion between its samples.
//
// The method is the dual polar decomposition of G = sum_k I_k M_k. Here it is written out in
// rotations and translations resolved in the inertial frame, with the left stretch V:
//
//     G = sum_k I_k R_k = V R,    H = sum_k I_k r~_k R_k        (primal and dual part of G)
//
// The dual stretch is symmetric; so is V. The skew part of H R^T = r~ V + (symmetric) says
//
//     A r = 2 axial(H R^T),    A = tr(V) I - V,
//
// and velocities and accelerations follow by differentiating that, and G = V R, with the product
// rule. No dual number and no material frame is needed until the results are handed over.

#pragma once

#include "fourier.hpp"

#include <Eigen/SVD>

#include <limits>
#include <vector>

namespace reference {

using Vector6 = Eigen::Matrix<double, 6, 1>;

struct Motion {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d position;
};

// Twists are resolved in the material frame and ordered [linear; angular] = [R^T dr/dt; omega];
// the acceleration is the time derivative of those six components.
struct MotionState {
    Motion motion;
    Vector6 velocity;
    Vector6 acceleration;
};

inline Eigen::Matrix3d skew(const Eigen::Vector3d &a) {
    Eigen::Matrix3d m;
    m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
    return m;
}

inline Eigen::Vector3d axial(const Eigen::Matrix3d &m) {
    return 0.5 * Eigen::Vector3d(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
}

inline Eigen::Matrix3d rotation_about(const Eigen::Vector3d &axis, double angle) {
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

// tr(S) I - S
inline Eigen::Matrix3d trace_complement(const Eigen::Matrix3d &s) {
    return s.trace() * Eigen::Matrix3d::Identity() - s;
}

// Rotation R of G = R S with S symmetric and tr(S) I - S positive definite.
// With G = U diag(s) W^T, s descending, S has the eigenvalues s1, s2 and +-s3, the sign being that
// of det G; the smallest eigenvalue of tr(S) I - S is then s2 +- s3.
inline Eigen::Matrix3d polar_rotation(const Eigen::Matrix3d &g) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(g, Eigen::ComputeFullU | Eigen::ComputeFullV);
    // A value that is not a number leaves the singular values unset.
    if (svd.info() != Eigen::Success)
        throw std::domain_error("polar decomposition of an invalid matrix");
    const Eigen::Vector3d s = svd.singularValues();
    const double sign =
        (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
    if (!(s(1) + sign * s(2) > 16.0 * std::numeric_limits<double>::epsilon() * s(0)))
        throw std::domain_error("the grid is too coarse for this motion: tr(S) I - S is singular");
    return svd.matrixU() * Eigen::Vector3d(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
}

class MotionInterpolant {
public:
    MotionInterpolant(double period, const std::vector<Motion> &samples)
        : series_(period, stack(samples)) {}

    MotionState at(double time) const {
        using Eigen::Matrix3d;
        using Eigen::Vector3d;

        Matrix3d g, g1, g2;  // G and its time derivatives
        Matrix3d h, h1, h2;  // H likewise
        unstack(series_.at(time, 0), g, h);
        unstack(series_.at(time, 1), g1, h1);
        unstack(series_.at(time, 2), g2, h2);

        const Matrix3d rotation = polar_rotation(g);
        const Matrix3d rt = rotation.transpose();

        // Angular velocity w and acceleration w1 (inertial), from the skew parts of
        // G' R^T = w~ V + (symmetric) and of its derivative, with (R^T)' = -R^T w~.
        const Matrix3d v = g * rt;
        const auto solver = trace_complement(v).partialPivLu();
        const Vector3d w = solver.solve(2.0 * axial(g1 * rt));
        const Matrix3d v1 = g1 * rt - v * skew(w);
        const Matrix3d a1 = trace_complement(v1);
        const Vector3d w1 = solver.solve(2.0 * axial(g2 * rt - g1 * rt * skew(w)) - a1 * w);
        const Matrix3d v2 = g2 * rt - g1 * rt * skew(w) - v1 * skew(w) - v * skew(w1);
        const Matrix3d a2 = trace_complement(v2);

        // Position and its derivatives, from A r = 2 axial(P), P = H R^T.
        const Matrix3d p = h * rt;
        const Matrix3d p1 = h1 * rt - p * skew(w);
        const Matrix3d p2 = h2 * rt - h1 * rt * skew(w) - p1 * skew(w) - p * skew(w1);
        const Vector3d r = solver.solve(2.0 * axial(p));
        const Vector3d r1 = solver.solve(2.0 * axial(p1) - a1 * r);
        const Vector3d r2 = solver.solve(2.0 * axial(p2) - a2 * r - 2.0 * a1 * r1);

        MotionState state;
        state.motion = {rotation, r};
        state.velocity << rt * r1, rt * w;
        state.acceleration << rt * (r2 - w.cross(r1)), rt * w1;
        return state;
    }

private:
    static Eigen::MatrixXd stack(const std::vector<Motion> &samples) {
        Eigen::MatrixXd columns(18, samples.size());
        for (size_t k = 0; k < samples.size(); ++k) {
            const Eigen::Matrix3d dual = skew(samples[k].position) * samples[k].rotation;
            columns.col(k) << samples[k].rotation.reshaped(), dual.reshaped();
        }
        return columns;
    }

    static void unstack(const Eigen::VectorXd &column, Eigen::Matrix3d &g, Eigen::Matrix3d &h) {
        g = column.head<9>().reshaped(3, 3);
        h = column.tail<9>().reshaped(3, 3);
    }

    TrigonometricInterpolant series_;
};

}  // namespace reference
