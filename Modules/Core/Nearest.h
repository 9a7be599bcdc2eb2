// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Geometry.h"

namespace myotet {

/// The squared distance from a point to a box, 0 inside.
[[nodiscard]] inline double squared_distance(const Box& box, const Vec3& p) {
    return (p - p.cwiseMax(box.min).cwiseMin(box.max)).squaredNorm();
}

/// The point of a triangle that is nearest to another, and its barycentric coordinates,
/// exactly 0 where it is on an edge or at a corner.
struct OnTriangle {
    Vec3 point;
    std::array<double, 3> weights;
};

/// By the region of the triangle's plane that p lies over: a corner's, an edge's or the
/// triangle's own. A triangle without area gives one of its points.
/// Source: C. Ericson (2005), Real-time collision detection, sec. 5.1.5.
[[nodiscard]] inline OnTriangle nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b,
                                                    const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a;
    const double ab_a = ab.dot(p - a), ac_a = ac.dot(p - a);
    if (ab_a <= 0 && ac_a <= 0) return {a, {1, 0, 0}};
    const double ab_b = ab.dot(p - b), ac_b = ac.dot(p - b);
    if (ab_b >= 0 && ac_b <= ab_b) return {b, {0, 1, 0}};
    const double ab_c = ab.dot(p - c), ac_c = ac.dot(p - c);
    if (ac_c >= 0 && ab_c <= ac_c) return {c, {0, 0, 1}};
    // Areas of the triangles that p makes with the edges, all times the same.
    const double of_c = ab_a * ac_b - ab_b * ac_a;
    if (of_c <= 0 && ab_a >= 0 && ab_b <= 0) {
        const double s = ab_a / (ab_a - ab_b);
        return {a + s * ab, {1 - s, s, 0}};
    }
    const double of_b = ab_c * ac_a - ab_a * ac_c;
    if (of_b <= 0 && ac_a >= 0 && ac_c <= 0) {
        const double s = ac_a / (ac_a - ac_c);
        return {a + s * ac, {1 - s, 0, s}};
    }
    const double of_a = ab_b * ac_c - ab_c * ac_b;
    const double to_c = ac_b - ab_b, to_b = ab_c - ac_c;
    if (of_a <= 0 && to_c >= 0 && to_b >= 0) {
        const double s = to_c / (to_c + to_b);
        return {b + s * (c - b), {0, 1 - s, s}};
    }
    const double sum = of_a + of_b + of_c;
    if (!(sum > 0)) return {a, {1, 0, 0}};
    const double v = of_b / sum, w = of_c / sum;
    return {a + v * ab + w * ac, {1 - v - w, v, w}};
}

}  // namespace myotet
