// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Membrane/Wall.h"

namespace myotet::membrane {

/// Which triangles of all levels are in use: a triangle is when all it came from
/// are refined and it is not. Two that share an edge are at most one level apart.
struct Selection {
    std::vector<std::vector<char>> refined;  ///< a level, a triangle: whether its four are used

    explicit Selection(const Levels& levels);
    [[nodiscard]] bool is_refined(int level, std::int32_t triangle) const {
        return refined[level][triangle] != 0;
    }
    /// Whether a triangle is in use or refined.
    [[nodiscard]] bool exists(int level, std::int32_t triangle) const {
        return level == 0 || is_refined(level - 1, triangle / 4);
    }
};

/// Puts the four triangles in the place of one, and before that of those beside
/// it that would be two levels away. Nothing when it is refined already; the
/// triangle must exist and not be of the finest level.
void refine(const Levels& levels, Selection& selection, int level, std::int32_t triangle);

/// Puts a refined triangle back in the place of its four; says whether it could:
/// they must be in use, and nothing beside them two levels finer than it.
bool simplify(const Levels& levels, Selection& selection, int level, std::int32_t triangle);

/// Every triangle refined down to `level`.
[[nodiscard]] Selection wholly_refined(const Levels& levels, int level);

/// A spring with its share of stiffness: half for each triangle beside it.
struct Spring {
    std::int32_t a = 0, b = 0;
    double rest = 0;       ///< length, mm
    double stiffness = 0;  ///< N/mm
    double damping = 0;    ///< N s/mm
};

/// A hanging node follows the middle of the coarse triangle's edge that it lies
/// on, at the offset that it had when it came to hang, turned as the edge has turned
/// since: by the least turn from its direction then, u0, to that now, u,
///
///     R o = c o + w x o + w (w . o) / (1 + c),   c = u0 . u,  w = u0 x u.
///
/// Its forces go to the ends as that place depends on them, half to each and the
/// rest as a couple, its mass half to each: so coarse and fine side meet, and a
/// stretched wall stays at rest across the change of levels.
struct Hanging {
    std::int32_t node = 0, a = 0, b = 0;
    Vec3 offset = Vec3::Zero();  ///< when it came to hang, mm
    Vec3 edge = Vec3::UnitX();   ///< unit, from a to b, then
};

/// R o for the edge b - a as it is now; J d for a change d of the edge and J^T f for a
/// force f on the node, with J how R o depends on the edge.
[[nodiscard]] Vec3 turned_offset(const Hanging& hanging, const Vec3& edge);
[[nodiscard]] Vec3 turned_by(const Hanging& hanging, const Vec3& edge, const Vec3& change);
[[nodiscard]] Vec3 couple_of(const Hanging& hanging, const Vec3& edge, const Vec3& force);

/// What is computed with: the nodes and springs of the triangles in use.
struct Active {
    std::vector<std::int32_t> nodes;  ///< ascending
    std::vector<Hanging> hanging;     ///< from coarse to fine
    std::vector<Spring> springs;
    std::vector<Triangle> drawn;          ///< without cracks
    std::vector<int> drawn_level;         ///< of the triangle that each is a part of
    std::vector<double> mass;             ///< |V| of the finest level, t; 0: not in use
    std::vector<double> inertia;          ///< the same with hanging nodes' given to their ends
    std::array<std::int32_t, 4> types{};  ///< triangles by number of hanging nodes, 0 to 3
    int finest = 0;                       ///< level of the finest triangle in use
};

/// Masses are mixed by the levels of a node's edges [Choi05, eq. 7]; those of
/// nodes that touch a refined triangle are then scaled so that the total is the
/// given surface's. Triangles with hanging nodes are drawn as two, three or four
/// by compensating edges [Choi05, fig. 4], which are no springs.
/// Cost: O(triangles in use).
[[nodiscard]] Active make_active(const Levels& levels, const Selection& selection,
                                 std::span<const LevelProperties> properties);

}  // namespace myotet::membrane
