// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "Core/Geometry.h"

namespace myotet {

using Tet = std::array<std::int32_t, 4>;
using Triangle = std::array<std::int32_t, 3>;

/// Tetrahedra over shared points. A tetrahedron (a, b, c, d) is positive when
/// (b - a) x (c - a) . (d - a) > 0; every mesh Myotet writes is positive.
struct TetMesh {
    std::vector<Vec3> points;          ///< |V| positions, mm
    std::vector<Tet> tets;             ///< |T| indices into points
    std::vector<std::int32_t> labels;  ///< |T| label values of the scan, or empty
};

/// Triangles over shared points; counter-clockwise seen from outside.
struct TriMesh {
    std::vector<Vec3> points;         ///< |V| positions, mm
    std::vector<Triangle> triangles;  ///< |F| indices into points
};

/// Six times the signed volume would be the triple product; this is the volume, mm^3.
[[nodiscard]] inline double signed_volume(const Vec3& a, const Vec3& b, const Vec3& c,
                                          const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a) / 6.0;
}

/// Sum of the signed volumes of all tetrahedra, mm^3.
[[nodiscard]] double volume(const TetMesh& mesh);

/// Volume enclosed by a closed, outward oriented surface, mm^3.
[[nodiscard]] double volume(const TriMesh& surface);

/// Volume-weighted centroid of a tetrahedral mesh, mm.
[[nodiscard]] Vec3 centroid(const TetMesh& mesh);

/// |T| x 4: the tetrahedron behind the face opposite each node, or -1.
/// Cost: O(|T|), on all threads.
[[nodiscard]] std::vector<Tet> face_neighbours(const std::vector<Tet>& tets);

/// Corners of the face opposite node `face` of a tetrahedron, outward for a
/// positive one.
[[nodiscard]] inline Triangle face_of(const Tet& t, int face) {
    constexpr int corner[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    return {t[corner[face][0]], t[corner[face][1]], t[corner[face][2]]};
}

/// Faces that belong to exactly one tetrahedron, oriented outwards, in the
/// order of their tetrahedra; indices refer to the tetrahedral mesh's points.
/// Cost: O(|T|).
[[nodiscard]] std::vector<Triangle> boundary_faces(const std::vector<Tet>& tets);

/// The boundary as a surface of its own: points renumbered in the order of
/// first use, unused ones left out.
[[nodiscard]] TriMesh boundary_surface(const TetMesh& mesh);

/// Number of connected components, two tetrahedra being connected by a shared
/// node; `component_of`, if given, receives |T| component numbers, the first
/// tetrahedron's being 0.
[[nodiscard]] int count_components(const std::vector<Tet>& tets, std::size_t point_count,
                                   std::vector<std::int32_t>* component_of = nullptr);

/// Appends `part` to `whole`, points, tetrahedra and labels.
void append(TetMesh& whole, const TetMesh& part);

}  // namespace myotet
