// SPDX-License-Identifier: Apache-2.0
#include "Activation/ProjectedNewton.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace myotet::activation {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

// Damping beside the largest stiffness: keeps the factor from directions that cost nothing.
constexpr double kDamping = 1e-14;
// Of what the slope promises [Armijo 1966], and the shortest step.
constexpr double kEnough = 1e-4, kShortest = 1e-9;

bool stopped(double x, double slope, double lowest, double highest) {
    return (x <= lowest && slope > 0) || (x >= highest && slope < 0);
}

// A step of the free unknowns; the others stay.
VectorXd step_of(const Squares& now, const std::vector<char>& is_free) {
    const Index n = now.slope.size();
    std::vector<Index> place(static_cast<std::size_t>(n), -1);
    Index count = 0;
    for (Index i = 0; i < n; ++i)
        if (is_free[static_cast<std::size_t>(i)]) place[static_cast<std::size_t>(i)] = count++;
    std::vector<Eigen::Triplet<double>> chosen;
    VectorXd right(count);
    for (Index i = 0; i < n; ++i)
        if (const Index at = place[static_cast<std::size_t>(i)]; at >= 0) {
            chosen.emplace_back(i, at, 1.0);
            right[at] = -now.slope[i];
        }
    Sparse choose(n, count);
    choose.setFromTriplets(chosen.begin(), chosen.end());
    const Sparse J = now.jacobian * choose;
    Sparse H = J.transpose() * J;
    const VectorXd diagonal = H.diagonal();
    const double damping = kDamping * (count > 0 ? diagonal.maxCoeff() : 0);
    for (Index i = 0; i < count; ++i) H.coeffRef(i, i) += damping;
    const Eigen::SimplicialLDLT<Sparse> factor(H);
    return factor.info() == Eigen::Success ? VectorXd(choose * factor.solve(right))
                                           : VectorXd(choose * right);
}

}  // namespace

ProjectedResult least_within_bounds(const SquaresAt& squares, const VectorXd& lowest,
                                    const VectorXd& highest, const ProjectedOptions& options,
                                    VectorXd& x) {
    ProjectedResult out;
    x = x.cwiseMax(lowest).cwiseMin(highest);
    for (;; ++out.iterations) {
        const Squares now = squares(x, true);
        std::vector<char> is_free(static_cast<std::size_t>(x.size()));
        out.cost = now.cost;
        out.slope = 0;
        for (Index i = 0; i < x.size(); ++i) {
            const bool free = !stopped(x[i], now.slope[i], lowest[i], highest[i]);
            is_free[static_cast<std::size_t>(i)] = free;
            if (free) out.slope = std::max(out.slope, std::abs(now.slope[i]));
        }
        if (out.slope <= options.slope || out.iterations == options.iterations) return out;
        const VectorXd d = step_of(now, is_free);
        bool fell = false;
        for (double step = 1; step > kShortest && !fell; step *= 0.5) {
            const VectorXd to = (x + step * d).cwiseMax(lowest).cwiseMin(highest);
            const double promised = now.slope.dot(to - x);
            fell = promised < 0 && squares(to, false).cost <= now.cost + kEnough * promised;
            if (fell) x = to;
        }
        if (!fell) return out;
    }
}

}  // namespace myotet::activation
