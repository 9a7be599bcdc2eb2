// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "Cage/Predicates.h"
#include "Core/BoxTree.h"

namespace myotet::cage {

/// A point of a surface near another point.
struct Nearest {
    std::int32_t triangle = -1;
    Vec3 point = Vec3::Zero();
    double distance = 0;  ///< mm
};

/// The triangles of a surface in a tree of boxes. Rounded arithmetic only ever decides what
/// need not be looked at, with room to spare; what counts is decided by Predicates.h.
class SurfaceTree {
public:
    /// Keeps a copy of the corners. Cost: |F| log |F|.
    explicit SurfaceTree(const TriMesh& surface);

    /// A triangle of the surface that meets a closed triangle, which is not flat, or -1: the
    /// first found. `hint`, a triangle, is looked at first. Exact.
    [[nodiscard]] std::int32_t meets(const Corners3& triangle, std::int32_t hint = -1) const;

    /// Whether the surface meets a closed positive tetrahedron. Exact.
    [[nodiscard]] bool meets(const Corners4& tet) const;

    /// Triangles whose boxes touch that of this one.
    void boxes_touching(const Corners3& triangle, std::vector<std::int32_t>& found) const;

    /// The point of the surface nearest to p, or nothing when none is within `bound` (mm).
    /// `hint`, a triangle, is looked at first.
    [[nodiscard]] std::optional<Nearest> nearest(const Vec3& p, double bound,
                                                 std::int32_t hint = -1) const;

    /// Whether some triangle lies within `bound` of p; stops at the first.
    [[nodiscard]] bool within(const Vec3& p, double bound, std::int32_t hint = -1) const;

    /// How often the surface winds around p, which must not lie on it: 1 inside a closed
    /// surface that faces outwards. Exact.
    [[nodiscard]] int winding(const Vec3& p) const;

    [[nodiscard]] const Corners3& corners(std::int32_t triangle) const {
        return corners_[slot_[triangle]];
    }
    [[nodiscard]] std::size_t size() const { return corners_.size(); }
    [[nodiscard]] const Box& box() const { return tree_.box(); }

private:
    BoxTree tree_;
    std::vector<std::int32_t> slot_;  // where a triangle lies
    std::vector<Corners3> corners_;   // as they lie in leaves
};

}  // namespace myotet::cage
