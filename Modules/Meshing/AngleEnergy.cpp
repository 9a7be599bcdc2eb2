// SPDX-License-Identifier: Apache-2.0
#include "Meshing/AngleEnergy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "Core/Wide.h"

namespace myotet::meshing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The goal: t0 = tan^2 (116 / 2 degrees), 1 / t1 = tan^2 (28 / 2 degrees).
constexpr double kObtuse = 2.56107, kAcute = 1 / 0.0621645;
// At the goal a term is as large as q^8 of an aspect ratio of about 3.
constexpr double kAtGoal = 3;
constexpr double kRegular = 1.0 / 432.0;

// Tetrahedra worked on at once; sums are kept by lane, in a fixed order.
constexpr std::size_t kLanes = 4;
using Lane = double __attribute__((vector_size(kLanes * sizeof(double))));

#define MYOTET_INLINE inline __attribute__((always_inline))

// A table's rows: corners p, q, r, and 1, or 0 for padding.
enum Row : std::size_t { kP, kQ = 3, kR = 6, kWeight = 9, kRows };

struct Point {
    Lane x, y, z;
};
MYOTET_INLINE Point operator-(const Point& a, const Point& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
MYOTET_INLINE Point operator+(const Point& a, const Point& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
MYOTET_INLINE Point operator*(const Lane& s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }
MYOTET_INLINE Lane dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
MYOTET_INLINE Point cross(const Point& a, const Point& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
MYOTET_INLINE Lane power8(Lane a) {
    a *= a;
    a *= a;
    return a * a;
}
MYOTET_INLINE Lane root(const Lane& a) {
    Lane r;
    for (std::size_t l = 0; l < kLanes; ++l) r[l] = std::sqrt(a[l]);
    return r;
}
MYOTET_INLINE Lane load(const double* at) {
    Lane r;
    for (std::size_t l = 0; l < kLanes; ++l) r[l] = at[l];
    return r;
}
MYOTET_INLINE Point load_point(const double* at, std::size_t stride) {
    return {load(at), load(at + stride), load(at + 2 * stride)};
}
MYOTET_INLINE Lane all(double a) { return Lane{a, a, a, a}; }

// What value and expansion share. Outward doubled area vectors n of the faces opposite
// x, p, q, r; edges from x first, then those opposite to them.
struct Shape {
    Point u, v, w, n[4], d[4];
    Lane volume, area[4], area2[4], edge2[6];
};

MYOTET_INLINE void find_shape(const double* at, std::size_t stride, const double* x, Shape& s) {
    const Point c{all(x[0]), all(x[1]), all(x[2])};
    const Point p = load_point(at + kP * stride, stride), q = load_point(at + kQ * stride, stride),
                r = load_point(at + kR * stride, stride);
    s.u = p - c;
    s.v = q - c;
    s.w = r - c;
    s.n[1] = cross(s.v, s.w);
    s.n[2] = cross(s.w, s.u);
    s.n[3] = cross(s.u, s.v);
    s.n[0] = all(-1) * (s.n[1] + s.n[2] + s.n[3]);
    s.d[1] = q - r;
    s.d[2] = r - p;
    s.d[3] = p - q;
    s.volume = all(0) - dot(s.u, s.n[1]);
    for (int i = 0; i < 4; ++i) {
        s.area2[i] = dot(s.n[i], s.n[i]);
        s.area[i] = root(s.area2[i]);
    }
    s.edge2[0] = dot(s.u, s.u);
    s.edge2[1] = dot(s.v, s.v);
    s.edge2[2] = dot(s.w, s.w);
    for (int i = 1; i < 4; ++i) s.edge2[2 + i] = dot(s.d[i], s.d[i]);
}

// The terms of the aspect ratio and of q, and what they are made of.
struct Whole {
    Lane edges8, areas8, edges, aspect, q8;
};
MYOTET_INLINE void find_whole(const Shape& s, double per_aspect, Whole& w) {
    w.edges8 = w.areas8 = w.edges = all(0);
    for (const Lane& e : s.edge2) {
        w.edges += e;
        w.edges8 += power8(e);
    }
    for (const Lane& a : s.area2) w.areas8 += power8(a);
    const Lane volume2 = s.volume * s.volume;
    w.aspect = w.edges8 * w.areas8 / power8(volume2 * (1 / (kAtGoal * per_aspect)));
    w.q8 = power8(kRegular * w.edges * w.edges * w.edges / volume2);
}

// The terms of the angle between faces i and j: cos = -(n_i . n_j) / (|n_i| |n_j|).
struct Angle {
    Lane product, sum, difference;  // |n_i| |n_j|, and that plus and minus n_i . n_j
    Lane obtuse, acute;
};
MYOTET_INLINE void find_angle(const Shape& s, int i, int j, Angle& a) {
    const Lane inner = dot(s.n[i], s.n[j]);
    a.product = s.area[i] * s.area[j];
    a.sum = a.product + inner;
    a.difference = a.product - inner;
    a.obtuse = power8(a.sum / a.difference * (kAtGoal / kObtuse));
    a.acute = power8(a.difference / a.sum * (kAtGoal / kAcute));
}

MYOTET_INLINE Lane lesser(const Lane& a, const Lane& b) { return a < b ? a : b; }

MYOTET_WIDE void sum_values(const double* rows, std::size_t stride, const double* x,
                            double per_aspect, double* sum, double* lowest) {
    Lane total = all(0), least = all(kInfinity);
    for (std::size_t i = 0; i < stride; i += kLanes) {
        Shape s;
        Whole w;
        find_shape(rows + i, stride, x, s);
        find_whole(s, per_aspect, w);
        Lane value = w.aspect + w.q8;
        for (int f = 0; f < 4; ++f)
            for (int g = f + 1; g < 4; ++g) {
                Angle a;
                find_angle(s, f, g, a);
                value += a.obtuse + a.acute;
            }
        total += load(rows + kWeight * stride + i) * value;
        least = lesser(s.volume, least);
    }
    for (std::size_t l = 0; l < kLanes; ++l) {
        sum[l] = total[l];
        lowest[l] = least[l];
    }
}

// Lanes of an expansion: value, gradient, Hessian xx, xy, xz, yy, yz, zz, lowest volume.
struct Sums {
    Lane value, g[3], h[6], lowest;
};

// Adds weight c and the rank-one term k g g^T.
MYOTET_INLINE void add_square(const Lane& k, const Point& g, Sums& out) {
    const Lane x = k * g.x, y = k * g.y, z = k * g.z;
    out.h[0] += x * g.x;
    out.h[1] += x * g.y;
    out.h[2] += x * g.z;
    out.h[3] += y * g.y;
    out.h[4] += y * g.z;
    out.h[5] += z * g.z;
}
MYOTET_INLINE void add_gradient(const Lane& c, const Point& g, Sums& out) {
    out.g[0] += c * g.x;
    out.g[1] += c * g.y;
    out.g[2] += c * g.z;
}

// For a term b^8: (b^8)' = 8 b^8 (ln b)', (b^8)'' ~ 64 b^8 (ln b)' (ln b)'^T.
MYOTET_INLINE void add_angles(const Shape& s, const Lane& weight, Sums& out) {
    // (ln |n_i|)' = d_i x n_i / |n_i|^2, for (G . n_i)' = d_i x G.
    Point log_area[4];
    for (int i = 1; i < 4; ++i) log_area[i] = (1 / s.area2[i]) * cross(s.d[i], s.n[i]);
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j) {
            Angle a;
            find_angle(s, i, j, a);
            out.value += weight * (a.obtuse + a.acute);
            // (ln t)' = -2 cos' / sin^2, cos' = -(n_i . n_j)' / product - cos (ln product)'.
            const Lane inner = all(0.5) * (a.sum - a.difference);
            Point slope = cross(s.d[j], s.n[i]), log_product = log_area[j];
            if (i > 0) {
                slope = slope + cross(s.d[i], s.n[j]);
                log_product = log_product + log_area[i];
            }
            const Lane per_sine2 = a.product / (a.sum * a.difference);  // / product
            const Point g = (2 * per_sine2) * (slope - inner * log_product);
            add_gradient(8 * weight * (a.obtuse - a.acute), g, out);
            add_square(64 * weight * (a.obtuse + a.acute), g, out);
        }
}

MYOTET_INLINE void add_whole(const Shape& s, double per_aspect, const Lane& weight, Sums& out) {
    Whole w;
    find_whole(s, per_aspect, w);
    const Lane per_volume = 1 / s.volume;
    const Point log_volume = (all(0) - per_volume) * s.n[0];
    // b^8 = edges8 areas8 / ..., (ln b^8)' = edges8' / edges8 + areas8' / areas8 - 16 V' / V.
    const Lane e0 = power8(s.edge2[0]) / s.edge2[0], e1 = power8(s.edge2[1]) / s.edge2[1],
               e2 = power8(s.edge2[2]) / s.edge2[2];
    Point areas = (power8(s.area2[1]) / s.area2[1]) * cross(s.d[1], s.n[1]);
    for (int i = 2; i < 4; ++i)
        areas = areas + (power8(s.area2[i]) / s.area2[i]) * cross(s.d[i], s.n[i]);
    const Point g = (-16 / w.edges8) * (e0 * s.u + e1 * s.v + e2 * s.w) + (16 / w.areas8) * areas -
                    all(16) * log_volume;
    add_gradient(weight * w.aspect, g, out);
    add_square(weight * w.aspect, g, out);
    // q as in NodeEnergy.cpp.
    const Lane per_edges = 1 / w.edges, c = 8 * weight * w.q8;
    const Point a = (-2 * per_edges) * (s.u + s.v + s.w);
    const Point log_q = all(3) * a - all(2) * log_volume;
    out.value += weight * (w.aspect + w.q8);
    add_gradient(c, log_q, out);
    add_square(8 * c, log_q, out);
    add_square(-3 * c, a, out);
    add_square(2 * c, log_volume, out);
    const Lane diagonal = 18 * c * per_edges;
    out.h[0] += diagonal;
    out.h[3] += diagonal;
    out.h[5] += diagonal;
}

MYOTET_WIDE void sum_expansions(const double* rows, std::size_t stride, const double* x,
                                double per_aspect, Sums& out) {
    for (std::size_t i = 0; i < stride; i += kLanes) {
        Shape s;
        find_shape(rows + i, stride, x, s);
        const Lane weight = load(rows + kWeight * stride + i);
        add_angles(s, weight, out);
        add_whole(s, per_aspect, weight, out);
        out.lowest = lesser(s.volume, out.lowest);
    }
}

double lane_sum(const Lane& a) { return (a[0] + a[1]) + (a[2] + a[3]); }

}  // namespace

void AngleEnergy::reset(std::size_t count, double aspect_ratio) {
    per_aspect_ = 1 / (aspect_ratio * aspect_ratio);
    stride_ = (count + kLanes - 1) / kLanes * kLanes;
    if (rows_.size() < kRows * stride_) rows_.resize(kRows * stride_);
    count_ = 0;
}

void AngleEnergy::add(const Vec3& p, const Vec3& q, const Vec3& r) {
    const auto put = [&](std::size_t at, double weight) {
        const double row[kRows] = {p.x(), p.y(), p.z(), q.x(), q.y(),
                                   q.z(), r.x(), r.y(), r.z(), weight};
        for (std::size_t k = 0; k < kRows; ++k) rows_[k * stride_ + at] = row[k];
    };
    put(count_++, 1);
    // Padding repeats the last tetrahedron and weighs nothing.
    for (std::size_t at = count_; at % kLanes != 0; ++at) put(at, 0);
}

double AngleEnergy::value(const Vec3& x) const {
    double sum[kLanes], lowest[kLanes];
    sum_values(rows_.data(), stride_, x.data(), per_aspect_, sum, lowest);
    if (!(*std::min_element(lowest, lowest + kLanes) > 0)) return kInfinity;
    const double total = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    return total < kInfinity ? total : kInfinity;  // not a number either
}

Expansion AngleEnergy::expand(const Vec3& x) const {
    Sums s{};
    s.lowest = all(kInfinity);
    sum_expansions(rows_.data(), stride_, x.data(), per_aspect_, s);
    Expansion e;
    e.value = lane_sum(s.value);
    const double lowest =
        std::min(std::min(s.lowest[0], s.lowest[1]), std::min(s.lowest[2], s.lowest[3]));
    if (!(lowest > 0) || !(e.value < kInfinity)) {
        e.value = kInfinity;
        return e;
    }
    e.gradient = {lane_sum(s.g[0]), lane_sum(s.g[1]), lane_sum(s.g[2])};
    const double xx = lane_sum(s.h[0]), xy = lane_sum(s.h[1]), xz = lane_sum(s.h[2]),
                 yy = lane_sum(s.h[3]), yz = lane_sum(s.h[4]), zz = lane_sum(s.h[5]);
    e.hessian << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return e;
}

Badness::Badness(const ShapeGoal& goal) {
    const auto squared_tangent = [](double angle_deg) {
        const double t = std::tan(0.5 * angle_deg * std::numbers::pi / 180);
        return t * t;
    };
    per_obtuse_ = 1 / squared_tangent(goal.max_dihedral_deg);
    acute_ = squared_tangent(goal.min_dihedral_deg);
    per_aspect_ = 1 / (goal.max_aspect_ratio * goal.max_aspect_ratio);
}

double Badness::operator()(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) const {
    const Vec3 u = b - a, v = c - a, w = d - a;
    const Vec3 n[4] = {(c - b).cross(d - b), w.cross(v), u.cross(w), v.cross(u)};
    const double volume = u.cross(v).dot(w);
    if (!(volume > 0)) return kInfinity;
    double length[4], worst = 0, edges8 = 0, areas8 = 0;
    const auto power8 = [](double x) { return (x * x) * (x * x) * ((x * x) * (x * x)); };
    for (int i = 0; i < 4; ++i) {
        length[i] = n[i].norm();
        areas8 += power8(length[i] * length[i]);
    }
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j) {
            const double product = length[i] * length[j], inner = n[i].dot(n[j]);
            const double t = (product + inner) / (product - inner);
            worst = std::max({worst, t * per_obtuse_, acute_ / t});
        }
    for (const double e : {u.squaredNorm(), v.squaredNorm(), w.squaredNorm(), (c - b).squaredNorm(),
                           (d - b).squaredNorm(), (d - c).squaredNorm()})
        edges8 += power8(e);
    return std::max(worst, std::pow(edges8 * areas8, 1.0 / 8) / (volume * volume) * per_aspect_);
}

}  // namespace myotet::meshing
