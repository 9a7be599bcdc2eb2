// SPDX-License-Identifier: Apache-2.0
#include "Cage/Parts.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "Cage/SurfaceTree.h"
#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Core/Text.h"

namespace myotet::cage {
namespace {

using Pair = std::array<std::int32_t, 2>;

constexpr std::size_t kGrain = 1024;

std::string place(const Vec3& p) {
    return "(" + shown(p[0]) + ", " + shown(p[1]) + ", " + shown(p[2]) + ") mm";
}

// Triangles with a corner in common, at the same place.
bool neighbours_meet(const Corners3& s, const Corners3& t, int shared, int at_s, int at_t) {
    if (shared > 1) return false;
    const Vec3 &s1 = s[(at_s + 1) % 3], &s2 = s[(at_s + 2) % 3];
    const Vec3 &t1 = t[(at_t + 1) % 3], &t2 = t[(at_t + 2) % 3];
    return (!flat(t) && segment_meets(s1, s2, t)) || (!flat(s) && segment_meets(t1, t2, s));
}

struct OpenEdges {
    std::int64_t open = 0, crowded = 0;
    std::optional<Vec3> first_open, first_crowded;
};

// Each edge is passed once each way by the triangles on its two sides.
OpenEdges find_open_edges(const TriMesh& surface) {
    struct Half {
        Pair edge;
        int way = 0;
        auto operator<=>(const Half&) const = default;
    };
    std::vector<Half> halves;
    for (const Triangle& t : surface.triangles)
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = t[i], b = t[(i + 1) % 3];
            halves.push_back({{std::min(a, b), std::max(a, b)}, a < b ? 1 : -1});
        }
    std::ranges::sort(halves);
    OpenEdges found;
    for (std::size_t i = 0, end = 0; i < halves.size(); i = end) {
        int sum = 0;
        for (end = i; end < halves.size() && halves[end].edge == halves[i].edge; ++end)
            sum += halves[end].way;
        const Vec3 middle =
            0.5 * (surface.points[halves[i].edge[0]] + surface.points[halves[i].edge[1]]);
        if (end - i == 1) {
            if (found.open++ == 0) found.first_open = middle;
        } else if (sum != 0 || end - i != 2) {
            if (found.crowded++ == 0) found.first_crowded = middle;
        }
    }
    return found;
}

}  // namespace

bool faces_meet(const Corners3& s, const Corners3& t) {
    int shared = 0, at_s = 0, at_t = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (s[i] == t[j]) {
                ++shared;
                at_s = i;
                at_t = j;
            }
    if (shared > 0) return neighbours_meet(s, t, shared, at_s, at_t);
    if (flat(s)) return !flat(t) && triangles_meet(t, s);
    return triangles_meet(s, t);
}

std::vector<Part> parts_of(const TriMesh& surface) {
    std::vector<std::int32_t> root(surface.points.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](std::int32_t v) {
        while (root[v] != v) v = root[v] = root[root[v]];
        return v;
    };
    for (const Triangle& t : surface.triangles)
        for (int i = 1; i < 3; ++i) {
            const std::int32_t a = find(t[0]), b = find(t[i]);
            root[std::max(a, b)] = std::min(a, b);
        }
    std::vector<std::int32_t> number(surface.points.size(), -1);
    std::vector<Part> parts;
    for (const Triangle& t : surface.triangles)
        for (const std::int32_t v : t) {
            const std::int32_t r = find(v);
            if (number[r] < 0) {
                number[r] = static_cast<std::int32_t>(parts.size());
                parts.push_back({surface.points[v], {}});
            }
            parts[number[r]].box.include(surface.points[v]);
        }
    return parts;
}

std::vector<Pair> pairs_that_meet(const TriMesh& surface) {
    const SurfaceTree tree(surface);
    const std::size_t count = surface.triangles.size();
    std::vector<std::vector<Pair>> found(count / kGrain + 1);
    parallel_for(0, found.size(), 1, [&](std::size_t first, std::size_t last) {
        std::vector<std::int32_t> near;
        for (std::size_t part = first; part < last; ++part)
            for (std::size_t a = part * kGrain; a < std::min(count, (part + 1) * kGrain); ++a) {
                const auto number = static_cast<std::int32_t>(a);
                tree.boxes_touching(tree.corners(number), near);
                for (const std::int32_t b : near)
                    if (b > number && faces_meet(tree.corners(number), tree.corners(b)))
                        found[part].push_back({number, b});
            }
    });
    std::vector<Pair> pairs;
    for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
    std::ranges::sort(pairs);
    return pairs;
}

void require_closed(const TriMesh& surface) {
    if (surface.triangles.empty()) throw InputError("the surface has no triangles");
    for (std::size_t p = 0; p < surface.points.size(); ++p)
        if (!surface.points[p].allFinite())
            throw InputError("point " + std::to_string(p) + " of the surface is not finite");
    const OpenEdges edges = find_open_edges(surface);
    if (edges.open > 0)
        throw InputError("the surface is open: " + std::to_string(edges.open) +
                         " edges have one triangle alone, the first at " +
                         place(*edges.first_open) +
                         "; a cage encloses closed surfaces, close it or have it healed");
    if (edges.crowded > 0)
        throw InputError("the surface is no manifold: " + std::to_string(edges.crowded) +
                         " edges have more than two triangles, or two that disagree on their "
                         "sides, the first at " +
                         place(*edges.first_crowded) + "; mend it or have it healed");
    const std::vector<Pair> pairs = pairs_that_meet(surface);
    if (pairs.empty()) return;
    const Vec3 at = surface.points[surface.triangles[pairs.front()[0]][0]];
    throw InputError("the surface meets itself: " + std::to_string(pairs.size()) +
                     " pairs of triangles cross or touch, the first being " +
                     std::to_string(pairs.front()[0]) + " and " + std::to_string(pairs.front()[1]) +
                     " near " + place(at) + "; mend it or have it healed");
}

}  // namespace myotet::cage
