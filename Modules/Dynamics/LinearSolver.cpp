// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/LinearSolver.h"

#include <algorithm>

namespace myotet::dynamics {
namespace {

// A factor that takes more iterations than this is stale.
constexpr int kStale = 12;
// Fewer iterations than this are no reason to look for a factor.
constexpr int kFew = 100;
// With a factor the residual is measured as the energy of the error, which is stricter than
// with the diagonal at the same effort: it pays to be this exact at least.
constexpr double kExact = 1e-4;
// Far from equilibrium only what is near must settle, such as volumes: the first iterations
// of conjugate gradients do just that, while an exact solution of equations that are far
// from true leads astray. So up to this tolerance they come first, as many as this.
constexpr double kRough = 0.05;
constexpr int kSettling = 100;
// Seconds a multiplication and addition in a factorisation, in a solve with the factor and,
// a block, in an iteration: as measured, only their ratios matter.
constexpr double kFactorCost = 1.2e-10, kSolveCost = 1e-9, kBlockCost = 1.2e-8;
// Solves that a factor serves, and iterations in each.
constexpr double kServes = 3, kIterationsWithFactor = 6;

}  // namespace

bool LinearSolver::make_factor(const BlockMatrix& K, const std::vector<char>& held) {
    ++factors_;
    stale_ = false;
    return factor_.compute(K, held);
}

// Compares what the iterations cost with what a factor would.
void LinearSolver::learn(const BlockMatrix& K, const std::vector<char>& held, int iterations) {
    const auto free = static_cast<std::size_t>(std::count(held.begin(), held.end(), 0));
    if (method_ != LinearMethod::automatic || factored_ || iterations <= kFew ||
        free > kMostFactored)
        return;
    const FactorCost cost = factor_.analyze(K, held);
    const double direct = kFactorCost * cost.operations / kServes +
                          kSolveCost * 4 * cost.entries * kIterationsWithFactor;
    factored_ = direct < kBlockCost * static_cast<double>(K.value.size()) * iterations;
}

LinearSummary LinearSolver::solve(const BlockMatrix& K, const std::vector<char>& held,
                                  const NodeVectors& right, const LinearOptions& options,
                                  NodeVectors& x) {
    if (method_ == LinearMethod::factored) factored_ = true;
    if (factored_ && (stale_ || !factor_.ready()) && !make_factor(K, held)) {
        factored_ = false;  // no factor: go on without
        method_ = LinearMethod::iterative;
    }
    if (!factored_) {
        LinearSummary summary = dynamics::solve(K, held, right, options, x);
        learn(K, held, summary.iterations);
        return summary;
    }
    const NodeVectors start = x;
    LinearOptions few = options;
    few.cheap = 0;  // none is, with a factor
    int spent = 0;
    if (options.tolerance >= kRough) {
        few.iterations = std::min(options.iterations, kSettling);
        LinearSummary rough = dynamics::solve(K, held, right, few, x);
        if (rough.converged || !rough.downward.empty()) return rough;
        spent = rough.iterations;
        x = start;
    }
    few.iterations = std::min(options.iterations, kStale);
    few.tolerance = std::min(options.tolerance, kExact);
    LinearSummary summary = dynamics::solve(K, held, right, few, x, &factor_);
    summary.iterations += spent;
    if (summary.converged || !summary.downward.empty()) return summary;
    x = start;
    spent = summary.iterations;
    if (make_factor(K, held)) {
        few.iterations = options.iterations;
        summary = dynamics::solve(K, held, right, few, x, &factor_);
    } else {
        factored_ = false;
        summary = dynamics::solve(K, held, right, options, x);
    }
    summary.iterations += spent;
    return summary;
}

}  // namespace myotet::dynamics
