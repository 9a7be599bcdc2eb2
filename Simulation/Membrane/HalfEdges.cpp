// SPDX-License-Identifier: Apache-2.0
#include "Membrane/HalfEdges.h"

#include <algorithm>
#include <array>
#include <string>

#include "Core/Errors.h"

namespace myotet::membrane {

namespace {

void check_triangles(const HalfEdges& mesh) {
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle& t = mesh.triangles[f];
        const bool inside = std::all_of(t.begin(), t.end(),
                                        [&](auto v) { return v >= 0 && v < mesh.vertex_count; });
        if (!inside || t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
            throw InputError("triangle " + std::to_string(f) + " is (" + std::to_string(t[0]) +
                             ", " + std::to_string(t[1]) + ", " + std::to_string(t[2]) +
                             "), but must name three different points of the surface's " +
                             std::to_string(mesh.vertex_count));
    }
}

[[noreturn]] void refuse_edge(const HalfEdges& mesh, std::int32_t h, const char* rule) {
    throw InputError("the edge between points " + std::to_string(mesh.from(h)) + " and " +
                     std::to_string(mesh.to(h)) + " " + rule +
                     "; give a manifold surface whose triangles face one way");
}

void find_twins(HalfEdges& mesh) {
    const auto count = static_cast<std::int32_t>(3 * mesh.triangles.size());
    std::vector<std::array<std::int32_t, 3>> sides(count);
    for (std::int32_t h = 0; h < count; ++h) {
        const auto [low, high] = std::minmax({mesh.from(h), mesh.to(h)});
        sides[h] = {low, high, h};
    }
    std::sort(sides.begin(), sides.end());
    mesh.twin.assign(count, -1);
    for (std::int32_t i = 0; i + 1 < count; ++i) {
        const auto& [a, b, h] = sides[i];
        const auto& [c, d, g] = sides[i + 1];
        if (a != c || b != d) continue;
        if (mesh.twin[h] >= 0) refuse_edge(mesh, h, "has more than two triangles");
        if (mesh.from(h) == mesh.from(g))
            refuse_edge(mesh, h, "has two triangles that face opposite ways");
        mesh.twin[h] = g;
        mesh.twin[g] = h;
    }
}

void number_edges(HalfEdges& mesh) {
    const auto count = static_cast<std::int32_t>(mesh.twin.size());
    mesh.edge.assign(count, -1);
    for (std::int32_t h = 0; h < count; ++h) {
        if (mesh.edge[h] >= 0) continue;
        mesh.edge[h] = static_cast<std::int32_t>(mesh.edges.size());
        if (mesh.twin[h] >= 0) mesh.edge[mesh.twin[h]] = mesh.edge[h];
        mesh.edges.push_back(h);
    }
}

void find_leaving(HalfEdges& mesh) {
    const auto count = static_cast<std::int32_t>(mesh.twin.size());
    mesh.leaving.assign(mesh.vertex_count, -1);
    std::vector<int> degree(mesh.vertex_count, 0);
    for (std::int32_t h = 0; h < count; ++h) {
        auto& first = mesh.leaving[mesh.from(h)];
        if (first < 0 || mesh.twin[h] < 0) first = h;
        ++degree[mesh.from(h)];
    }
    for (std::int32_t v = 0; v < mesh.vertex_count; ++v) {
        if (degree[v] == 0)
            throw InputError("point " + std::to_string(v) +
                             " belongs to no triangle, but every point must; leave it out");
        if (static_cast<int>(fan(mesh, mesh.leaving[v]).size()) != degree[v])
            throw InputError("the triangles at point " + std::to_string(v) +
                             " are not one fan, but must be; separate the parts that touch there");
    }
}

}  // namespace

bool HalfEdges::closed() const {
    return std::none_of(twin.begin(), twin.end(), [](auto h) { return h < 0; });
}

std::vector<std::int32_t> fan(const HalfEdges& mesh, std::int32_t first) {
    std::vector<std::int32_t> around;
    std::int32_t h = first;
    do {
        around.push_back(h);
        h = mesh.twin[HalfEdges::before(h)];
    } while (h >= 0 && h != first);
    return around;
}

HalfEdges make_half_edges(std::vector<Triangle> triangles, std::int32_t vertex_count) {
    HalfEdges mesh;
    mesh.vertex_count = vertex_count;
    mesh.triangles = std::move(triangles);
    if (mesh.triangles.empty())
        throw InputError("the surface has no triangle, but must have at least one");
    check_triangles(mesh);
    find_twins(mesh);
    number_edges(mesh);
    find_leaving(mesh);
    return mesh;
}

HalfEdges split_in_four(const HalfEdges& mesh) {
    std::vector<Triangle> parts;
    parts.reserve(4 * mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle& t = mesh.triangles[f];
        Triangle m;
        for (int i = 0; i < 3; ++i) m[i] = mesh.vertex_count + mesh.edge[3 * f + i];
        parts.push_back({t[0], m[0], m[2]});
        parts.push_back({t[1], m[1], m[0]});
        parts.push_back({t[2], m[2], m[1]});
        parts.push_back({m[0], m[1], m[2]});
    }
    return make_half_edges(std::move(parts),
                           mesh.vertex_count + static_cast<std::int32_t>(mesh.edges.size()));
}

}  // namespace myotet::membrane
