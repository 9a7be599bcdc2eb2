// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "Cage/Relax.h"

namespace myotet::cage {

/// What it took to bring all boundary nodes within the offset.
struct ReachSummary {
    bool reached = false;
    int rounds = 0;     ///< of relaxation
    int jumps = 0;      ///< nodes moved to a place not on their way
    int collapsed = 0;  ///< nodes taken out of the mesh
    int refined = 0;    ///< edges bisected
};

/// Brings boundary nodes that variational adjustment left beyond the offset to the surface.
///
/// Such nodes stick where large faces rest on parts of the surface that stand out, while the
/// node between them hangs over a hollow. In this order, each tried again after some rounds of
/// relaxation: sliding (Relax.h); a jump to a place near one of the parts that stand out; the
/// node taken out (Collapse.h); and the mesh refined around it, all boundary edges at the node
/// bisected, so that smaller faces follow the hollow. `interrupted` ends it early.
[[nodiscard]] ReachSummary reach(Walls& walls, const RelaxOptions& options,
                                 const std::function<bool()>& interrupted);

}  // namespace myotet::cage
