// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "Surface/Crossings.h"

namespace myotet::surface {

/// A triangle mesh with boundary while it changes: plain arrays, and for every
/// point the triangles around it. The boundary curve is called the rim.
///
/// The mesh stays an oriented manifold, and keeps on its rim the rules that
/// [Teran05, sec. 6] sets for tetrahedra: no triangle has three points of the
/// rim, no inner edge joins two of them. The functions below that change it
/// expect what their `may_` partner says.
struct Fans {
    std::vector<Vec3> points;                       ///< mm
    std::vector<Vec3> normals;                      ///< unit, of the level set at the points
    std::vector<double> sizes;                      ///< wished edge length at the points, mm
    std::vector<double> caps;                       ///< that sizes must not exceed, mm
    std::vector<char> rim;                          ///< whether the point is on the boundary curve
    std::vector<char> watched;                      ///< points about which crossings are looked for
    std::vector<Triangle> triangles;                ///< removed ones are {-1, -1, -1}
    std::vector<std::vector<std::int32_t>> around;  ///< triangles at each point; none: removed

    /// Triangles that those about watched points might cross; later ones, too.
    std::vector<std::int32_t> beside;
    std::size_t later = 0;       ///< number of the first of these
    std::vector<Placed> others;  ///< of meshes beside this one, to the same end

    [[nodiscard]] bool alive(std::size_t triangle) const { return triangles[triangle][0] >= 0; }
};

/// The triangles that share an edge (a, b), and what lies opposite it: first
/// the one in which b follows a, then the other.
struct EdgeStar {
    std::array<std::int32_t, 2> triangle{-1, -1}, opposite{-1, -1};
    [[nodiscard]] bool inner() const { return triangle[0] >= 0 && triangle[1] >= 0; }
    [[nodiscard]] bool exists() const { return triangle[0] >= 0 || triangle[1] >= 0; }
};

/// Normals and sizes are left zero.
[[nodiscard]] Fans make_fans(const TriMesh& mesh);

/// Without what was removed; order kept.
[[nodiscard]] TriMesh to_mesh(const Fans& fans);

/// Marks the points on edges that have one triangle.
void find_rim(Fans& fans);

[[nodiscard]] EdgeStar edge_star(const Fans& fans, std::int32_t a, std::int32_t b);

/// The corner of a triangle that follows one of its points, and the one before.
[[nodiscard]] inline std::int32_t after(const Triangle& t, std::int32_t point) {
    return t[0] == point ? t[1] : t[1] == point ? t[2] : t[0];
}
[[nodiscard]] inline std::int32_t before(const Triangle& t, std::int32_t point) {
    return t[0] == point ? t[2] : t[1] == point ? t[0] : t[1];
}

/// The other ends of all edges at a point, in no particular, but fixed order.
[[nodiscard]] std::vector<std::int32_t> neighbours(const Fans& fans, std::int32_t point);

/// The two neighbours along the rim of a point on it.
[[nodiscard]] std::array<std::int32_t, 2> rim_neighbours(const Fans& fans, std::int32_t point);

/// Edges at a point less those it should have: six, or four on the rim.
[[nodiscard]] int excess_valence(const Fans& fans, std::int32_t point);

/// Area-weighted normal: twice the area long, mm^2.
[[nodiscard]] inline Vec3 double_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b - a).cross(c - a);
}

/// Cosine of the smallest angle of a triangle: 0.5 for an equilateral one, 1
/// for one that is flat or has no area.
[[nodiscard]] double sharpest_cosine(const Vec3& a, const Vec3& b, const Vec3& c);

/// Whether the edge (a, b) may be replaced by the one between its opposite
/// corners: by topology and by the rim's rules.
[[nodiscard]] bool may_flip(const Fans& fans, std::int32_t a, std::int32_t b, const EdgeStar& star);
void flip(Fans& fans, std::int32_t a, std::int32_t b, const EdgeStar& star);

/// Puts a point at `at` into the edge (a, b); returns its number. Its normal is
/// left zero, its size is the mean of the ends'.
std::int32_t split(Fans& fans, std::int32_t a, std::int32_t b, const EdgeStar& star,
                   const Vec3& at);

/// Whether three points would be joined by edges in a ring that is no triangle if
/// a and b were one. Such a ring is a neck of the surface: with three points about
/// it, nothing keeps its sides apart.
[[nodiscard]] bool closes_ring(const Fans& fans, std::int32_t a, std::int32_t b,
                               const EdgeStar& star);

/// Whether point a may go and b take its triangles: the link condition (the
/// common neighbours of a and b are the corners opposite their edge), the
/// rim's rules, and no point left with fewer than four edges (three on the rim).
/// closes_ring is asked for separately.
[[nodiscard]] bool may_collapse(const Fans& fans, std::int32_t a, std::int32_t b,
                                const EdgeStar& star);
void collapse(Fans& fans, std::int32_t a, std::int32_t b, const EdgeStar& star);

}  // namespace myotet::surface
