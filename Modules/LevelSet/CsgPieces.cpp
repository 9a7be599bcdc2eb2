// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/CsgPieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "LevelSet/Csg.h"
#include "LevelSet/CsgTable.h"
#include "LevelSet/Measure.h"

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;
constexpr int kSize = Band::kSize;

using Node = std::int32_t;

// Union-find in which the smaller number always leads, so that the first
// sample of a piece does.
class Groups {
public:
    explicit Groups(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0);
    }
    Node find(Node n) {
        while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
        return n;
    }
    void join(Node a, Node b) {
        a = find(a);
        b = find(b);
        if (a < b)
            parent_[b] = a;
        else
            parent_[a] = b;
    }

private:
    std::vector<Node> parent_;
};

// Nodes: stored samples, then the table's slots. A node of an unstored block
// stands for all its samples.
struct Nodes {
    const Band& band;
    Side side;

    [[nodiscard]] Node node(const Index3& block, int at) const {
        const std::int32_t number = band.find(block);
        return static_cast<Node>(number >= 0 ? std::size_t(number) * kSize + at
                                             : band.values.size() + band.slot(block));
    }
    [[nodiscard]] bool on_side(const Index3& block, int at) const {
        const std::int32_t number = band.find(block);
        const float v = number >= 0 ? band.block(number)[at] : band.empty_value(number);
        return (v < 0) == (side == Side::inside);
    }
    [[nodiscard]] bool in_table(const Index3& block) const {
        for (int a = 0; a < 3; ++a)
            if (block[a] >= band.blocks[a]) return false;
        return true;
    }
};

// Joins samples with their upper neighbours, inside a block or over its face.
void join_block(const Nodes& nodes, const Index3& block, Groups& groups) {
    constexpr int steps[3] = {1, kSide, kSide * kSide};
    const bool stored = nodes.band.find(block) >= 0;
    for (int at = 0; at < kSize; ++at) {
        const Index3 q{at % kSide, at / kSide % kSide, at / (kSide * kSide)};
        for (int a = 0; a < 3; ++a) {
            const bool leaves = q[a] == kSide - 1;
            if (!stored && !leaves) continue;
            Index3 there = block;
            there[a] += leaves;
            const int to = leaves ? at - (kSide - 1) * steps[a] : at + steps[a];
            if (nodes.in_table(there) && nodes.on_side(block, at) && nodes.on_side(there, to))
                groups.join(nodes.node(block, at), nodes.node(there, to));
        }
    }
}

template <class Body>
void each_block(const Band& band, Body&& body) {
    for (int k = 0; k < band.blocks[2]; ++k)
        for (int j = 0; j < band.blocks[1]; ++j)
            for (int i = 0; i < band.blocks[0]; ++i) body(Index3{i, j, k});
}

// Volume of each group in cells, by its leading node. A cut cell's part goes to
// the group of its first corner on that side.
std::vector<double> volumes(const Nodes& nodes, Groups& groups) {
    const Band& band = nodes.band;
    std::vector<double> sum(band.values.size() + band.block_of.size(), 0.0);
    constexpr int n = kSide + 1;
    std::array<float, n * n * n> phi;
    each_block(band, [&](const Index3& b) {
        if (band.find(b) < 0) {
            if (nodes.on_side(b, 0)) sum[groups.find(nodes.node(b, 0))] += kSize;
            return;
        }
        gather(band, b, 0, 1, phi.data());
        for (int at = 0; at < kSize; ++at) {
            const Index3 q{at % kSide, at / kSide % kSide, at / (kSide * kSide)};
            const float* p = phi.data() + (q[2] * n + q[1]) * n + q[0];
            const double inside = inside_fraction({p[0], p[1], p[n], p[n + 1], p[n * n],
                                                   p[n * n + 1], p[n * n + n], p[n * n + n + 1]});
            const double part = nodes.side == Side::inside ? inside : 1 - inside;
            for (int corner = 0; part > 0 && corner < 8; ++corner) {
                Index3 there = b, s;
                for (int a = 0; a < 3; ++a) {
                    s[a] = q[a] + (corner >> a & 1);
                    there[a] += s[a] / kSide;
                    s[a] %= kSide;
                }
                const int to = (s[2] * kSide + s[1]) * kSide + s[0];
                if (!nodes.in_table(there) || !nodes.on_side(there, to)) continue;
                sum[groups.find(nodes.node(there, to))] += part;
                break;
            }
        }
    });
    return sum;
}

}  // namespace

Pieces find_pieces(const Band& band, Side side) {
    const Nodes nodes{band, side};
    Groups groups(band.values.size() + band.block_of.size());
    each_block(band, [&](const Index3& b) { join_block(nodes, b, groups); });
    std::vector<double> sum = volumes(nodes, groups);
    // The table's first corner lies outside of everything.
    if (side == Side::outside)
        sum[groups.find(nodes.node({0, 0, 0}, 0))] = std::numeric_limits<double>::infinity();

    Pieces pieces;
    pieces.side = side;
    std::vector<std::int32_t> piece_of(sum.size(), -1);
    std::vector<Node> leaders;
    const auto visit = [&](const Index3& b, int at) {
        if (!nodes.on_side(b, at)) return;
        const Node leader = groups.find(nodes.node(b, at));
        if (piece_of[leader] >= 0) return;
        piece_of[leader] = 0;
        leaders.push_back(leader);
    };
    each_block(band, [&](const Index3& b) {
        const int count = band.find(b) >= 0 ? kSize : 1;
        for (int at = 0; at < count; ++at) visit(b, at);
    });
    std::stable_sort(leaders.begin(), leaders.end(),
                     [&](Node a, Node b) { return sum[a] > sum[b]; });
    for (std::size_t i = 0; i < leaders.size(); ++i) {
        piece_of[leaders[i]] = static_cast<std::int32_t>(i);
        pieces.volume.push_back(sum[leaders[i]] * std::pow(band.spacing, 3));
    }
    pieces.of_sample.assign(band.values.size(), -1);
    pieces.of_slot.assign(band.block_of.size(), -1);
    each_block(band, [&](const Index3& b) {
        const std::int32_t number = band.find(b);
        if (number < 0) {
            if (nodes.on_side(b, 0))
                pieces.of_slot[band.slot(b)] = piece_of[groups.find(nodes.node(b, 0))];
            return;
        }
        for (int at = 0; at < kSize; ++at)
            if (nodes.on_side(b, at))
                pieces.of_sample[std::size_t(number) * kSize + at] =
                    piece_of[groups.find(nodes.node(b, at))];
    });
    return pieces;
}

std::vector<char> pieces_meeting(const Band& band, const Pieces& pieces, const Band& other) {
    std::vector<char> meets(pieces.volume.size(), 0);
    const Index3 shift = block_offset(band, other);
    each_block(band, [&](const Index3& b) {
        const std::int32_t number = band.find(b);
        const std::int32_t theirs = other.find({b[0] - shift[0], b[1] - shift[1], b[2] - shift[2]});
        if (theirs == Band::kOutside) return;
        for (int at = 0; at < kSize; ++at) {
            const std::int32_t piece = number >= 0
                                           ? pieces.of_sample[std::size_t(number) * kSize + at]
                                           : pieces.of_slot[band.slot(b)];
            if (piece < 0) continue;
            if (theirs == Band::kInside || other.block(theirs)[at] < 0) meets[piece] = 1;
        }
    });
    return meets;
}

Band flip_pieces(const Band& band, const Pieces& pieces, const std::vector<char>& marked) {
    Band out = band;
    const float other = pieces.side == Side::inside ? band.width : -band.width;
    const std::int32_t unstored = pieces.side == Side::inside ? Band::kOutside : Band::kInside;
    for (std::size_t i = 0; i < out.values.size(); ++i)
        if (pieces.of_sample[i] >= 0 && marked[pieces.of_sample[i]]) out.values[i] = other;
    for (std::size_t s = 0; s < out.block_of.size(); ++s)
        if (pieces.of_slot[s] >= 0 && marked[pieces.of_slot[s]]) out.block_of[s] = unstored;
    return settle(out);
}

}  // namespace myotet::levelset
