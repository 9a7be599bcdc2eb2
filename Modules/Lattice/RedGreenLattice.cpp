// SPDX-License-Identifier: Apache-2.0
#include "Lattice/RedGreenLattice.h"

#include <cmath>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Lattice/Patterns.h"

namespace myotet::lattice {
namespace {

constexpr std::size_t kGrain = 2048;
constexpr int kCoordinateLimit = 1 << 21;  // NodeMap packs 21 bits a coordinate

}  // namespace

RedGreenLattice::RedGreenLattice(const Box& box, double coarsest_edge, int max_level,
                                 double outside, Field field)
    : box_(box),
      coarsest_edge_(coarsest_edge),
      max_level_(max_level),
      field_(std::move(field)),
      levels_(static_cast<std::size_t>(max_level) + 1) {
    if (!(coarsest_edge > 0))
        throw InputError("the lattice's edge length must be positive, not " +
                         std::to_string(coarsest_edge) + " mm");
    MYOTET_CHECK(max_level >= 0 && max_level < 16, "lattice levels");
    unit_ = coarsest_edge / static_cast<double>(4 << max_level);
    cover(outside);
}

double RedGreenLattice::edge_length(int level) const {
    return coarsest_edge_ / static_cast<double>(1 << level);
}

Vec3 RedGreenLattice::position(std::int32_t node) const {
    const Index3& c = coordinates_[node];
    return origin_ + unit_ * Vec3(c[0], c[1], c[2]);
}

std::int32_t RedGreenLattice::node_at(const Index3& c) {
    const auto fresh = static_cast<std::int32_t>(coordinates_.size());
    const std::int32_t node = map_.find_or_insert(c, fresh);
    if (node == fresh) {
        coordinates_.push_back(c);
        ends_.push_back({-1, -1});
        touched_.push_back(0);
    }
    return node;
}

std::int32_t RedGreenLattice::midpoint(std::int32_t a, std::int32_t b) {
    const Index3 &p = coordinates_[a], &q = coordinates_[b];
    const std::size_t before = coordinates_.size();
    const std::int32_t m = node_at({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
    if (coordinates_.size() != before) {
        ends_[m] = {a, b};
        // A coarser neighbour may know this edge only as half of one of its own,
        // or as joining midpoints of two: it is found through their ends.
        for (const std::int32_t n : {a, b}) {
            touched_[n] = 1;
            for (const std::int32_t end : ends_[n])
                if (end >= 0) touched_[end] = 1;
        }
    }
    return m;
}

std::int32_t RedGreenLattice::find_midpoint(std::int32_t a, std::int32_t b) const {
    const Index3 &p = coordinates_[a], &q = coordinates_[b];
    return map_.find({(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2});
}

void RedGreenLattice::add_tet(int level, const Tet& t) {
    levels_[level].tets.push_back(t);
    levels_[level].state.push_back(State::leaf);
}

void RedGreenLattice::evaluate_new_nodes() {
    const std::size_t first = values_.size();
    values_.resize(coordinates_.size());
    parallel_for(first, values_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            values_[i] = static_cast<float>(field_(position(static_cast<std::int32_t>(i))));
    });
}

void RedGreenLattice::refine_one(RedTet red) {
    const Tet t = levels_[red.level].tets[red.index];
    levels_[red.level].state[red.index] = State::refined;
    std::array<std::int32_t, 6> m;
    for (int e = 0; e < 6; ++e) m[e] = midpoint(t[kEdge[e][0]], t[kEdge[e][1]]);
    for (const Tet& child : red_children(t, m)) add_tet(red.level + 1, child);
}

void RedGreenLattice::apply(int level, std::span<const Verdict> verdicts, std::size_t first) {
    Level& l = levels_[level];
    MYOTET_CHECK(first + verdicts.size() <= l.tets.size(), "a verdict a tetrahedron");
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
        const auto at = static_cast<std::int32_t>(first + i);
        if (l.state[at] != State::leaf) continue;
        if (verdicts[i] == Verdict::discard) l.state[at] = State::discarded;
        if (verdicts[i] == Verdict::refine && level < max_level_) refine_one({level, at});
    }
    evaluate_new_nodes();
}

std::size_t RedGreenLattice::refine(std::span<const RedTet> tets) {
    std::size_t refined = 0;
    for (const RedTet t : tets)
        if (t.level < max_level_ && is_leaf(t)) {
            refine_one(t);
            ++refined;
        }
    evaluate_new_nodes();
    return refined;
}

unsigned RedGreenLattice::bisected_edges(const Tet& t, std::array<std::int32_t, 6>& mids) const {
    unsigned pattern = 0;
    for (int e = 0; e < 6; ++e) {
        mids[e] = find_midpoint(t[kEdge[e][0]], t[kEdge[e][1]]);
        if (mids[e] >= 0) pattern |= 1u << e;
    }
    return pattern;
}

bool RedGreenLattice::neighbour_too_fine(const Tet& t,
                                         const std::array<std::int32_t, 6>& mids) const {
    for (int e = 0; e < 6; ++e)
        if (mids[e] >= 0 && (find_midpoint(t[kEdge[e][0]], mids[e]) >= 0 ||
                             find_midpoint(mids[e], t[kEdge[e][1]]) >= 0))
            return true;
    for (const auto& face : kFaceEdges)
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = mids[face[i]], b = mids[face[(i + 1) % 3]];
            if (a >= 0 && b >= 0 && find_midpoint(a, b) >= 0) return true;
        }
    return false;
}

std::size_t RedGreenLattice::close() {
    std::size_t refined = 0;
    // A tetrahedron is looked at when it is new, and again when two of its nodes
    // are ends of edges bisected since.
    std::vector<std::size_t> seen(levels_.size(), 0);
    std::vector<char> dirty;
    for (bool changed = true; changed;) {
        changed = false;
        std::fill(touched_.begin(), touched_.end(), 0);
        const std::size_t nodes_before = coordinates_.size();
        for (int level = 0; level <= max_level_; ++level) {
            const std::size_t count = levels_[level].tets.size();
            std::vector<std::uint8_t> wanted(count);
            parallel_for(0, count, kGrain, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i) {
                    const Tet& t = levels_[level].tets[i];
                    if (levels_[level].state[i] != State::leaf) continue;
                    const auto is_dirty = [&](std::int32_t n) {
                        return static_cast<std::size_t>(n) >= dirty.size() || dirty[n];
                    };
                    if (i < seen[level] &&
                        is_dirty(t[0]) + is_dirty(t[1]) + is_dirty(t[2]) + is_dirty(t[3]) < 2)
                        continue;
                    std::array<std::int32_t, 6> mids;
                    const unsigned pattern = bisected_edges(t, mids);
                    if (pattern == 0) continue;
                    unsigned closed = closed_pattern(pattern);
                    if (neighbour_too_fine(t, mids)) closed = kAllEdges;
                    if (closed != pattern || closed == kAllEdges)
                        wanted[i] = static_cast<std::uint8_t>(closed);
                }
            });
            for (std::size_t i = 0; i < count; ++i) {
                if (wanted[i] == 0) continue;
                const RedTet red{level, static_cast<std::int32_t>(i)};
                if (wanted[i] == kAllEdges) {
                    MYOTET_CHECK(level < max_level_, "grading never asks the finest level");
                    refine_one(red);
                    ++refined;
                } else {
                    const Tet t = levels_[level].tets[i];
                    for (int e = 0; e < 6; ++e)
                        if (wanted[i] >> e & 1u) midpoint(t[kEdge[e][0]], t[kEdge[e][1]]);
                }
                changed = true;
            }
            seen[level] = count;
        }
        dirty = touched_;
        for (std::size_t i = nodes_before; i < dirty.size(); ++i) dirty[i] = 1;
    }
    evaluate_new_nodes();
    return refined;
}

LatticeMesh RedGreenLattice::mesh() const {
    LatticeMesh out;
    for (int level = 0; level <= max_level_; ++level) {
        const Level& l = levels_[level];
        const std::size_t count = l.tets.size();
        std::vector<std::uint8_t> patterns(count, 0);
        parallel_for(0, count, kGrain, [&](std::size_t first, std::size_t last) {
            std::array<std::int32_t, 6> mids;
            for (std::size_t i = first; i < last; ++i)
                if (l.state[i] == State::leaf)
                    patterns[i] = static_cast<std::uint8_t>(bisected_edges(l.tets[i], mids));
        });
        for (std::size_t i = 0; i < count; ++i) {
            if (l.state[i] != State::leaf) continue;
            const std::size_t before = out.tets.size();
            if (patterns[i] == 0) {
                out.tets.push_back(l.tets[i]);
            } else {
                std::array<std::int32_t, 6> mids;
                const unsigned pattern = bisected_edges(l.tets[i], mids);
                append_green_children(l.tets[i], pattern, mids, out.tets);
            }
            out.red.insert(out.red.end(), out.tets.size() - before,
                           RedTet{level, static_cast<std::int32_t>(i)});
        }
    }
    return out;
}

void RedGreenLattice::cover(double outside) {
    // Cell corners sit at even, cell centres at odd multiples of half a cell.
    const int cell = 4 << max_level_, half = cell / 2;
    for (int a = 0; a < 3; ++a) {
        const double cells = std::ceil(box_.extent()[a] / coarsest_edge_) + 2;
        if (!(cells * cell < kCoordinateLimit))
            throw ResourceError("the lattice would need " + std::to_string(cells) +
                                " cells along one axis; ask for a longer edge length");
        cells_[a] = static_cast<int>(cells);
    }
    const Vec3 size = coarsest_edge_ * Vec3(cells_[0], cells_[1], cells_[2]);
    origin_ = box_.centre() - 0.5 * size;

    // The field at corners and centres first, so that far cells cost one sample.
    const std::size_t nx = cells_[0] + 2, ny = cells_[1] + 2, nz = cells_[2] + 2;
    const std::size_t count = nx * ny * nz;
    std::vector<float> corner(count), centre(count);
    const auto at = [&](int i, int j, int k) { return ((k + 1) * ny + (j + 1)) * nx + (i + 1); };
    parallel_for(0, nz * ny, 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row)
            for (std::size_t i = 0; i < nx; ++i) {
                const Vec3 c(static_cast<double>(i) - 1, static_cast<double>(row % ny) - 1,
                             static_cast<double>(row / ny) - 1);
                corner[row * nx + i] = static_cast<float>(field_(origin_ + coarsest_edge_ * c));
                centre[row * nx + i] = static_cast<float>(
                    field_(origin_ + coarsest_edge_ * (c + Vec3::Constant(0.5))));
            }
    });
    const float far = static_cast<float>(outside * coarsest_edge_);

    // Four tetrahedra around each inner cell face: the two cell centres and one
    // edge of the face each.
    for (int k = 0; k < cells_[2]; ++k)
        for (int j = 0; j < cells_[1]; ++j)
            for (int i = 0; i < cells_[0]; ++i)
                for (int axis = 0; axis < 3; ++axis) {
                    Index3 next{i, j, k};
                    if (++next[axis] >= cells_[axis]) continue;
                    const float c0 = centre[at(i, j, k)],
                                c1 = centre[at(next[0], next[1], next[2])];
                    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
                    Index3 ring[4] = {next, next, next, next};
                    ++ring[1][u];
                    ++ring[2][u];
                    ++ring[2][v];
                    ++ring[3][v];
                    for (int e = 0; e < 4; ++e) {
                        const Index3 &p = ring[e], &q = ring[(e + 1) % 4];
                        if (std::min({c0, c1, corner[at(p[0], p[1], p[2])],
                                      corner[at(q[0], q[1], q[2])]}) > far)
                            continue;
                        const std::int32_t n0 =
                            node_at({i * cell + half, j * cell + half, k * cell + half});
                        const std::int32_t n1 = node_at(
                            {next[0] * cell + half, next[1] * cell + half, next[2] * cell + half});
                        const std::int32_t n2 = node_at({p[0] * cell, p[1] * cell, p[2] * cell});
                        const std::int32_t n3 = node_at({q[0] * cell, q[1] * cell, q[2] * cell});
                        add_tet(0, {n0, n1, n2, n3});
                    }
                }
    evaluate_new_nodes();
}

}  // namespace myotet::lattice
