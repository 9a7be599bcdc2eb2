// SPDX-License-Identifier: Apache-2.0
#include "Core/BoxTree.h"

#include <algorithm>

#include "Core/Errors.h"

namespace myotet {

BoxTree::BoxTree(std::span<const Box> boxes, std::span<const Vec3> centres) {
    MYOTET_CHECK(!boxes.empty() && boxes.size() == centres.size(),
                 "a tree has things, and a centre for each box");
    order_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) order_[i] = static_cast<std::int32_t>(i);
    (void)build(centres, 0, static_cast<std::int32_t>(order_.size()));
    follow([&](std::int32_t i, Box& box) {
        box.include(boxes[order_[i]].min);
        box.include(boxes[order_[i]].max);
    });
}

std::int32_t BoxTree::build(std::span<const Vec3> centres, std::int32_t first, std::int32_t last) {
    const auto here = static_cast<std::int32_t>(cells_.size());
    cells_.push_back({.box = {}, .first = first, .last = last});
    if (last - first <= kLeaf) return here;
    Box spread;
    for (std::int32_t i = first; i < last; ++i) spread.include(centres[order_[i]]);
    int axis = 0;
    spread.extent().maxCoeff(&axis);
    const std::int32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::int32_t a, std::int32_t b) {
                         const double at_a = centres[a][axis], at_b = centres[b][axis];
                         return at_a < at_b || (at_a == at_b && a < b);
                     });
    (void)build(centres, first, middle);
    const std::int32_t right = build(centres, middle, last);
    cells_[here].right = right;
    return here;
}

}  // namespace myotet
