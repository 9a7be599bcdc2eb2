// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "Activation/BlockBand.h"

namespace myotet::activation {

/// A cost at a place, and where derivatives are wanted its slope and how that changes: bend
/// and curvature, summed. Bend should not be negative: of squares, the part without second
/// derivatives of what is squared. Curvature may be left out.
struct Cost {
    double value = 0;
    Eigen::VectorXd slope;
    BlockBand bend, curvature;
};
/// Of unknowns x. Where the cost has kinks of its slope, `barrier` tells how round they may be:
/// a hinge, the cost of the least slack s >= w, is taken with -barrier ln(s - w); 0: exactly.
using CostAt = std::function<Cost(const Eigen::VectorXd& x, double barrier, bool with_derivatives)>;

struct BoundsOptions {
    double slope = 1e-9;   ///< ends when no derivative that no bound stops is larger
    int iterations = 200;  ///< at most
};

struct BoundsResult {
    int iterations = 0;
    double cost = 0;
    double slope = 0;  ///< largest derivative that no bound stops
};

/// From x to a least cost within lowest < highest, in two parts. A primal-dual interior-point
/// method comes near: steps of Newton's in the cost with barriers before bounds, which are
/// lowered tenfold and faster [Nocedal 2006, sec. 19.3], and so sees all bounds and hinges at
/// once. Of curvature so much counts as leaves the sum positive; where bend is not, a multiple
/// of the identity makes it so. Then Newton's steps of those unknowns that no bound stops end it
/// exactly [Bertsekas 1982]. Convex costs have one least; of others it is one that x leads to. Cost
/// of an iteration, some 20 to 100: a factor of the band, or a few.
[[nodiscard]] BoundsResult least_within_bounds(const CostAt& cost, const Eigen::VectorXd& lowest,
                                               const Eigen::VectorXd& highest,
                                               const BoundsOptions& options, Eigen::VectorXd& x);

}  // namespace myotet::activation
