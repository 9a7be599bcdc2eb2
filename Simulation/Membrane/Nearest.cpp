// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Nearest.h"

namespace myotet::membrane {

// By the region of the triangle's plane that the foot lies in: a corner, an edge or the
// inside (C. Ericson 2005, Real-time collision detection, sec. 5.1.5).
Nearest nearest_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& to) {
    const auto at = [&](double v, double w) {
        return Nearest{a + v * (b - a) + w * (c - a), {1 - v - w, v, w}};
    };
    const Vec3 ab = b - a, ac = c - a;
    const double d1 = ab.dot(to - a), d2 = ac.dot(to - a);
    if (d1 <= 0 && d2 <= 0) return at(0, 0);
    const double d3 = ab.dot(to - b), d4 = ac.dot(to - b);
    if (d3 >= 0 && d4 <= d3) return at(1, 0);
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return at(d1 / (d1 - d3), 0);
    const double d5 = ab.dot(to - c), d6 = ac.dot(to - c);
    if (d6 >= 0 && d5 <= d6) return at(0, 1);
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return at(0, d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return at(1 - w, w);
    }
    const double all = va + vb + vc;
    return at(vb / all, vc / all);
}

}  // namespace myotet::membrane
