// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace myotet::activation {

/// What is asked of muscles at one time, and what they can. At each coordinate muscles and
/// reserves must make the torque:
///     sum_i arms(c, i) (passive_i + gains_i a_i) + reserve_c = torques_c.
struct Demand {
    std::vector<double> torques;  ///< a coordinate, N mm; N where it is a length
    Eigen::MatrixXd arms;         ///< (coordinate, muscle): moment arms -dL/dq, mm
    std::vector<double> gains;    ///< a muscle: pull at full activation, N
    std::vector<double> passive;  ///< a muscle: pull when relaxed, N; empty: none
    std::vector<double> lowest;   ///< a muscle: least activation; empty: 0
    std::vector<double> highest;  ///< a muscle: most activation; empty: 1
    /// A muscle: activation as electromyography tells it, NaN where it does not; empty: none.
    std::vector<double> measured;

    [[nodiscard]] std::size_t muscles() const { return gains.size(); }
    [[nodiscard]] std::size_t coordinates() const { return torques.size(); }
    /// Throws InputError naming the field, the muscle or coordinate, its value and the rule.
    void validate() const;
};

/// How a search ended.
enum class Status {
    converged,
    infeasible,     ///< muscles cannot do what is asked of them, and nothing else may
    not_converged,  ///< the best found is not good enough
};

[[nodiscard]] std::string to_string(Status status);

}  // namespace myotet::activation
