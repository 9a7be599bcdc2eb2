// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "Surface/Fans.h"

namespace myotet::surface {

/// Takes back what makes triangles cross. Whether a change makes two sides of a
/// thin part cross cannot be told from the triangles around it; it is rare, so
/// many changes are made, and where triangles then cross all is put back and
/// done again with the points about those places watched: there each change is
/// checked against all triangles beside it, the mesh's own and other parts'.
class CrossingGuard {
public:
    /// Crossings that are there to begin with may stay; more may not come, neither
    /// within the mesh nor of it with the one beside it, which must outlive this.
    CrossingGuard(Fans& fans, const TriMesh& beside);

    /// Does `act`, which changes the mesh; not at all when a few tries with more
    /// and more points watched do not help.
    void run(const std::function<void()>& act);

private:
    Fans& fans_;
    const TriMesh& beside_;
    std::vector<std::array<std::int32_t, 2>> there_;  ///< crossings now
};

}  // namespace myotet::surface
