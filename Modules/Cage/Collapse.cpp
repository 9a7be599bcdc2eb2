// SPDX-License-Identifier: Apache-2.0
#include "Cage/Collapse.h"

#include <algorithm>
#include <set>

#include "Cage/StarShape.h"

namespace myotet::cage {
namespace {

constexpr std::int32_t kOutside = -1;  // the node that all boundary faces are joined to

using Edge = std::array<std::int32_t, 2>;

Edge sorted(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// Nodes, edges and triangles around a simplex.
struct Link {
    std::set<std::int32_t> nodes;
    std::set<Edge> edges;
    std::set<Triangle> triangles;
    void add(Triangle t) {
        std::ranges::sort(t);
        triangles.insert(t);
        for (int i = 0; i < 3; ++i) {
            nodes.insert(t[i]);
            edges.insert(sorted(t[i], t[(i + 1) % 3]));
        }
    }
};

bool has(const auto& simplex, std::int32_t n) {
    return std::ranges::find(simplex, n) != simplex.end();
}

Link link_of(const Body& body, std::int32_t node) {
    Link link;
    for (const std::int32_t t : body.star[node]) {
        const Tet& tet = body.tets[t];
        link.add(face_of(tet, static_cast<int>(std::ranges::find(tet, node) - tet.begin())));
    }
    for (const std::int32_t f : body.fan[node]) {
        Triangle t = body.faces[f];
        std::ranges::replace(t, node, kOutside);
        link.add(t);
    }
    return link;
}

/// Around the edge: nodes and edges only.
Link link_of(const Body& body, std::int32_t a, std::int32_t b) {
    Link link;
    const auto add = [&](const auto& simplex, std::int32_t more) {
        Edge rest{more, more};
        int k = 0;
        for (const std::int32_t n : simplex)
            if (n != a && n != b) rest[k++] = n;
        link.nodes.insert(rest.begin(), rest.end());
        link.edges.insert(sorted(rest[0], rest[1]));
    };
    for (const std::int32_t t : body.star[a])
        if (has(body.tets[t], b)) add(body.tets[t], kOutside);
    for (const std::int32_t f : body.fan[a])
        if (has(body.faces[f], b)) add(body.faces[f], kOutside);
    return link;
}

template <class Set>
Set common(const Set& a, const Set& b) {
    Set both;
    std::ranges::set_intersection(a, b, std::inserter(both, both.end()));
    return both;
}

bool may_collapse(const Body& body, std::int32_t node, std::int32_t into) {
    const Link a = link_of(body, node), b = link_of(body, into), ab = link_of(body, node, into);
    return common(a.triangles, b.triangles).empty() && common(a.nodes, b.nodes) == ab.nodes &&
           common(a.edges, b.edges) == ab.edges;
}

/// Tetrahedra and boundary faces around the joined node, at x.
struct Joined {
    std::vector<Corners4> tets;
    std::vector<Corners3> faces;
};

Joined join(const Body& body, std::int32_t node, std::int32_t into, const Vec3& x) {
    Joined joined;
    const auto place = [&](std::int32_t n) { return n == node || n == into ? x : body.points[n]; };
    for (const std::int32_t end : {node, into}) {
        const std::int32_t other = end == node ? into : node;
        for (const std::int32_t t : body.star[end]) {
            const Tet& n = body.tets[t];
            if (!has(n, other))
                joined.tets.push_back({place(n[0]), place(n[1]), place(n[2]), place(n[3])});
        }
        for (const std::int32_t f : body.fan[end]) {
            const Triangle& n = body.faces[f];
            if (!has(n, other)) joined.faces.push_back({place(n[0]), place(n[1]), place(n[2])});
        }
    }
    return joined;
}

double worst(const Joined& joined) {
    double least = 90;
    for (const Corners4& t : joined.tets) least = std::min(least, score_deg(t));
    return least;
}

void renumber(Body& body, std::int32_t node, std::int32_t into) {
    std::vector<Tet> tets;
    for (const Tet& t : body.tets) {
        if (has(t, node) && has(t, into)) continue;
        tets.push_back(t);
        std::ranges::replace(tets.back(), node, into);
    }
    body.tets = std::move(tets);
}

}  // namespace

bool collapse(Walls& walls, std::int32_t node, double offset, double least) {
    Body& body = walls.body();
    std::set<std::int32_t> ends;
    for (const std::int32_t f : body.fan[node])
        for (const std::int32_t n : body.faces[f])
            if (n != node) ends.insert(n);
    std::int32_t best = -1;
    Vec3 best_at = Vec3::Zero();
    for (const std::int32_t into : ends) {
        if (!may_collapse(body, node, into)) continue;
        for (const double part : {0.0, 0.25, 0.5}) {
            const Vec3 x = body.points[into] + part * (body.points[node] - body.points[into]);
            if (!walls.within(into, x, std::max(offset, walls.nearest(into).distance))) continue;
            const Joined joined = join(body, node, into, x);
            const double score = worst(joined);
            if (score < least || !walls.allows(node, into, joined.tets, joined.faces)) continue;
            least = score;
            best = into;
            best_at = x;
        }
    }
    if (best < 0) return false;
    renumber(body, node, best);
    body.points[best] = best_at;
    connect(body);
    walls.start_anew();
    return true;
}

}  // namespace myotet::cage
