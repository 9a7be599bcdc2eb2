// SPDX-License-Identifier: Apache-2.0
#include "Meshing/NodeEnergy.h"

#include <limits>

namespace myotet::meshing {
namespace {

// q of a regular tetrahedron of edge 1: S = 6, 6V = 1 / sqrt(2), S^3 / (6V)^2 = 432.
constexpr double kRegular = 1.0 / 432.0;

double power(double q, int m) {
    double result = 1;
    for (; m > 0; m >>= 1, q *= q)
        if (m & 1) result *= q;
    return result;
}

}  // namespace

double shape_energy(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double v = (b - a).cross(c - a).dot(d - a);
    if (!(v > 0)) return std::numeric_limits<double>::infinity();
    const double s = (b - a).squaredNorm() + (c - a).squaredNorm() + (d - a).squaredNorm() +
                     (c - b).squaredNorm() + (d - b).squaredNorm() + (d - c).squaredNorm();
    return kRegular * s * s * s / (v * v);
}

void StarEnergy::reset(std::size_t count) {
    for (auto* v : {&nx_, &ny_, &nz_, &d_, &sx_, &sy_, &sz_, &e_, &q_})
        if (v->size() < count) v->resize(count);
    count_ = 0;
}

void StarEnergy::add(const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 n = (q - p).cross(r - p), s = p + q + r;
    const std::size_t i = count_++;
    nx_[i] = n.x();
    ny_[i] = n.y();
    nz_[i] = n.z();
    d_[i] = n.dot(p);
    sx_[i] = s.x();
    sy_[i] = s.y();
    sz_[i] = s.z();
    e_[i] = p.squaredNorm() + q.squaredNorm() + r.squaredNorm() + (p - q).squaredNorm() +
            (q - r).squaredNorm() + (r - p).squaredNorm();
}

double StarEnergy::value(const Vec3& x, int m) const {
    const double x0 = x.x(), x1 = x.y(), x2 = x.z(), xx = 3 * x.squaredNorm();
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_; ++i) {
        const double v = nx_[i] * x0 + ny_[i] * x1 + nz_[i] * x2 - d_[i];
        const double s = xx - 2 * (sx_[i] * x0 + sy_[i] * x1 + sz_[i] * x2) + e_[i];
        lowest = v < lowest ? v : lowest;
        q_[i] = kRegular * s * s * s / (v * v);
    }
    if (!(lowest > 0)) return std::numeric_limits<double>::infinity();
    double sum = 0;
    for (std::size_t i = 0; i < count_; ++i) sum += power(q_[i], m);
    return sum < std::numeric_limits<double>::infinity()
               ? sum
               : std::numeric_limits<double>::infinity();  // not a number either
}

double StarEnergy::worst(const Vec3& x) const {
    if (!(value(x, 1) < std::numeric_limits<double>::infinity()))
        return std::numeric_limits<double>::infinity();
    double q = 0;
    for (std::size_t i = 0; i < count_; ++i) q = q_[i] > q ? q_[i] : q;
    return q;
}

Expansion StarEnergy::expand(const Vec3& x, int m) const {
    // With w = 3 S' / S - 2 V' / V (the gradient of ln q):
    //   (q^m)'  = m q^m w
    //   (q^m)'' = m q^m (m w w^T + 3 S''/S - 3 S' S'^T / S^2 + 2 V' V'^T / V^2)
    // and S' = 6 x - 2 s, S'' = 6 I, V' = n (V standing for 6V throughout).
    Expansion e;
    double diagonal = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        const Vec3 n(nx_[i], ny_[i], nz_[i]), sum(sx_[i], sy_[i], sz_[i]);
        const double v = n.dot(x) - d_[i];
        const double s = 3 * x.squaredNorm() - 2 * sum.dot(x) + e_[i];
        if (!(v > 0)) {
            e.value = std::numeric_limits<double>::infinity();
            return e;
        }
        const double q = kRegular * s * s * s / (v * v);
        const Vec3 a = (6 * x - 2 * sum) / s, b = n / v;
        const Vec3 w = 3 * a - 2 * b;
        const double p = power(q, m), c = m * p;
        e.value += p;
        e.gradient += c * w;
        diagonal += c * 18 / s;
        const Vec3 cw = c * m * w, ca = 3 * c * a, cb = 2 * c * b;
        e.hessian(0, 0) += cw[0] * w[0] - ca[0] * a[0] + cb[0] * b[0];
        e.hessian(1, 0) += cw[1] * w[0] - ca[1] * a[0] + cb[1] * b[0];
        e.hessian(2, 0) += cw[2] * w[0] - ca[2] * a[0] + cb[2] * b[0];
        e.hessian(1, 1) += cw[1] * w[1] - ca[1] * a[1] + cb[1] * b[1];
        e.hessian(2, 1) += cw[2] * w[1] - ca[2] * a[1] + cb[2] * b[1];
        e.hessian(2, 2) += cw[2] * w[2] - ca[2] * a[2] + cb[2] * b[2];
    }
    e.hessian(0, 1) = e.hessian(1, 0);
    e.hessian(0, 2) = e.hessian(2, 0);
    e.hessian(1, 2) = e.hessian(2, 1);
    e.hessian.diagonal().array() += diagonal;
    return e;
}

}  // namespace myotet::meshing
