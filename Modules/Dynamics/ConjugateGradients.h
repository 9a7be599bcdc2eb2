// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Dynamics/BlockMatrix.h"

namespace myotet::dynamics {

struct LinearOptions {
    double tolerance = 1e-8;  ///< of the residual's norm, beside the right hand side's
    int iterations = 5000;    ///< at most
    int cheap = 0;            ///< up to so many go on, to a hundredth of the tolerance
};

struct LinearSummary {
    bool converged = false;
    int iterations = 0;
    double residual = 0;  ///< relative
    /// Where K is not positive, a direction p with p . K p <= 0 and p . right >= 0 that
    /// was met, zero at held nodes; else empty.
    NodeVectors downward = {};
};

/// z = M^-1 r with a symmetric positive M near K, zero at held nodes.
class Preconditioner {
public:
    virtual ~Preconditioner() = default;
    virtual void apply(const NodeVectors& r, NodeVectors& z) const = 0;
};

/// Solves K x = right for the nodes that are not `held`; held ones keep the values that
/// `x` has, free ones begin there. Conjugate gradients, preconditioned by `with` or, where
/// that is null, by the inverses of the diagonal blocks. K shall be symmetric; where it is
/// not positive the solution so far stays in x, as far as it goes downhill [Nocedal and
/// Wright 2006, algorithm 7.1]. For tolerances of 1e-5 and more the iterations read K in
/// single precision, half the memory's traffic. Same bytes on any number of threads. `held`
/// has |V| entries, not 0 for held nodes.
[[nodiscard]] LinearSummary solve(const BlockMatrix& K, const std::vector<char>& held,
                                  const NodeVectors& right, const LinearOptions& options,
                                  NodeVectors& x, const Preconditioner* with = nullptr);

}  // namespace myotet::dynamics
