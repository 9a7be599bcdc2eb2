// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "Core/TetMesh.h"

namespace myotet::membrane {

/// An oriented manifold of triangles, closed or with rims, by half-edges.
/// Half-edge 3 f + i of triangle f goes from its corner i to the next one.
struct HalfEdges {
    std::int32_t vertex_count = 0;
    std::vector<Triangle> triangles;    ///< |F|
    std::vector<std::int32_t> twin;     ///< 3 |F|: the half-edge that goes back; -1 on a rim
    std::vector<std::int32_t> edge;     ///< 3 |F|: the edge that a half-edge lies on
    std::vector<std::int32_t> edges;    ///< |E|: the first half-edge of an edge
    std::vector<std::int32_t> leaving;  ///< |V|: a half-edge from there; on a rim the one along it

    [[nodiscard]] static std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
    [[nodiscard]] static std::int32_t before(std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
    [[nodiscard]] std::int32_t from(std::int32_t h) const { return triangles[h / 3][h % 3]; }
    [[nodiscard]] std::int32_t to(std::int32_t h) const { return from(next(h)); }
    /// The corner opposite a half-edge in its triangle.
    [[nodiscard]] std::int32_t apex(std::int32_t h) const { return from(before(h)); }
    [[nodiscard]] bool on_rim(std::int32_t vertex) const { return twin[leaving[vertex]] < 0; }
    [[nodiscard]] bool closed() const;
};

/// Throws InputError for a triangle that names a point twice or one that is not
/// there, an edge with more than two triangles or two that disagree on a side,
/// a point without triangles or whose triangles are not one fan.
/// Cost: O(|F| log |F|).
[[nodiscard]] HalfEdges make_half_edges(std::vector<Triangle> triangles, std::int32_t vertex_count);

/// Half-edges that leave an inner vertex, counter-clockwise from `first`.
[[nodiscard]] std::vector<std::int32_t> fan(const HalfEdges& mesh, std::int32_t first);

/// Each triangle (a, b, c) in four, numbers 4 f to 4 f + 3: those at a, b and c,
/// each beginning there, then the middle one. The midpoint of edge e is vertex
/// |V| + e.
[[nodiscard]] HalfEdges split_in_four(const HalfEdges& mesh);

}  // namespace myotet::membrane
