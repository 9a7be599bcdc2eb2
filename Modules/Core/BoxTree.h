// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Core/Nearest.h"

namespace myotet {

/// Things in a tree of the boxes around them, halved at the middle of their centres along the
/// longest side. Which thing lies where depends on the centres alone, equal ones by number.
/// Cost: n log n to build, about log n a look-up.
class BoxTree {
public:
    BoxTree() = default;
    /// A box a thing, and where it counts as lying. At least one.
    BoxTree(std::span<const Box> boxes, std::span<const Vec3> centres);

    /// The numbers of the things, as they lie in leaves.
    [[nodiscard]] const std::vector<std::int32_t>& order() const { return order_; }
    [[nodiscard]] const Box& box() const { return cells_.front().box; }

    /// Boxes anew for things that moved; the tree's shape stays. `include(i, box)` puts the
    /// thing at place i of order() into a box.
    template <class Include>
    void follow(const Include& include);

    /// Calls visit(i) with places of order(), those of boxes that misses(box) does not rule
    /// out, until it says true.
    template <class Misses, class Visit>
    void walk(const Misses& misses, const Visit& visit) const;

    /// Calls visit(i) with places of order() whose boxes lie within sqrt(squared) of p, the
    /// nearer half first; `squared` may shrink with what is found.
    template <class Visit>
    void near(const Vec3& p, const double& squared, const Visit& visit) const;

private:
    static constexpr std::int32_t kLeaf = 4;     // things in one, at most
    using Stack = std::array<std::int32_t, 64>;  // as deep as 2^60 things
    struct Cell {
        Box box;
        std::int32_t first = 0, last = 0;  // of order_
        std::int32_t right = -1;           // the left half follows its parent; -1: a leaf
    };
    std::int32_t build(std::span<const Vec3> centres, std::int32_t first, std::int32_t last);

    std::vector<std::int32_t> order_;
    std::vector<Cell> cells_;
};

template <class Include>
void BoxTree::follow(const Include& include) {
    for (std::size_t c = cells_.size(); c-- > 0;) {
        Cell& cell = cells_[c];
        cell.box = {};
        if (cell.right < 0) {
            for (std::int32_t i = cell.first; i < cell.last; ++i) include(i, cell.box);
            continue;
        }
        for (const Box& half : {cells_[c + 1].box, cells_[cell.right].box}) {
            cell.box.include(half.min);
            cell.box.include(half.max);
        }
    }
}

template <class Misses, class Visit>
void BoxTree::walk(const Misses& misses, const Visit& visit) const {
    Stack stack{0};
    for (int top = 1; top > 0;) {
        const std::int32_t c = stack[--top];
        const Cell& cell = cells_[c];
        if (misses(cell.box)) continue;
        if (cell.right >= 0) {
            stack[top++] = cell.right;
            stack[top++] = c + 1;
            continue;
        }
        for (std::int32_t i = cell.first; i < cell.last; ++i)
            if (visit(i)) return;
    }
}

template <class Visit>
void BoxTree::near(const Vec3& p, const double& squared, const Visit& visit) const {
    Stack stack{0};
    for (int top = 1; top > 0;) {
        const std::int32_t c = stack[--top];
        const Cell& cell = cells_[c];
        if (squared_distance(cell.box, p) > squared) continue;
        if (cell.right >= 0) {
            const bool right_first = squared_distance(cells_[cell.right].box, p) <
                                     squared_distance(cells_[c + 1].box, p);
            stack[top++] = right_first ? c + 1 : cell.right;
            stack[top++] = right_first ? cell.right : c + 1;
            continue;
        }
        for (std::int32_t i = cell.first; i < cell.last; ++i) visit(i);
    }
}

}  // namespace myotet
