// Rigid spatial four-bar mechanism of section 7.2 of Han and Bauchau (2018).
//
//   ground - revolute A (i2, torsional spring) - bar 1 = AB - spherical B - bar 2 = BC
//          - universal C - bar 3 = CD - revolute D (i1, prescribed rotation) - ground
//
// One loop equation remains: with bar 3 at the angle theta and bar 1 at phi, the distance BC is the
// length of bar 2. The universal joint then only settles the spin of bar 2 about its own axis: the
// cross arm fixed to bar 2 stays along i1 x (C - B), since the other arm stays along i1.
//
// The driving torque follows from the principle of virtual power, for virtual velocities that are
// those of the mechanism at a unit rate of theta.

#pragma once

#include "motion.hpp"

#include <array>

namespace reference {

struct UniformBar {
    double mass_per_length;            // kg/m
    double transverse_inertia;         // m22 = m33, kg m^2/m
    double polar_inertia;              // kg m^2/m
};

// All in the inertial frame; the rotation is relative to the reference configuration.
struct BarState {
    Eigen::Matrix3d rotation;
    Eigen::Vector3d centre, velocity, acceleration;
    Eigen::Vector3d angular_velocity, angular_acceleration;
};

struct FourBarState {
    // Rotations, rates and accelerations of bar 3 about +i1 at D and of bar 1 about +i2 at A.
    double theta, theta_rate, theta_acceleration;
    double phi, phi_rate, phi_acceleration;
    Eigen::Vector3d b, b_velocity, b_acceleration;
    Eigen::Vector3d c, c_velocity, c_acceleration;
    std::array<BarState, 3> bars;
    // About +i1, exerted on bar 3 by the drive: what the spring alone asks for, and with inertia.
    double spring_torque;
    double dynamic_torque;
    // Spring energy and kinetic energy.
    double energy;
};

class FourBar {
public:
    Eigen::Vector3d a0{-0.4, 0.0, 0.0}, b0{-0.75, 0.0, 0.652};
    Eigen::Vector3d c0{0.0, 0.85, 0.2}, d0{0.0, 0.85, 0.0};
    std::array<UniformBar, 3> sections{{{1.997, 42.60e-6, 2 * 42.60e-6},
                                        {1.997, 42.60e-6, 2 * 42.60e-6},
                                        {0.4992, 2.662e-6, 2 * 2.662e-6}}};
    double spring_stiffness = 18.0;  // N m/rad

    static double period() { return 2.0 * pi / 0.3; }

    // The prescribed rotation at D and its time derivatives.
    static Eigen::Vector3d drive(double t) {
        const double w = 0.3;
        return {
            w * t + (1 - std::cos(w * t)) / 3 + std::sin(2 * w * t) / 10 +
                (1 - std::cos(3 * w * t)) / 21,
            w * (1 + std::sin(w * t) / 3 + std::cos(2 * w * t) / 5 + std::sin(3 * w * t) / 7),
            w * w *
                (std::cos(w * t) / 3 - 2 * std::sin(2 * w * t) / 5 + 3 * std::cos(3 * w * t) / 7)};
    }

    FourBarState at(double time) const {
        using Eigen::Vector3d;
        const Vector3d i1 = Vector3d::UnitX(), i2 = Vector3d::UnitY();

        FourBarState x;
        const Vector3d driven = drive(time);
        x.theta = driven(0), x.theta_rate = driven(1), x.theta_acceleration = driven(2);
        x.phi = follow_loop(time);
        x.b = point_b(x.phi);
        x.c = point_c(x.theta);
        const Vector3d arm1 = x.b - a0, arm3 = x.c - d0;

        // |C - B| is constant. Its derivatives, with B' = phi' i2 x AB and C' = theta' i1 x DC.
        // The ratio phi'/theta' is a function of the configuration alone.
        const Vector3d bc = x.c - x.b;
        const Vector3d b_by_phi = i2.cross(arm1), c_by_theta = i1.cross(arm3);
        const double ratio = bc.dot(c_by_theta) / bc.dot(b_by_phi);
        x.phi_rate = ratio * x.theta_rate;
        x.b_velocity = x.phi_rate * b_by_phi;
        x.c_velocity = x.theta_rate * c_by_theta;
        const Vector3d b_centripetal = x.phi_rate * i2.cross(x.b_velocity);
        x.c_acceleration =
            x.theta_acceleration * c_by_theta + x.theta_rate * i1.cross(x.c_velocity);
        x.phi_acceleration = (bc.dot(x.c_acceleration - b_centripetal)
                              + (x.c_velocity - x.b_velocity).squaredNorm()) / bc.dot(b_by_phi);
        x.b_acceleration = x.phi_acceleration * b_by_phi + b_centripetal;

        const Vector3d zero = Vector3d::Zero();
        x.bars[0] = between(a0, zero, zero, x.b, x.b_velocity, x.b_acceleration);
        x.bars[0].rotation = rotation_about(i2, x.phi);
        x.bars[0].angular_velocity = x.phi_rate * i2;
        x.bars[0].angular_acceleration = x.phi_acceleration * i2;

        x.bars[1] =
            between(x.b, x.b_velocity, x.b_acceleration, x.c, x.c_velocity, x.c_acceleration);
        x.bars[1].rotation = coupler_frame(x.b, x.c) * coupler_frame(b0, c0).transpose();
        x.bars[1].angular_velocity =
            coupler_angular_velocity(x.b, x.c, x.c_velocity - x.b_velocity);
        x.bars[1].angular_acceleration = coupler_angular_acceleration(
            x.b, x.c, x.c_velocity - x.b_velocity, x.c_acceleration - x.b_acceleration);

        x.bars[2] = between(x.c, x.c_velocity, x.c_acceleration, d0, zero, zero);
        x.bars[2].rotation = rotation_about(i1, x.theta);
        x.bars[2].angular_velocity = x.theta_rate * i1;
        x.bars[2].angular_acceleration = x.theta_acceleration * i1;

        // Virtual velocities: those at theta' = 1.
        const Vector3d virtual_b = ratio * b_by_phi, virtual_c = c_by_theta;
        const std::array<Vector3d, 3> virtual_centre = {
            0.5 * virtual_b, 0.5 * (virtual_b + virtual_c), 0.5 * virtual_c};
        const std::array<Vector3d, 3> virtual_spin = {
            ratio * i2, coupler_angular_velocity(x.b, x.c, virtual_c - virtual_b), i1};

        x.spring_torque = spring_stiffness * x.phi * ratio;
        x.dynamic_torque = x.spring_torque;
        x.energy = 0.5 * spring_stiffness * x.phi * x.phi;
        for (int i = 0; i < 3; ++i) {
            const BarState &bar = x.bars[i];
            const Eigen::Matrix3d inertia =
                bar.rotation * reference_inertia(i) * bar.rotation.transpose();
            const Vector3d &w = bar.angular_velocity;
            x.dynamic_torque += mass(i) * bar.acceleration.dot(virtual_centre[i]);
            x.dynamic_torque +=
                (inertia * bar.angular_acceleration + w.cross(inertia * w)).dot(virtual_spin[i]);
            x.energy += 0.5 * mass(i) * bar.velocity.squaredNorm() + 0.5 * w.dot(inertia * w);
        }
        return x;
    }

    // Position of the centre and rotation from the reference configuration, material-frame twists.
    MotionState bar_motion(int bar, double time) const {
        const BarState s = at(time).bars[bar];
        const Eigen::Matrix3d rt = s.rotation.transpose();
        MotionState m;
        m.motion = {s.rotation, s.centre};
        m.velocity << rt * s.velocity, rt * s.angular_velocity;
        m.acceleration << rt * (s.acceleration - s.angular_velocity.cross(s.velocity)),
            rt * s.angular_acceleration;
        return m;
    }

    double mass(int bar) const {
        return sections[bar].mass_per_length * reference_span(bar).norm();
    }

    // Inertia about the centre, in the reference configuration.
    Eigen::Matrix3d reference_inertia(int bar) const {
        const UniformBar &section = sections[bar];
        const double length = reference_span(bar).norm();
        const Eigen::Vector3d axis = reference_span(bar) / length;
        const Eigen::Matrix3d along = axis * axis.transpose();
        const double polar = section.polar_inertia * length;
        const double transverse =
            mass(bar) * length * length / 12 + section.transverse_inertia * length;
        return polar * along + transverse * (Eigen::Matrix3d::Identity() - along);
    }

    // Ends of a bar in the reference configuration, from first to second.
    Eigen::Vector3d reference_span(int bar) const {
        return bar == 0 ? b0 - a0 : bar == 1 ? c0 - b0 : d0 - c0;
    }

private:
    Eigen::Vector3d point_b(double phi) const {
        return a0 + rotation_about(Eigen::Vector3d::UnitY(), phi) * (b0 - a0);
    }
    Eigen::Vector3d point_c(double theta) const {
        return d0 + rotation_about(Eigen::Vector3d::UnitX(), theta) * (c0 - d0);
    }

    // Angle of bar 1, on the branch that leads there from the reference configuration, where
    // theta = phi = 0. A step of a two-hundredth of a period turns the crank by some 0.05 rad.
    double follow_loop(double time) const {
        const int steps = 1 + static_cast<int>(std::ceil(200 * std::abs(time) / period()));
        double phi = 0.0;
        for (int s = 1; s <= steps; ++s) phi = close_loop(drive(time * s / steps)(0), phi);
        return phi;
    }

    // Newton's method for |C(theta) - B(phi)|^2 = |C - B|^2 of the reference.
    double close_loop(double theta, double phi) const {
        const Eigen::Vector3d c = point_c(theta);
        for (int iteration = 0; iteration < 30; ++iteration) {
            const Eigen::Vector3d bc = c - point_b(phi);
            const double gap = bc.squaredNorm() - (c0 - b0).squaredNorm();
            const double slope = -2 * bc.dot(Eigen::Vector3d::UnitY().cross(point_b(phi) - a0));
            const double step = -gap / slope;
            phi += step;
            // Convergence is quadratic: after a step this small the error is rounding.
            if (std::abs(step) < 1e-9) return phi;
        }
        throw std::runtime_error("the loop of the four-bar mechanism cannot be closed");
    }

    static BarState between(const Eigen::Vector3d &p, const Eigen::Vector3d &p1,
                            const Eigen::Vector3d &p2, const Eigen::Vector3d &q,
                            const Eigen::Vector3d &q1, const Eigen::Vector3d &q2) {
        BarState bar;
        bar.centre = 0.5 * (p + q);
        bar.velocity = 0.5 * (p1 + q1);
        bar.acceleration = 0.5 * (p2 + q2);
        return bar;
    }

    // Columns: along bar 2, along its cross arm, and normal to both.
    static Eigen::Matrix3d coupler_frame(const Eigen::Vector3d &b, const Eigen::Vector3d &c) {
        const Eigen::Vector3d along = (c - b).normalized();
        const Eigen::Vector3d arm = Eigen::Vector3d::UnitX().cross(along).normalized();
        Eigen::Matrix3d frame;
        frame << along, arm, along.cross(arm);
        return frame;
    }

    // w = e x e' + sigma e, with the spin sigma that keeps the arm normal to i1:
    // (w x arm) . i1 = 0.
    static Eigen::Vector3d coupler_angular_velocity(const Eigen::Vector3d &b,
                                                    const Eigen::Vector3d &c,
                                                    const Eigen::Vector3d &bc_velocity) {
        const Eigen::Matrix3d frame = coupler_frame(b, c);
        const Eigen::Vector3d e = frame.col(0), arm = frame.col(1), i1 = Eigen::Vector3d::UnitX();
        const Eigen::Vector3d swing = e.cross(bc_velocity) / (c - b).norm();
        const double spin = -swing.cross(arm).dot(i1) / e.cross(arm).dot(i1);
        return swing + spin * e;
    }

    // The time derivative of the above: (w' x arm + w x (w x arm)) . i1 = 0.
    static Eigen::Vector3d coupler_angular_acceleration(const Eigen::Vector3d &b,
                                                        const Eigen::Vector3d &c,
                                                        const Eigen::Vector3d &bc_velocity,
                                                        const Eigen::Vector3d &bc_acceleration) {
        const Eigen::Matrix3d frame = coupler_frame(b, c);
        const Eigen::Vector3d e = frame.col(0), arm = frame.col(1), i1 = Eigen::Vector3d::UnitX();
        const Eigen::Vector3d w = coupler_angular_velocity(b, c, bc_velocity);
        const double spin = w.dot(e);
        const Eigen::Vector3d known = e.cross(bc_acceleration) / (c - b).norm() + spin * w.cross(e);
        const double spin_rate =
            -(known.cross(arm) + w.cross(w.cross(arm))).dot(i1) / e.cross(arm).dot(i1);
        return known + spin_rate * e;
    }
};

}  // namespace reference
