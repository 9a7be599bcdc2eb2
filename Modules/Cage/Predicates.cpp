// SPDX-License-Identifier: Apache-2.0
// Compiled without contraction of products and sums (CMakeLists.txt): the bounds hold for
// operations that are rounded one by one.
#include "Cage/Predicates.h"

#include <cmath>
#include <limits>

namespace myotet::cage {
namespace {

/// A sum of doubles that do not overlap, the smallest first; no zeros among them.
template <int N>
struct Expansion {
    std::array<double, N> term;
    int size = 0;
    void push(double t) {
        if (t != 0) term[size++] = t;
    }
    [[nodiscard]] int sign() const { return size == 0 ? 0 : term[size - 1] > 0 ? 1 : -1; }
};

// a + b = sum + error, exactly.
void two_sum(double a, double b, double& sum, double& error) {
    sum = a + b;
    const double b_part = sum - a, a_part = sum - b_part;
    error = (a - a_part) + (b - b_part);
}

Expansion<2> difference(double a, double b) {
    double sum = 0, error = 0;
    two_sum(a, -b, sum, error);
    Expansion<2> d;
    d.push(error);
    d.push(sum);
    return d;
}

// Adds one double to an expansion: Grow-Expansion.
template <int N>
void grow(Expansion<N>& e, double b) {
    double q = b;
    int kept = 0;
    for (int i = 0; i < e.size; ++i) {
        double error = 0;
        two_sum(q, e.term[i], q, error);
        if (error != 0) e.term[kept++] = error;
    }
    e.size = kept;
    e.push(q);
}

template <int N, int M>
Expansion<N + M> sum(const Expansion<N>& a, const Expansion<M>& b, double factor = 1) {
    Expansion<N + M> s;
    for (int i = 0; i < a.size; ++i) s.push(a.term[i]);
    for (int i = 0; i < b.size; ++i) grow(s, factor * b.term[i]);
    return s;
}

template <int N, int M>
Expansion<2 * N * M> product(const Expansion<N>& a, const Expansion<M>& b) {
    Expansion<2 * N * M> p;
    for (int i = 0; i < a.size; ++i)
        for (int j = 0; j < b.size; ++j) {
            const double high = a.term[i] * b.term[j];
            grow(p, std::fma(a.term[i], b.term[j], -high));
            grow(p, high);
        }
    return p;
}

// a d - b c.
Expansion<16> determinant(const Expansion<2>& a, const Expansion<2>& b, const Expansion<2>& c,
                          const Expansion<2>& d) {
    return sum(product(a, d), product(b, c), -1);
}

int exact_orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    std::array<Expansion<2>, 3> u, v, w;
    for (int i = 0; i < 3; ++i) {
        u[i] = difference(b[i], a[i]);
        v[i] = difference(c[i], a[i]);
        w[i] = difference(d[i], a[i]);
    }
    const auto x = product(determinant(u[1], u[2], v[1], v[2]), w[0]);
    const auto y = product(determinant(u[2], u[0], v[2], v[0]), w[1]);
    const auto z = product(determinant(u[0], u[1], v[0], v[1]), w[2]);
    return sum(sum(x, y), z).sign();
}

constexpr double kHalfUlp = std::numeric_limits<double>::epsilon() / 2;
// [Shewchuk 1997, sec. 4.3 and 4.2]; differences are taken to the first point.
constexpr double kBound3d = (7 + 56 * kHalfUlp) * kHalfUlp;
constexpr double kBound2d = (3 + 16 * kHalfUlp) * kHalfUlp;

bool alike(int a, int b, int c) {
    return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

// Of four points in one plane, seen along an axis: whether c lies in the box of p and q.
bool between(int axis, const Vec3& p, const Vec3& q, const Vec3& c) {
    for (int i = 1; i < 3; ++i) {
        const int k = (axis + i) % 3;
        if (c[k] < std::min(p[k], q[k]) || c[k] > std::max(p[k], q[k])) return false;
    }
    return true;
}

bool segments_meet(int axis, const std::array<Vec3, 2>& s, const std::array<Vec3, 2>& t) {
    const int s0 = orient2d(axis, s[0], s[1], t[0]), s1 = orient2d(axis, s[0], s[1], t[1]);
    const int t0 = orient2d(axis, t[0], t[1], s[0]), t1 = orient2d(axis, t[0], t[1], s[1]);
    if (s0 * s1 < 0 && t0 * t1 < 0) return true;
    return (s0 == 0 && between(axis, s[0], s[1], t[0])) ||
           (s1 == 0 && between(axis, s[0], s[1], t[1])) ||
           (t0 == 0 && between(axis, t[0], t[1], s[0])) ||
           (t1 == 0 && between(axis, t[0], t[1], s[1]));
}

// A segment in the plane of a triangle that is not flat.
bool meets_in_plane(const Vec3& p, const Vec3& q, const Corners3& t) {
    int axis = 0;
    while (axis < 2 && orient2d(axis, t[0], t[1], t[2]) == 0) ++axis;
    if (alike(orient2d(axis, t[0], t[1], p), orient2d(axis, t[1], t[2], p),
              orient2d(axis, t[2], t[0], p)))
        return true;
    for (int i = 0; i < 3; ++i)
        if (segments_meet(axis, {p, q}, {t[i], t[(i + 1) % 3]})) return true;
    return false;
}

// As segment_meets, where the sides of the ends are known.
bool meets_from(const Vec3& p, int side_p, const Vec3& q, int side_q, const Corners3& t) {
    if (side_p * side_q > 0) return false;
    if (side_p == 0 && side_q == 0) return meets_in_plane(p, q, t);
    return alike(orient3d(p, q, t[0], t[1]), orient3d(p, q, t[1], t[2]),
                 orient3d(p, q, t[2], t[0]));
}

std::array<int, 3> sides(const Corners3& of, const Corners3& t) {
    return {orient3d(of[0], of[1], of[2], t[0]), orient3d(of[0], of[1], of[2], t[1]),
            orient3d(of[0], of[1], of[2], t[2])};
}

bool all_beyond(const std::array<int, 3>& side) {
    return side[0] != 0 && side[0] == side[1] && side[1] == side[2];
}

}  // namespace

int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const double wx = d[0] - a[0], wy = d[1] - a[1], wz = d[2] - a[2];
    const double yz = uy * vz, zy = uz * vy, zx = uz * vx, xz = ux * vz, xy = ux * vy, yx = uy * vx;
    const double det = (yz - zy) * wx + (zx - xz) * wy + (xy - yx) * wz;
    const double size = (std::abs(yz) + std::abs(zy)) * std::abs(wx) +
                        (std::abs(zx) + std::abs(xz)) * std::abs(wy) +
                        (std::abs(xy) + std::abs(yx)) * std::abs(wz);
    if (det > kBound3d * size) return 1;
    if (det < -kBound3d * size) return -1;
    return exact_orient3d(a, b, c, d);
}

int orient2d(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    const double left = (b[x] - a[x]) * (c[y] - a[y]), right = (b[y] - a[y]) * (c[x] - a[x]);
    const double det = left - right, bound = kBound2d * (std::abs(left) + std::abs(right));
    if (det > bound) return 1;
    if (det < -bound) return -1;
    return determinant(difference(b[x], a[x]), difference(b[y], a[y]), difference(c[x], a[x]),
                       difference(c[y], a[y]))
        .sign();
}

bool flat(const Corners3& t) {
    for (int axis = 0; axis < 3; ++axis)
        if (orient2d(axis, t[0], t[1], t[2]) != 0) return false;
    return true;
}

bool segment_meets(const Vec3& p, const Vec3& q, const Corners3& t) {
    return meets_from(p, orient3d(t[0], t[1], t[2], p), q, orient3d(t[0], t[1], t[2], q), t);
}

bool triangles_meet(const Corners3& s, const Corners3& t) {
    // Two triangles that meet do so along an edge of one of them. Sides of a flat triangle
    // are all 0, but its edges belong to its neighbours too and are tested from here.
    const std::array<int, 3> of_t = sides(s, t);
    if (all_beyond(of_t)) return false;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (meets_from(t[i], of_t[i], t[j], of_t[j], s)) return true;
    }
    if (flat(t)) return false;
    const std::array<int, 3> of_s = sides(t, s);
    if (all_beyond(of_s)) return false;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (meets_from(s[i], of_s[i], s[j], of_s[j], t)) return true;
    }
    return false;
}

bool holds(const Corners4& tet, const Vec3& p) {
    for (int f = 0; f < 4; ++f) {
        const Triangle n = face_of({0, 1, 2, 3}, f);
        if (orient3d(tet[n[0]], tet[n[1]], tet[n[2]], p) > 0) return false;
    }
    return true;
}

bool meets(const Corners4& tet, const Corners3& t) {
    std::array<bool, 3> in{true, true, true};
    std::array<Corners3, 4> face;
    for (int f = 0; f < 4; ++f) {
        const Triangle n = face_of({0, 1, 2, 3}, f);
        face[f] = {tet[n[0]], tet[n[1]], tet[n[2]]};
        const std::array<int, 3> side = sides(face[f], t);
        if (side[0] > 0 && side[1] > 0 && side[2] > 0) return false;
        for (int i = 0; i < 3; ++i) in[i] = in[i] && side[i] <= 0;
    }
    if (in[0] || in[1] || in[2]) return true;
    for (const Corners3& f : face)
        if (triangles_meet(f, t)) return true;
    return false;
}

int passes(const Vec3& p, const Vec3& q, const Corners3& t, bool& doubtful) {
    const int at_p = orient3d(t[0], t[1], t[2], p), at_q = orient3d(t[0], t[1], t[2], q);
    if (at_p * at_q > 0) return 0;
    const int ab = orient3d(p, q, t[0], t[1]), bc = orient3d(p, q, t[1], t[2]),
              ca = orient3d(p, q, t[2], t[0]);
    if (!alike(ab, bc, ca)) return 0;
    if (at_p == 0 || at_q == 0 || ab == 0 || bc == 0 || ca == 0) {
        doubtful = true;
        return 0;
    }
    return at_p > 0 ? 1 : -1;
}

}  // namespace myotet::cage
