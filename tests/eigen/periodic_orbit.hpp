// Periodic orbits of ordinary differential equations by shooting, to rounding.

#pragma once

#include <Eigen/Dense>

#include <array>
#include <functional>
#include <stdexcept>
#include <vector>

namespace reference {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// x' = f(t, x).
using Rate = std::function<VectorXd(double, const VectorXd &)>;

// One step by Gragg's midpoint rule with 2, 4, ... 16 substeps, extrapolated to order 16 in `step`.
inline VectorXd after_step(const Rate &f, double t, const VectorXd &x, double step) {
    constexpr int rules = 8;
    std::array<VectorXd, rules> row;  // of Neville's scheme in the square of the substep
    for (int j = 0; j < rules; ++j) {
        const int n = 2 * (j + 1);
        const double h = step / n;
        VectorXd before = x, now = x + h * f(t, x);
        for (int i = 1; i < n; ++i) {
            const VectorXd next = before + 2 * h * f(t + i * h, now);
            before = now, now = next;
        }
        VectorXd value = 0.5 * (now + before + h * f(t + step, now));
        for (int k = 1; k <= j; ++k) {
            const double ratio = double(n) / (2 * (j - k + 1));
            const VectorXd better = value + (value - row[k - 1]) / (ratio * ratio - 1);
            row[k - 1] = value, value = better;
        }
        row[j] = value;
    }
    return row[rules - 1];
}

// States at t = k T / count, k = 0 ... count, `steps` steps from one to the next.
inline std::vector<VectorXd> trajectory(const Rate &f, double period, VectorXd x, int count,
                                        int steps) {
    std::vector<VectorXd> states{x};
    const double h = period / (count * steps);
    for (int k = 0; k < count * steps; ++k) {
        x = after_step(f, k * h, x, h);
        if ((k + 1) % steps == 0) states.push_back(x);
    }
    return states;
}

// The periodic orbit near the state that `start` settles to in `settling` periods.
inline std::vector<VectorXd> periodic_orbit(const Rate &f, double period, const VectorXd &start,
                                            int settling, int count, int steps) {
    const auto after_period = [&](const VectorXd &x) {
        return trajectory(f, period, x, count, steps).back();
    };
    VectorXd x = start;
    for (int i = 0; i < settling; ++i) x = after_period(x);
    for (int iteration = 0; iteration < 10; ++iteration) {
        MatrixXd tangent = -MatrixXd::Identity(x.size(), x.size());
        const double h = 1e-5;  // leaves 1e-10 of an increment
        for (int i = 0; i < x.size(); ++i) {
            const VectorXd d = h * VectorXd::Unit(x.size(), i);
            tangent.col(i) += (after_period(x + d) - after_period(x - d)) / (2 * h);
        }
        const VectorXd increment = tangent.partialPivLu().solve(x - after_period(x));
        x += increment;
        if (increment.norm() < 1e-12 * (1 + x.norm()))
            return trajectory(f, period, x, count, steps);
    }
    throw std::runtime_error("shooting has not converged");
}

}  // namespace reference
