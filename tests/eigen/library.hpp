// The library's C interface in the reference's terms: motions of Eigen matrices, failures thrown.

#pragma once

#include "motion.hpp"

#include <periodyn.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace library {

using reference::Motion;
using reference::MotionState;

inline void must(pdn_status status) {
    if (status == PDN_OK) return;
    char message[512] = "";
    pdn_last_error(message, sizeof message);
    throw std::runtime_error(std::string(pdn_status_name(status)) + ": " + message);
}

inline void values_of(const pdn_solution *solution, const pdn_quantity &quantity,
                      const std::vector<double> &times, double *out) {
    must(pdn_solution_sample(solution, &quantity, times.data(), times.size(), out));
}

// Motions as the arrays of the C interface: one column to a motion.
struct Columns {
    Eigen::Matrix3Xd positions;
    Eigen::Matrix<double, 9, Eigen::Dynamic> rotations;

    explicit Columns(size_t count) : positions(3, count), rotations(9, count) {}

    explicit Columns(const std::vector<Motion> &motions) : Columns(motions.size()) {
        for (size_t k = 0; k < motions.size(); ++k) {
            positions.col(k) = motions[k].position;
            rotations.col(k) = motions[k].rotation.reshaped();
        }
    }

    Motion motion(size_t k) const { return {rotations.col(k).reshaped(3, 3), positions.col(k)}; }
};

inline pdn_status try_interpolate(double period, const std::vector<Motion> &samples,
                                  const std::vector<double> &times,
                                  std::vector<MotionState> &states) {
    const Columns given(samples);
    Columns found(times.size());
    Eigen::Matrix<double, 6, Eigen::Dynamic> velocity(6, times.size()),
        acceleration(6, times.size());
    const pdn_status status =
        pdn_motion_interpolate(period, given.positions.data(), given.rotations.data(),
                               samples.size(), times.data(), times.size(), found.positions.data(),
                               found.rotations.data(), velocity.data(), acceleration.data());
    states.clear();
    for (size_t k = 0; k < times.size() && status == PDN_OK; ++k)
        states.push_back({found.motion(k), velocity.col(k), acceleration.col(k)});
    return status;
}

inline std::vector<MotionState> interpolate(double period, const std::vector<Motion> &samples,
                                            const std::vector<double> &times) {
    std::vector<MotionState> states;
    must(try_interpolate(period, samples, times, states));
    return states;
}

}  // namespace library
