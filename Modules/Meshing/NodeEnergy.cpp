// SPDX-License-Identifier: Apache-2.0
#include "Meshing/NodeEnergy.h"

#include <algorithm>
#include <limits>

#include "Core/Wide.h"

namespace myotet::meshing {
namespace {

// q of a regular tetrahedron of edge 1: S = 6, 6V = 1 / sqrt(2), S^3 / (6V)^2 = 432.
constexpr double kRegular = 1.0 / 432.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Rows of a star's table, one entry a tetrahedron: 6V = n . x - d,
// S = 3 |x|^2 - 2 s . x + e, and 1, or 0 for padding.
enum Row : std::size_t { kNx, kNy, kNz, kD, kSx, kSy, kSz, kE, kWeight, kRows };
// Tetrahedra worked on at once; sums are kept by lane, in a fixed order.
constexpr std::size_t kLanes = 4;

}  // namespace

double shape_energy(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double v = (b - a).cross(c - a).dot(d - a);
    if (!(v > 0)) return kInfinity;
    const double s = (b - a).squaredNorm() + (c - a).squaredNorm() + (d - a).squaredNorm() +
                     (c - b).squaredNorm() + (d - b).squaredNorm() + (d - c).squaredNorm();
    return kRegular * s * s * s / (v * v);
}

void StarEnergy::reset(std::size_t count) {
    const std::size_t padded = (count + kLanes - 1) / kLanes * kLanes;
    if (rows_.size() < kRows * padded) rows_.resize(kRows * padded);
    stride_ = padded;
    count_ = 0;
    // Padding: far tetrahedra of volume 1 that weigh nothing.
    for (std::size_t i = count; i < padded; ++i) {
        for (std::size_t row = 0; row < kRows; ++row) rows_[row * stride_ + i] = 0;
        rows_[kD * stride_ + i] = -1;
        rows_[kE * stride_ + i] = 1;
    }
}

void StarEnergy::add(const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 n = (q - p).cross(r - p), s = p + q + r;
    double* at = rows_.data() + count_++;
    at[kNx * stride_] = n.x();
    at[kNy * stride_] = n.y();
    at[kNz * stride_] = n.z();
    at[kD * stride_] = n.dot(p);
    at[kSx * stride_] = s.x();
    at[kSy * stride_] = s.y();
    at[kSz * stride_] = s.z();
    at[kE * stride_] = p.squaredNorm() + q.squaredNorm() + r.squaredNorm() + (p - q).squaredNorm() +
                       (q - r).squaredNorm() + (r - p).squaredNorm();
    at[kWeight * stride_] = 1;
}

namespace {

// Adds up q^m lane by lane; `lowest` receives the smallest 6V of each lane.
MYOTET_WIDE void sum_powers(const double* rows, std::size_t stride, const double* x, int m,
                            double* sum, double* lowest) {
    const double xx = 3 * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (std::size_t i = 0; i < stride; i += kLanes) {
        const double* at = rows + i;
        double q[kLanes], v[kLanes];
        for (std::size_t l = 0; l < kLanes; ++l) {
            v[l] = at[kNx * stride + l] * x[0] + at[kNy * stride + l] * x[1] +
                   at[kNz * stride + l] * x[2] - at[kD * stride + l];
            const double s = xx -
                             2 * (at[kSx * stride + l] * x[0] + at[kSy * stride + l] * x[1] +
                                  at[kSz * stride + l] * x[2]) +
                             at[kE * stride + l];
            q[l] = kRegular * s * s * s / (v[l] * v[l]);
        }
        for (int k = m; k > 1; k >>= 1)
            for (std::size_t l = 0; l < kLanes; ++l) q[l] *= q[l];
        for (std::size_t l = 0; l < kLanes; ++l) {
            sum[l] += at[kWeight * stride + l] * q[l];
            lowest[l] = v[l] < lowest[l] ? v[l] : lowest[l];
        }
    }
}

// With w = 3 S' / S - 2 V' / V (the gradient of ln q):
//   (q^m)'  = m q^m w
//   (q^m)'' = m q^m (m w w^T + 3 S''/S - 3 S' S'^T / S^2 + 2 V' V'^T / V^2)
// and S' = 6 x - 2 s, S'' = 6 I, V' = n (V standing for 6V throughout).
// Lanes of `out`: value, gradient (3), Hessian xx, xy, xz, yy, yz, zz, lowest V.
MYOTET_WIDE void sum_expansions(const double* rows, std::size_t stride, const double* x, int m,
                                double (*out)[kLanes]) {
    const double xx = 3 * (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (std::size_t i = 0; i < stride; i += kLanes) {
        const double* at = rows + i;
        double q[kLanes], s[kLanes], v[kLanes];
        for (std::size_t l = 0; l < kLanes; ++l) {
            v[l] = at[kNx * stride + l] * x[0] + at[kNy * stride + l] * x[1] +
                   at[kNz * stride + l] * x[2] - at[kD * stride + l];
            s[l] = xx -
                   2 * (at[kSx * stride + l] * x[0] + at[kSy * stride + l] * x[1] +
                        at[kSz * stride + l] * x[2]) +
                   at[kE * stride + l];
            q[l] = kRegular * s[l] * s[l] * s[l] / (v[l] * v[l]);
        }
        for (int k = m; k > 1; k >>= 1)
            for (std::size_t l = 0; l < kLanes; ++l) q[l] *= q[l];
        for (std::size_t l = 0; l < kLanes; ++l) {
            const double p = at[kWeight * stride + l] * q[l], c = m * p;
            const double per_s = 1 / s[l], per_v = 1 / v[l];
            const double a0 = (6 * x[0] - 2 * at[kSx * stride + l]) * per_s,
                         a1 = (6 * x[1] - 2 * at[kSy * stride + l]) * per_s,
                         a2 = (6 * x[2] - 2 * at[kSz * stride + l]) * per_s;
            const double b0 = at[kNx * stride + l] * per_v, b1 = at[kNy * stride + l] * per_v,
                         b2 = at[kNz * stride + l] * per_v;
            const double w0 = 3 * a0 - 2 * b0, w1 = 3 * a1 - 2 * b1, w2 = 3 * a2 - 2 * b2;
            const double cm = c * m, ca = 3 * c, cb = 2 * c, diagonal = c * 18 * per_s;
            out[0][l] += p;
            out[1][l] += c * w0;
            out[2][l] += c * w1;
            out[3][l] += c * w2;
            out[4][l] += cm * w0 * w0 - ca * a0 * a0 + cb * b0 * b0 + diagonal;
            out[5][l] += cm * w0 * w1 - ca * a0 * a1 + cb * b0 * b1;
            out[6][l] += cm * w0 * w2 - ca * a0 * a2 + cb * b0 * b2;
            out[7][l] += cm * w1 * w1 - ca * a1 * a1 + cb * b1 * b1 + diagonal;
            out[8][l] += cm * w1 * w2 - ca * a1 * a2 + cb * b1 * b2;
            out[9][l] += cm * w2 * w2 - ca * a2 * a2 + cb * b2 * b2 + diagonal;
            out[10][l] = v[l] < out[10][l] ? v[l] : out[10][l];
        }
    }
}

double lane_sum(const double* lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }
double lane_min(const double* lanes) { return *std::min_element(lanes, lanes + kLanes); }

}  // namespace

double StarEnergy::value(const Vec3& x, int m) const {
    double sum[kLanes] = {};
    double lowest[kLanes];
    std::fill(lowest, lowest + kLanes, kInfinity);
    sum_powers(rows_.data(), stride_, x.data(), m, sum, lowest);
    if (!(lane_min(lowest) > 0)) return kInfinity;
    const double total = lane_sum(sum);
    return total < kInfinity ? total : kInfinity;  // not a number either
}

Expansion StarEnergy::expand(const Vec3& x, int m) const {
    double out[11][kLanes] = {};
    std::fill(out[10], out[10] + kLanes, kInfinity);
    sum_expansions(rows_.data(), stride_, x.data(), m, out);
    Expansion e;
    e.value = lane_sum(out[0]);
    if (!(lane_min(out[10]) > 0) || !(e.value < kInfinity)) {
        e.value = kInfinity;
        return e;
    }
    e.gradient = {lane_sum(out[1]), lane_sum(out[2]), lane_sum(out[3])};
    const double xx = lane_sum(out[4]), xy = lane_sum(out[5]), xz = lane_sum(out[6]),
                 yy = lane_sum(out[7]), yz = lane_sum(out[8]), zz = lane_sum(out[9]);
    e.hessian << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return e;
}

}  // namespace myotet::meshing
