// SPDX-License-Identifier: Apache-2.0
#include "Meshing/Selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "Core/Errors.h"

namespace myotet::meshing {
namespace {

// A node this part of its longest edge deep is inside for good: a tube as thick as
// the edges has such nodes all along.
constexpr double kWellInside = 0.15;

using Edge = std::array<std::int32_t, 2>;

// An edge must be this far inside before it crosses [Teran05, sec. 6].
constexpr float kInsideFraction = 0.25f;

Edge sorted_edge(std::int32_t a, std::int32_t b) { return a < b ? Edge{a, b} : Edge{b, a}; }

void sort_unique(auto& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

// Boundary faces with, at each node, a list of them.
struct BoundaryFans {
    std::vector<Triangle> faces;
    std::vector<char> on_boundary;
    std::vector<std::int32_t> start;
    std::vector<Edge> opposite;  // per node and face: the directed edge opposite the node

    BoundaryFans(std::vector<Triangle> f, std::size_t nodes)
        : faces(std::move(f)), on_boundary(nodes, 0), start(nodes + 1, 0) {
        for (const Triangle& t : faces)
            for (const std::int32_t n : t) {
                on_boundary[n] = 1;
                ++start[n + 1];
            }
        for (std::size_t i = 0; i < nodes; ++i) start[i + 1] += start[i];
        opposite.resize(3 * faces.size());
        std::vector<std::int32_t> next(start.begin(), start.end() - 1);
        for (const Triangle& t : faces)
            for (int i = 0; i < 3; ++i) opposite[next[t[i]]++] = {t[(i + 1) % 3], t[(i + 2) % 3]};
    }

    [[nodiscard]] std::span<const Edge> fan(std::int32_t n) const {
        return {opposite.data() + start[n], opposite.data() + start[n + 1]};
    }
    // A boundary edge is one that a face at n has.
    [[nodiscard]] bool is_boundary_edge(std::int32_t n, std::int32_t m) const {
        for (const Edge& e : fan(n))
            if (e[0] == m || e[1] == m) return true;
        return false;
    }
    // One closed ring that visits every face once.
    [[nodiscard]] bool is_manifold(std::int32_t n) const {
        const auto f = fan(n);
        std::int32_t at = f[0][0];
        std::size_t steps = 0;
        do {
            const Edge* found = nullptr;
            for (const Edge& e : f)
                if (e[0] == at) {
                    if (found) return false;
                    found = &e;
                }
            if (!found) return false;
            at = (*found)[1];
            ++steps;
        } while (at != f[0][0] && steps <= f.size());
        return steps == f.size();
    }
};

}  // namespace

bool Trouble::holds_edge(std::int32_t a, std::int32_t b) const {
    return std::binary_search(edges.begin(), edges.end(), sorted_edge(a, b));
}

Selection::Selection(const std::vector<Tet>& tets, const std::vector<float>& phi,
                     std::function<Vec3(std::int32_t)> position)
    : tets_(tets),
      phi_(phi),
      position_(std::move(position)),
      neighbours_(face_neighbours(tets)),
      star_start_(phi.size() + 1, 0),
      hull_(phi.size(), 0),
      enveloped_(phi.size(), 0),
      in_mesh_(tets.size(), 0) {
    for (const Tet& t : tets_)
        for (const std::int32_t n : t) ++star_start_[n + 1];
    for (std::size_t i = 0; i < phi.size(); ++i) star_start_[i + 1] += star_start_[i];
    star_.resize(4 * tets_.size());
    std::vector<std::int32_t> next(star_start_.begin(), star_start_.end() - 1);
    for (std::size_t t = 0; t < tets_.size(); ++t)
        for (int i = 0; i < 4; ++i) {
            star_[next[tets_[t][i]]++] = static_cast<std::int32_t>(t);
            if (neighbours_[t][i] < 0)
                for (const std::int32_t n : face_of(tets_[t], i)) hull_[n] = 1;
        }
}

bool Selection::envelop_node(std::int32_t node) {
    if (enveloped_[node] || hull_[node]) return false;
    enveloped_[node] = 1;
    for (const std::int32_t t : star(node)) in_mesh_[t] = 1;
    return true;
}

void Selection::envelop_inside() {
    std::vector<char> shallow(phi_.size(), 0);
    for (const Tet& t : tets_)
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) {
                // Crossing at t = phi_a / (phi_a - phi_b) of the edge, from a inside.
                const float a = phi_[t[i]], b = phi_[t[j]];
                if (a < 0 && b > 0 && a > kInsideFraction * (a - b)) shallow[t[i]] = 1;
            }
    bool any = false;
    std::int32_t deepest = -1;
    for (std::int32_t n = 0; n < static_cast<std::int32_t>(phi_.size()); ++n) {
        if (star_start_[n] == star_start_[n + 1] || hull_[n]) continue;
        if (deepest < 0 || phi_[n] < phi_[deepest]) deepest = n;
        if (phi_[n] < 0 && !shallow[n]) any |= envelop_node(n);
    }
    if (any) return;
    if (deepest < 0 || !envelop_node(deepest))
        throw MeshError("no lattice node lies inside; ask for a shorter edge length");
}

void Selection::select_inside() {
    bool any = false;
    for (std::size_t t = 0; t < tets_.size(); ++t) {
        const Tet& n = tets_[t];
        in_mesh_[t] = phi_[n[0]] + phi_[n[1]] + phi_[n[2]] + phi_[n[3]] < 0;
        any |= in_mesh_[t] != 0;
    }
    if (!any) throw MeshError("no lattice tetrahedron lies inside; ask for a shorter edge length");
}

Trouble Selection::examine(bool avoid_three_faces) const {
    std::vector<Triangle> faces;
    for (std::size_t t = 0; t < tets_.size(); ++t) {
        if (!in_mesh_[t]) continue;
        for (int i = 0; i < 4; ++i) {
            const std::int32_t other = neighbours_[t][i];
            if (other < 0 || !in_mesh_[other]) faces.push_back(face_of(tets_[t], i));
        }
    }
    const BoundaryFans fans(std::move(faces), phi_.size());
    Trouble trouble;
    for (std::int32_t n = 0; n < static_cast<std::int32_t>(phi_.size()); ++n) {
        if (!fans.on_boundary[n]) continue;
        if (!fans.is_manifold(n))
            trouble.nodes.push_back(n);
        else if (avoid_three_faces && fans.fan(n).size() == 3 && !hull_[n])
            trouble.wishes.push_back(n);
    }
    for (std::size_t t = 0; t < tets_.size(); ++t) {
        if (!in_mesh_[t]) continue;
        for (int i = 0; i < 4; ++i)
            for (int j = i + 1; j < 4; ++j) {
                const std::int32_t a = tets_[t][i], b = tets_[t][j];
                if (fans.on_boundary[a] && fans.on_boundary[b] && !fans.is_boundary_edge(a, b))
                    trouble.edges.push_back(sorted_edge(a, b));
            }
    }
    sort_unique(trouble.edges);
    find_left_out(trouble);
    trouble.only_wishes = trouble.nodes.empty() && trouble.edges.empty();
    return trouble;
}

void Selection::find_left_out(Trouble& trouble) const {
    for (std::int32_t n = 0; n < static_cast<std::int32_t>(phi_.size()); ++n) {
        if (!(phi_[n] < 0) || hull_[n] || star(n).empty()) continue;
        double longest = 0;
        bool selected = false;
        for (const std::int32_t t : star(n)) {
            selected = selected || in_mesh_[t];
            if (selected) break;
            for (const std::int32_t m : tets_[t])
                longest = std::max(longest, (position_(m) - position_(n)).norm());
        }
        if (!selected && phi_[n] < -kWellInside * longest) trouble.left_out.push_back(n);
    }
}

std::size_t Selection::envelop(const Trouble& trouble) {
    std::size_t added = 0;
    for (const std::int32_t n : trouble.nodes) added += envelop_node(n);
    for (const Edge& e : trouble.edges) {
        const std::int32_t deeper = phi_[e[0]] <= phi_[e[1]] ? e[0] : e[1];
        const std::int32_t other = deeper == e[0] ? e[1] : e[0];
        if (enveloped_[deeper] || enveloped_[other]) continue;  // done by an edge before
        added += envelop_node(deeper) || envelop_node(other);
    }
    for (const std::int32_t n : trouble.left_out) added += envelop_node(n);
    for (const std::int32_t n : trouble.wishes) added += envelop_node(n);
    return added;
}

bool Selection::join_pieces(int wanted) {
    std::vector<Tet> selected;
    for (std::size_t t = 0; t < tets_.size(); ++t)
        if (in_mesh_[t]) selected.push_back(tets_[t]);
    std::vector<std::int32_t> piece_of;
    const int pieces = count_components(selected, phi_.size(), &piece_of);
    if (wanted <= 0 || pieces <= wanted) return false;
    std::vector<std::size_t> size(pieces, 0);
    std::vector<std::int32_t> node_piece(phi_.size(), -1);
    for (std::size_t i = 0; i < selected.size(); ++i) {
        ++size[piece_of[i]];
        for (const std::int32_t n : selected[i]) node_piece[n] = piece_of[i];
    }
    const auto smallest =
        static_cast<std::int32_t>(std::min_element(size.begin(), size.end()) - size.begin());

    // Dijkstra from the smallest piece; ways outside cost more the farther out.
    const double scale = (position_(selected[0][0]) - position_(selected[0][1])).norm();
    std::vector<double> cost(phi_.size(), std::numeric_limits<double>::infinity());
    std::vector<std::int32_t> from(phi_.size(), -1);
    using Entry = std::pair<double, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (std::int32_t n = 0; n < static_cast<std::int32_t>(phi_.size()); ++n)
        if (enveloped_[n] && node_piece[n] == smallest) queue.push({cost[n] = 0, n});
    while (!queue.empty()) {
        const auto [so_far, n] = queue.top();
        queue.pop();
        if (so_far > cost[n]) continue;
        if (node_piece[n] >= 0 && node_piece[n] != smallest && enveloped_[n]) {
            for (std::int32_t at = n; at >= 0; at = from[at]) envelop_node(at);
            return true;
        }
        for (const std::int32_t t : star(n))
            for (const std::int32_t m : tets_[t]) {
                if (hull_[m]) continue;
                const double outward = std::clamp(phi_[m] / scale, -1.0, 8.0);
                const double length = (position_(m) - position_(n)).norm();
                const double next = so_far + length * std::exp(4 * outward);
                if (next < cost[m]) {
                    cost[m] = next;
                    from[m] = n;
                    queue.push({next, m});
                }
            }
    }
    return false;  // the lattice itself is in pieces: nothing joins them
}

}  // namespace myotet::meshing
