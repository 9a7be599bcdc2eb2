// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "Quality/Quality.h"

namespace myotet::quality {
namespace {

using Edge = std::array<std::int32_t, 2>;

Edge sorted_edge(std::int32_t a, std::int32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

// Boundary edges, sorted, each as often as boundary faces use it.
std::vector<Edge> edges_of(const std::vector<Triangle>& faces) {
    std::vector<Edge> edges;
    edges.reserve(3 * faces.size());
    for (const Triangle& f : faces)
        for (int i = 0; i < 3; ++i) edges.push_back(sorted_edge(f[i], f[(i + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    return edges;
}

// A boundary node is a manifold one when the edges opposite to it in its faces
// form one closed ring.
std::int64_t count_bad_vertices(const std::vector<Triangle>& faces, std::size_t point_count) {
    std::vector<std::int32_t> start(point_count + 1, 0);
    for (const Triangle& f : faces)
        for (const std::int32_t n : f) ++start[n + 1];
    for (std::size_t i = 0; i < point_count; ++i) start[i + 1] += start[i];
    std::vector<Edge> opposite(3 * faces.size());
    std::vector<std::int32_t> next(start.begin(), start.end() - 1);
    for (const Triangle& f : faces)
        for (int i = 0; i < 3; ++i) opposite[next[f[i]]++] = {f[(i + 1) % 3], f[(i + 2) % 3]};
    std::int64_t bad = 0;
    for (std::size_t v = 0; v < point_count; ++v) {
        const auto first = opposite.begin() + start[v], last = opposite.begin() + start[v + 1];
        if (first == last) continue;
        // Walk the ring from its first edge; a single ring visits every edge once.
        std::int64_t steps = 0;
        const std::int32_t begin = (*first)[0];
        std::int32_t at = begin;
        do {
            const auto it = std::find_if(first, last, [&](const Edge& e) { return e[0] == at; });
            if (it == last) break;
            at = (*it)[1];
            ++steps;
        } while (at != begin && steps <= last - first);
        if (at != begin || steps != last - first) ++bad;
    }
    return bad;
}

}  // namespace

Topology measure_topology(const std::vector<Tet>& tets, std::size_t point_count) {
    Topology t;
    t.components = count_components(tets, point_count);
    const std::vector<Triangle> faces = boundary_faces(tets);
    std::vector<Edge> edges = edges_of(faces);
    for (auto it = edges.begin(); it != edges.end();) {
        auto end = it;
        while (end != edges.end() && *end == *it) ++end;
        if (end - it != 2) ++t.non_manifold_edges;
        it = end;
    }
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<char> on_boundary(point_count, 0);
    for (const Triangle& f : faces)
        for (const std::int32_t n : f) on_boundary[n] = 1;
    t.non_manifold_vertices = count_bad_vertices(faces, point_count);
    t.boundary_manifold =
        !faces.empty() && t.non_manifold_edges == 0 && t.non_manifold_vertices == 0;
    t.euler_characteristic = std::count(on_boundary.begin(), on_boundary.end(), 1) -
                             static_cast<std::int64_t>(edges.size()) +
                             static_cast<std::int64_t>(faces.size());

    std::vector<Edge> inner;
    for (const Tet& tet : tets) {
        int count = 0;
        for (const std::int32_t n : tet) count += on_boundary[n];
        if (count == 4) ++t.tets_with_four_boundary_nodes;
        if (count < 2) continue;
        for (int i = 0; i < 4; ++i)
            for (int j = i + 1; j < 4; ++j)
                if (on_boundary[tet[i]] && on_boundary[tet[j]])
                    inner.push_back(sorted_edge(tet[i], tet[j]));
    }
    std::sort(inner.begin(), inner.end());
    inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
    for (const Edge& e : inner)
        if (!std::binary_search(edges.begin(), edges.end(), e))
            ++t.interior_edges_joining_boundary_nodes;
    return t;
}

}  // namespace myotet::quality
