// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Activation/Distribution.h"

namespace myotet::activation {

/// Who else may carry the torque of a coordinate: nobody, a reserve, what holds it.
enum class Balance { strict, helped, held };

/// Who carries the torque of each coordinate besides muscles.
[[nodiscard]] std::vector<Balance> kinds_of_balance(const DistributionOptions& options,
                                                    std::size_t coordinates);

/// What came of a distribution that was solved in numbers of size 1.
struct Shares {
    std::vector<double> lowest, highest;  ///< a muscle, bounds
    std::vector<double> activations;      ///< a muscle
    std::vector<double> amounts;          ///< a synergy
    std::vector<double> capacity;         ///< a coordinate: what its torques amount to
    std::vector<double> lack;             ///< a coordinate: what muscles do not make
    std::vector<double> prices;           ///< a coordinate
    double residual = 0;                  ///< see ConvexSolution
    double outside = 0;                   ///< how far bounds are broken, by this muscle most
    std::size_t most_outside = 0;
    int iterations = 0;
};

/// Inputs valid. Muscles whose activation is given, by equal bounds, are no unknowns; nor are
/// those of which nothing depends.
[[nodiscard]] Shares solve_shares(const Demand& demand, const DistributionOptions& options);

/// As the criterion says, of all muscles.
[[nodiscard]] double cost_of(const Demand& demand, const DistributionOptions& options,
                             const std::vector<double>& activations);

}  // namespace myotet::activation
