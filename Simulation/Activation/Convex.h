// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace myotet::activation {

/// Find y that makes least
///     sum_j (cost_j |offset_j + scale_j x_j|^exponent + pull_j (x_j - towards_j)^2)
///         + sum_c price_c |r_c|
/// where x = shares y and balance y + r = goal, while lowest <= x <= highest. Convex: the
/// missing r, which costs its price, makes it solvable whatever is asked.
struct ConvexProgram {
    Eigen::MatrixXd shares;  ///< (x, y)
    bool diagonal = false;   ///< shares are the identity: y is x
    double exponent = 2;     ///< > 1
    Eigen::VectorXd cost, offset, scale, pull, towards, lowest,
        highest;                  ///< a x; highest may be inf
    Eigen::MatrixXd balance;      ///< (row, y)
    Eigen::VectorXd goal, price;  ///< a row; price > 0
};

struct ConvexOptions {
    double tolerance = 1e-9;  ///< of the residual below
    int iterations = 100;     ///< of Newton's method, at most
};

struct ConvexSolution {
    bool converged = false;
    int iterations = 0;
    Eigen::VectorXd x, y, missing, multipliers;  ///< multipliers of the balance
    Eigen::VectorXd at_lowest, at_highest;       ///< multipliers of bounds, not negative
    /// Largest of: slope of the Lagrangian, and the lesser of a bound's slack and its
    /// multiplier, both beside the largest multiplier if that is more than 1; balance.
    double residual = 0;
    double outside = 0;  ///< how far bounds of x are broken
};

/// By a primal-dual interior-point method for numbers of size 1: each step is one of
/// Newton's on the conditions of Karush, Kuhn and Tucker whose complementarity is relaxed to
/// mu, shortened while their residual does not fall [Boyd and Vandenberghe 2004, sec. 11.7];
/// mu falls as Mehrotra's predictor allows [Nocedal and Wright 2006, sec. 14.2]. Cost of an
/// iteration: O(x rows^2) when diagonal, O(x y^2 + y rows^2) else; some 20 to 30 of them.
[[nodiscard]] ConvexSolution solve_convex(const ConvexProgram& program,
                                          const ConvexOptions& options);

}  // namespace myotet::activation
