// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Dynamics/Factor.h"

namespace myotet::dynamics {

/// How the linear equations of Newton's method are solved.
enum class LinearMethod {
    automatic,  ///< iterative, until a factor promises to be cheaper; never above kMostFactored
    iterative,  ///< conjugate gradients, preconditioned by the diagonal blocks
    factored,   ///< conjugate gradients, preconditioned by a Cholesky factor of K as it was
};

/// Free nodes above which `automatic` never makes a factor: its memory grows with the
/// 4/3rd power of the nodes, to about 6 GB here.
inline constexpr std::size_t kMostFactored = 100000;

/// Solves one system after another whose matrices share their pattern and nearly their
/// values, such as those of Newton's method. A factor serves as long as it is good: it is
/// made anew when conjugate gradients take more than a few iterations with it.
class LinearSolver {
public:
    explicit LinearSolver(LinearMethod method = LinearMethod::automatic) : method_(method) {}
    /// As dynamics::solve; `held` shall stay the same.
    [[nodiscard]] LinearSummary solve(const BlockMatrix& K, const std::vector<char>& held,
                                      const NodeVectors& right, const LinearOptions& options,
                                      NodeVectors& x);
    [[nodiscard]] int factors() const { return factors_; }  ///< made so far
    /// Whether it came to use factors: begin with LinearMethod::factored to go on so.
    [[nodiscard]] bool factored() const { return factored_; }
    /// Forgets the factor's numbers, which only save time, but not its ordering.
    void forget() { stale_ = true; }

private:
    [[nodiscard]] bool make_factor(const BlockMatrix& K, const std::vector<char>& held);
    void learn(const BlockMatrix& K, const std::vector<char>& held, int iterations);

    LinearMethod method_;
    Factor factor_;
    bool factored_ = false;  // the method in use
    bool stale_ = false;     // the factor is not to be used
    int factors_ = 0;
};

}  // namespace myotet::dynamics
