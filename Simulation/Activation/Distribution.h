// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "Activation/Demand.h"

namespace myotet {
class ProgressSink;
}

namespace myotet::activation {

/// What muscles share a load by.
enum class Criterion {
    activation,  ///< least sum of weight a^exponent
    stress,      ///< least sum of weight (pull / area)^exponent [Crowninshield 1981]
};

/// How a load is shared among muscles.
struct DistributionOptions {
    Criterion criterion = Criterion::activation;
    double exponent = 2;          ///< more than 1; 2 and 3 are usual
    std::vector<double> weights;  ///< a muscle, such as its volume, positive; empty: 1
    std::vector<double> areas;    ///< a muscle: physiological cross-section, mm^2, for stress
    /// A coordinate: strength of the actuator that helps out, N mm or N; 0: there is none,
    /// infinite: something else holds the coordinate, such as a lock. Empty: none anywhere.
    std::vector<double> reserves;
    /// What a reserve of its strength costs, beside the dearest muscle at its most. It grows in
    /// proportion, so that a reserve stays exactly 0 until muscles would cost more.
    double reserve_price = 1000;
    /// (muscle, synergy), none negative: activations are synergies times amounts that are not
    /// negative. Empty: each muscle is driven on its own.
    Eigen::MatrixXd synergies;
    /// Of the squared differences from Demand::measured, beside the dearest muscle at its
    /// most; 0: they do not matter.
    double tracking = 0;
    double tolerance = 1e-9;  ///< see Distribution::residual
    int iterations = 100;     ///< at most
    /// For messages; empty: numbers.
    std::vector<std::string> muscle_names, coordinate_names;

    /// Throws InputError naming the field, its value and the rule.
    void validate(std::size_t muscles, std::size_t coordinates) const;
};

/// Who pulls how much at one time, and how sure that is.
struct Distribution {
    Status status = Status::not_converged;
    std::string message = "not run";
    std::vector<double> activations;  ///< a muscle
    std::vector<double> forces;       ///< a muscle, N, passive pull included
    std::vector<double> reserves;     ///< a coordinate, N mm or N
    /// A coordinate without reserve: what is missing there, N mm or N; 0 unless infeasible.
    std::vector<double> missing;
    std::vector<double> amounts;  ///< a synergy
    std::vector<int> bounds;      ///< a muscle: -1 at its least activation, 1 at its most, else 0
    std::vector<double> prices;   ///< d cost / d torque, a coordinate
    double cost = 0;              ///< of the muscles, as the criterion says
    /// How well the conditions of Karush, Kuhn and Tucker hold, in parts of the dearest muscle's
    /// cost and of the coordinates' capacity.
    double residual = 0;
    double torque_residual = 0;  ///< largest that reserves and `missing` do not explain, N mm or N
    int iterations = 0;
};

/// Static optimisation of one time: the least cost that balances every coordinate within
/// the bounds. Convex, so that what it finds is the only answer; a muscle of which nothing
/// depends, such as one without gain, gets its least activation. Where muscles cannot, the
/// status is infeasible, the message names the coordinates, and the result is what comes
/// nearest (least sum of missing torque by capacity). Throws InputError.
/// Cost: O(muscles coordinates^2) an iteration, some 20 to 30; 6 muscles and 2 coordinates
/// some 80 us.
[[nodiscard]] Distribution distribute(const Demand& demand, const DistributionOptions& options);

/// The same of many times, each on its own; same bytes on any number of threads.
[[nodiscard]] std::vector<Distribution> distribute(std::span<const Demand> demands,
                                                   const DistributionOptions& options,
                                                   ProgressSink& progress);

/// What a muscle pulls at an activation, and its derivatives by it.
struct Pull {
    double force = 0, slope = 0;  ///< N, N
    double bend = 0;              ///< N, the second: curve fits end faster when they know it
};
using PullOf = std::function<Pull(std::size_t muscle, double activation)>;

/// Of muscles whose pull is not proportional to activation, such as behind elastic tendons:
/// a sequence of problems as above, linearised where the one before ended [Nocedal and
/// Wright 2006, ch. 18], until activations change by less than 1e-10. gains and passive of
/// the demand are not used.
[[nodiscard]] Distribution distribute(const Demand& demand, const PullOf& pull,
                                      const DistributionOptions& options);

}  // namespace myotet::activation
