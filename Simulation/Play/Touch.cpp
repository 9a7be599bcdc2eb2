// SPDX-License-Identifier: Apache-2.0
#include "Play/Touch.h"

#include <algorithm>

namespace myotet::play {

using dynamics::NodeVectors;

double move_to(std::span<Touch> touches, const NodeVectors& x) {
    double energy = 0;
    for (Touch& t : touches) {
        const Vec3 at = t.sum(x);
        t.press = std::max(0.0, t.gap - (t.normal.dot(at) - t.offset));
        const Vec3 way = at - t.start;
        t.slide = way - t.normal.dot(way) * t.normal;
        energy += 0.5 * t.stiffness * t.press * t.press + 0.5 * t.drag * t.slide.squaredNorm();
    }
    return energy;
}

void lag_friction(std::span<Touch> touches, double slip) {
    for (Touch& t : touches)
        t.drag = t.friction * t.stiffness * t.press / std::max(t.slide.norm(), slip);
}

void lag_friction(std::span<Touch> touches, std::span<const Touch> before, double slip) {
    std::size_t i = 0;
    for (Touch& t : touches) {
        while (i < before.size() && before[i].who < t.who) ++i;
        t.drag = 0;
        if (i < before.size() && before[i].who == t.who)
            t.drag = t.friction * before[i].stiffness * before[i].press /
                     std::max(before[i].slide.norm(), slip);
    }
}

void add_forces(std::span<const Touch> touches, NodeVectors& forces) {
    for (const Touch& t : touches) {
        if (t.press == 0 && t.drag == 0) continue;
        const Vec3 force = t.stiffness * t.press * t.normal - t.drag * t.slide;
        for (int i = 0; i < t.count; ++i) forces[t.node[i]] += t.weight[i] * force;
    }
}

// k n n^T where it presses, and drag (I - n n^T)
void add_product(std::span<const Touch> touches, const NodeVectors& x, NodeVectors& y) {
    for (const Touch& t : touches) {
        if (t.press == 0 && t.drag == 0) continue;
        const Vec3 by = t.sum(x);
        const double along = t.normal.dot(by);
        const double k = t.press > 0 ? t.stiffness : 0;
        const Vec3 force = (k - t.drag) * along * t.normal + t.drag * by;
        for (int i = 0; i < t.count; ++i) y[t.node[i]] += t.weight[i] * force;
    }
}

void add_diagonal(std::span<const Touch> touches, std::span<Mat3> diagonal) {
    for (const Touch& t : touches) {
        if (t.press == 0 && t.drag == 0) continue;
        const double k = t.press > 0 ? t.stiffness : 0;
        Mat3 block = (k - t.drag) * t.normal * t.normal.transpose();
        block.diagonal().array() += t.drag;
        for (int i = 0; i < t.count; ++i) diagonal[t.node[i]] += t.weight[i] * t.weight[i] * block;
    }
}

}  // namespace myotet::play
