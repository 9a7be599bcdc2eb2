// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Play/Touch.h"

namespace myotet::play {

/// A system of equations of one iteration: K of the bodies and inertia, and touches beside it,
/// which join nodes of any bodies and so are in no fixed pattern.
struct System {
    const dynamics::BlockMatrix& K;
    std::span<const Touch> touches;
    const std::vector<char>& held;  ///< nodes that stay
};

struct SolveOptions {
    double tolerance = 0.1;  ///< of the residual, in the preconditioner's norm
    int iterations = 300;    ///< at most
};

/// (K + touches) d = right on nodes that are not held, d = 0 on those that are. Conjugate
/// gradients, preconditioned by the inverses of the diagonal blocks, touches included; all in
/// single precision. Ends early along a direction in which the system is not
/// positive, with what was found so far: d still goes downhill. Returns the iterations.
/// Same bytes on any number of threads.
int solve(const System& system, const dynamics::NodeVectors& right, const SolveOptions& options,
          dynamics::NodeVectors& d);

}  // namespace myotet::play
