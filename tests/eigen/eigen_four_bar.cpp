// Rigid spatial four-bar mechanism: closure, derivatives, power balance and known ranges.

#include "check.hpp"
#include "differences.hpp"
#include "four_bar.hpp"

#include <algorithm>
#include <limits>

using namespace reference;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr int times = 96;

double time_of(int k) { return FourBar::period() * k / times; }

void check_closure(Checks &check, const FourBar &mechanism) {
    double length = 0, ends = 0, cross = 0, rotation = 0;
    const Vector3d i1 = Vector3d::UnitX();
    const Vector3d arm = i1.cross(mechanism.c0 - mechanism.b0).normalized();
    for (int k = 0; k <= times; ++k) {
        const FourBarState x = mechanism.at(time_of(k));
        const auto &bars = x.bars;
        length =
            std::max(length, std::abs((x.c - x.b).norm() - (mechanism.c0 - mechanism.b0).norm()));
        // Each bar, placed by its own centre and rotation, must reach the joints at both its ends.
        const Vector3d joints[] = {mechanism.a0, x.b, x.c, mechanism.d0};
        for (int i = 0; i < 3; ++i) {
            const Vector3d half = 0.5 * (bars[i].rotation * mechanism.reference_span(i));
            ends = std::max(ends, (bars[i].centre - half - joints[i]).norm());
            ends = std::max(ends, (bars[i].centre + half - joints[i + 1]).norm());
            rotation = std::max(
                rotation,
                (bars[i].rotation.transpose() * bars[i].rotation - Matrix3d::Identity()).norm());
        }
        cross = std::max(cross, std::abs((bars[1].rotation * arm).dot(bars[2].rotation * i1)));
    }
    // Rounding.
    check.at_most("change in length of bar 2", length, 1e-14);
    check.at_most("gaps at the joints", ends, 1e-14);
    check.at_most("cosine between the arms of the universal joint", cross, 1e-14);
    check.at_most("orthogonality of the rotations", rotation, 1e-14);

    const FourBarState first = mechanism.at(0), last = mechanism.at(mechanism.period());
    check.at_most("periodicity of bar 1", std::abs(last.phi - first.phi), 1e-13);
    check.at_most("periodicity of the torque", std::abs(last.dynamic_torque - first.dynamic_torque),
                  1e-11);
    check.at_most("rotation in the reference",
                  (first.bars[1].rotation - Matrix3d::Identity()).norm(), 1e-14);
}

// Rates and accelerations against differences in time. The scales are those of the motion: metres,
// radians and tenths of them per second.
void check_derivatives(Checks &check, const FourBar &mechanism) {
    // With rates of up to some 3 rad/s, truncation (3 h)^4 / 30 and rounding eps / h are below
    // 1e-11.
    const double h = 1e-3;
    double joint = 0, point = 0, spin = 0, bar_velocity = 0, bar_acceleration = 0;
    for (int k = 0; k < times; ++k) {
        const double t = time_of(k);
        const FourBarState x = mechanism.at(t);
        const auto rate = [&](auto select) {
            return central_difference([&](double s) { return select(mechanism.at(t + s)); }, h);
        };
        using State = const FourBarState &;
        joint =
            std::max({joint, std::abs(rate([](State s) { return s.theta; }) - x.theta_rate),
                      std::abs(rate([](State s) { return s.theta_rate; }) - x.theta_acceleration),
                      std::abs(rate([](State s) { return s.phi; }) - x.phi_rate),
                      std::abs(rate([](State s) { return s.phi_rate; }) - x.phi_acceleration)});
        point = std::max({point, (rate([](State s) { return s.b; }) - x.b_velocity).norm(),
                          (rate([](State s) { return s.b_velocity; }) - x.b_acceleration).norm(),
                          (rate([](State s) { return s.c; }) - x.c_velocity).norm(),
                          (rate([](State s) { return s.c_velocity; }) - x.c_acceleration).norm()});
        for (int i = 0; i < 3; ++i) {
            const BarState &bar = x.bars[i];
            const Matrix3d turning =
                rate([i](State s) { return s.bars[i].rotation; }) * bar.rotation.transpose();
            const Vector3d turning_rate = rate([i](State s) { return s.bars[i].angular_velocity; });
            spin = std::max({spin, (turning - skew(bar.angular_velocity)).norm(),
                             (turning_rate - bar.angular_acceleration).norm()});

            // The material-frame form that other programs compare with.
            const MotionState m = mechanism.bar_motion(i, t);
            const Matrix3d rt = m.motion.rotation.transpose();
            const auto motion_rate = [&](auto select) {
                return central_difference(
                    [&](double s) { return select(mechanism.bar_motion(i, t + s)); }, h);
            };
            Vector6 velocity;
            velocity << rt * motion_rate([](const MotionState &s) { return s.motion.position; }),
                axial(rt * motion_rate([](const MotionState &s) { return s.motion.rotation; }));
            const Vector6 acceleration =
                motion_rate([](const MotionState &s) { return s.velocity; });
            bar_velocity = std::max(bar_velocity, (velocity - m.velocity).norm());
            bar_acceleration = std::max(bar_acceleration, (acceleration - m.acceleration).norm());
        }
    }
    check.at_most("joint rates and accelerations", joint, 1e-9);
    check.at_most("velocities and accelerations of B and C", point, 1e-9);
    check.at_most("angular velocities and accelerations of the bars", spin, 1e-9);
    check.at_most("material velocities of the bars", bar_velocity, 1e-9);
    check.at_most("material accelerations of the bars", bar_acceleration, 1e-9);
}

// The drive's power is the rate of change of the energy. The torque comes from accelerations and
// virtual velocities, the energy from velocities, so the two roads are separate.
void check_power(Checks &check, const std::string &name, const FourBar &mechanism) {
    double dynamic = 0, spring = 0, scale = 0;
    for (int k = 0; k < times; ++k) {
        const double t = time_of(k);
        const FourBarState x = mechanism.at(t);
        const double power =
            central_difference([&](double s) { return mechanism.at(t + s).energy; }, 1e-3);
        const double spring_power = central_difference(
            [&](double s) {
                return 0.5 * mechanism.spring_stiffness * std::pow(mechanism.at(t + s).phi, 2);
            },
            1e-3);
        dynamic = std::max(dynamic, std::abs(x.dynamic_torque - power / x.theta_rate));
        spring = std::max(spring, std::abs(x.spring_torque - spring_power / x.theta_rate));
        scale = std::max(scale, std::abs(x.dynamic_torque));
    }
    // The rate of theta stays above 0.18 rad/s, so dividing by it is harmless.
    check.at_most("power balance with inertia, " + name, dynamic / scale, 1e-9);
    check.at_most("power balance of the spring, " + name, spring / scale, 1e-9);
}

// The energy again, summed along the bars from the velocities of their ends: checks the inertias.
void check_energy(Checks &check, const FourBar &mechanism) {
    double worst = 0;
    for (int k = 0; k < times; ++k) {
        const FourBarState x = mechanism.at(time_of(k));
        const Vector3d zero = Vector3d::Zero();
        const Vector3d first[] = {zero, x.b_velocity, x.c_velocity},
                       second[] = {x.b_velocity, x.c_velocity, zero};
        double energy = 0.5 * mechanism.spring_stiffness * x.phi * x.phi;
        for (int i = 0; i < 3; ++i) {
            const UniformBar &section = mechanism.sections[i];
            const double length = mechanism.reference_span(i).norm();
            const Vector3d axis = x.bars[i].rotation * mechanism.reference_span(i) / length;
            const double roll = x.bars[i].angular_velocity.dot(axis);
            const double bend = (x.bars[i].angular_velocity - roll * axis).squaredNorm();
            // The velocity varies linearly along a bar, so its square is integrated exactly.
            const double square =
                (first[i].squaredNorm() + first[i].dot(second[i]) + second[i].squaredNorm()) / 3;
            energy += 0.5 * length *
                      (section.mass_per_length * square + section.polar_inertia * roll * roll +
                       section.transverse_inertia * bend);
        }
        worst = std::max(worst, std::abs(energy - x.energy) / std::max(x.energy, 1e-3));
    }
    check.at_most("energy summed along the bars, relative", worst, 1e-12);
}

// Ranges read off figures 8 to 10 of the paper, within half a unit of the last digit.
void check_ranges(Checks &check, const FourBar &mechanism) {
    const double infinity = std::numeric_limits<double>::infinity();
    Vector3d low = Vector3d::Constant(infinity), high = -low;
    for (int k = 0; k <= 2000; ++k) {
        const FourBarState x = mechanism.at(FourBar::period() * k / 2000);
        const Vector3d now(x.b.z(), x.b_velocity.z(), x.spring_torque);
        low = low.cwiseMin(now), high = high.cwiseMax(now);
    }
    check.within("least x3 of B", low(0), 0.5225, 0.5235);
    check.within("greatest x3 of B", high(0), 0.7395, 0.7405);
    check.within("least v3 of B", low(1), -0.0705, -0.0695);
    check.within("greatest v3 of B", high(1), 0.0765, 0.0775);
    check.within("least quasi-static torque", low(2), -11.25, -11.15);
    check.within("greatest quasi-static torque", high(2), 8.75, 8.85);
}

// The motions of the bars, sampled on a grid and interpolated, against themselves: ties the
// mechanism to the interpolation, frames and ordering included.
void check_interpolation(Checks &check, const FourBar &mechanism) {
    const int n = 81;
    const double period = FourBar::period();
    double motion = 0, velocity = 0, acceleration = 0;
    for (int i = 0; i < 3; ++i) {
        std::vector<Motion> samples;
        for (int k = 0; k < n; ++k)
            samples.push_back(mechanism.bar_motion(i, grid_time(k, n, period)).motion);
        const MotionInterpolant interpolant(period, samples);
        for (int k = 0; k < n; ++k) {
            const double t = period * (k + 0.5) / n;
            const MotionState x = interpolant.at(t), exact = mechanism.bar_motion(i, t);
            motion = std::max({motion, (x.motion.position - exact.motion.position).norm(),
                               (x.motion.rotation - exact.motion.rotation).norm()});
            velocity = std::max(velocity, (x.velocity - exact.velocity).norm());
            acceleration = std::max(acceleration, (x.acceleration - exact.acceleration).norm());
        }
    }
    // The harmonics of the mechanism reach rounding on this grid; each derivative multiplies it by
    // up to 40 times 0.3 rad/s. The limits leave room for other compilers.
    check.at_most("bars interpolated, motion", motion, 1e-12);
    check.at_most("bars interpolated, velocity", velocity, 1e-11);
    check.at_most("bars interpolated, acceleration", acceleration, 1e-10);
}

}  // namespace

int main() {
    Checks check;
    const FourBar mechanism;
    std::printf("      t/T   x3 of B             v3 of B             spring torque       torque "
                "with inertia\n");
    for (int quarter = 0; quarter <= 4; ++quarter) {
        const FourBarState x = mechanism.at(FourBar::period() * quarter / 4);
        std::printf("      %.2f  %18.15f  %18.15f  %18.14f  %18.14f\n", quarter / 4.0, x.b.z(),
                    x.b_velocity.z(), x.spring_torque, x.dynamic_torque);
    }
    check_closure(check, mechanism);
    check_derivatives(check, mechanism);
    check_power(check, "as built", mechanism);
    // As built, inertia makes a 400th of the torque and sections next to nothing of that;
    // magnified, errors in either would show.
    FourBar heavy;
    for (UniformBar &section : heavy.sections) {
        section.mass_per_length *= 1e3;
        section.transverse_inertia *= 1e6;
        section.polar_inertia *= 1e6;
    }
    check_power(check, "heavy bars", heavy);
    check_energy(check, heavy);
    check_ranges(check, mechanism);
    check_interpolation(check, mechanism);
    return check.exit_code();
}
