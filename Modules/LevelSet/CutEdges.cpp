// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/CutEdges.h"

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"

namespace myotet::levelset {
namespace {

using Int = std::int64_t;
using Wide = __int128;
using Corner = std::array<Int, 3>;

constexpr Int kFine = SnappedTriangle::kFine;
// Depths are divided exactly only this near to a sample, in spacings: the error of
// doubles is far below.
constexpr double kNearSample = 1e-4;

int sign(Int a) { return (a > 0) - (a < 0); }

/// Twice the area of (a, b, p) along axes u and v, and on which side of a -> b p lies
/// once the triangle has moved.
struct Side {
    Int area;
    int sign;
};
Side side_of(const Corner& a, const Corner& b, Int pu, Int pv, int u, int v) {
    const Int du = b[u] - a[u], dv = b[v] - a[v];
    const Int area = du * (pv - a[v]) - dv * (pu - a[u]);
    // The point moves by (-eu, -ev) against the triangle: area + eu dv - ev du.
    return {area, area != 0 ? sign(area) : dv != 0 ? sign(dv) : -sign(du)};
}

/// Number of the lattice edge in which the depth sum w_i z_i / sum w_i lies; `tie` says
/// where the surface moves, when it is on a sample.
Int cell_of_depth(const std::array<Int, 3>& w, const std::array<Int, 3>& z, int tie) {
    const Int whole = w[0] + w[1] + w[2];
    const double depth = (static_cast<double>(w[0]) * static_cast<double>(z[0]) +
                          static_cast<double>(w[1]) * static_cast<double>(z[1]) +
                          static_cast<double>(w[2]) * static_cast<double>(z[2])) /
                         (static_cast<double>(whole) * static_cast<double>(kFine));
    if (std::abs(depth - std::round(depth)) > kNearSample)
        return static_cast<Int>(std::floor(depth));
    Wide up = Wide{w[0]} * z[0] + Wide{w[1]} * z[1] + Wide{w[2]} * z[2];
    Wide down = Wide{whole} * kFine;
    if (down < 0) up = -up, down = -down;
    const auto cell = static_cast<Int>(up / down);
    return up % down == 0 && tie < 0 ? cell - 1 : cell;
}

Int component(const std::array<Corner, 3>& p, int a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    return (p[1][b] - p[0][b]) * (p[2][c] - p[0][c]) - (p[1][c] - p[0][c]) * (p[2][b] - p[0][b]);
}

/// Which way the plane with this normal moves along `axis`: by the sum of
/// e_t n_t / n_axis, whose first term that is not zero decides.
int tie_of(const std::array<Int, 3>& normal, int axis) {
    for (int t = 0; t < axis; ++t)
        if (normal[t] != 0) return sign(normal[t]) * sign(normal[axis]);
    return 1;
}

}  // namespace

SnappedTriangle snap(const std::array<Vec3, 3>& corners) {
    SnappedTriangle t;
    for (int c = 0; c < 3; ++c)
        for (int a = 0; a < 3; ++a) {
            MYOTET_CHECK(corners[c][a] >= 0 && corners[c][a] < SnappedTriangle::kMost,
                         "a corner lies outside the lattice of exact numbers");
            t.corners[c][a] = std::llround(corners[c][a] * static_cast<double>(kFine));
        }
    return t;
}

void for_each_cut_edge(const SnappedTriangle& triangle, const Index3& first, const Index3& last,
                       const std::function<void(int, const Index3&)>& take) {
    const auto& p = triangle.corners;
    const std::array<Int, 3> normal{component(p, 0), component(p, 1), component(p, 2)};
    Index3 low, high;  // samples between the corners
    for (int a = 0; a < 3; ++a) {
        const auto [least, most] = std::minmax({p[0][a], p[1][a], p[2][a]});
        low[a] = std::max(first[a], static_cast<int>((least + kFine - 1) / kFine));
        high[a] = std::min(last[a], static_cast<int>(most / kFine));
    }
    for (int axis = 0; axis < 3; ++axis) {
        if (normal[axis] == 0) continue;
        const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2, tie = tie_of(normal, axis);
        Index3 at{};
        for (at[v] = low[v]; at[v] <= high[v]; ++at[v])
            for (at[u] = low[u]; at[u] <= high[u]; ++at[u]) {
                const Int pu = at[u] * kFine, pv = at[v] * kFine;
                const Side bc = side_of(p[1], p[2], pu, pv, u, v),
                           ca = side_of(p[2], p[0], pu, pv, u, v),
                           ab = side_of(p[0], p[1], pu, pv, u, v);
                if (bc.sign != ca.sign || ca.sign != ab.sign) continue;
                const Int cell = cell_of_depth({bc.area, ca.area, ab.area},
                                               {p[0][axis], p[1][axis], p[2][axis]}, tie);
                if (cell < first[axis] || cell > last[axis]) continue;
                at[axis] = static_cast<int>(cell);
                take(axis, at);
            }
    }
}

}  // namespace myotet::levelset
