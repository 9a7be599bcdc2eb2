// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/SparseCore>
#include <functional>

namespace myotet::activation {

/// Half the sum of squares of some residuals at a place, and where derivatives are wanted its
/// slope and the residuals' Jacobian.
struct Squares {
    double cost = 0;
    Eigen::VectorXd slope;
    Eigen::SparseMatrix<double, Eigen::RowMajor> jacobian;
};
using SquaresAt = std::function<Squares(const Eigen::VectorXd& x, bool with_derivatives)>;

struct ProjectedOptions {
    double slope = 1e-9;   ///< ends when no derivative that no bound stops is larger
    int iterations = 100;  ///< at most
};

struct ProjectedResult {
    int iterations = 0;
    double cost = 0;
    double slope = 0;  ///< largest derivative that no bound stops
};

/// From x to the least within bounds, by Gauss and Newton's steps of those unknowns that no
/// bound stops, along the path that is bent at bounds until the cost has fallen enough
/// [Bertsekas 1982]. Where residuals are linear it ends exactly, once it knows which bounds
/// hold. Cost of an iteration: a sparse factor.
[[nodiscard]] ProjectedResult least_within_bounds(const SquaresAt& squares,
                                                  const Eigen::VectorXd& lowest,
                                                  const Eigen::VectorXd& highest,
                                                  const ProjectedOptions& options,
                                                  Eigen::VectorXd& x);

}  // namespace myotet::activation
