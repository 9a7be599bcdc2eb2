// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "Core/Geometry.h"
#include "Skeleton/Model.h"

namespace myotet::skeleton {

/// A wrap object as the zero of a function that is negative inside, in the object's frame:
///     x^T D x - 1                    sphere, cylinder and ellipsoid, D diagonal
///     (|xy| - core)^2 + z^2 - tube^2  torus
class WrapSurface {
public:
    /// A torus whose hole has radius h and that measures w across from its middle has
    /// core = (h + w) / 2 and tube = (w - h) / 2. (A file's outer_radius is the core and its
    /// inner_radius the tube: so OpenSim wraps and draws them, whatever their names say.)
    explicit WrapSurface(const WrapObject& object);

    /// Half the gradient of the function: it points out.
    [[nodiscard]] Vec3 gradient(const Vec3& x) const;
    /// Half the second derivatives times a vector.
    [[nodiscard]] Vec3 bend(const Vec3& x, const Vec3& u) const;
    /// At a point of the surface, 1/mm^2.
    [[nodiscard]] double gauss_curvature(const Vec3& x, const Vec3& gradient) const;

    [[nodiscard]] Vec3 normal(const Vec3& x) const { return gradient(x).normalized(); }
    /// How the unit normal turns when the point moves by u in the surface.
    [[nodiscard]] Vec3 normal_rate(const Vec3& x, const Vec3& u) const;

    /// Distance from the surface to first order, exact near it, negative inside, mm.
    [[nodiscard]] double height(const Vec3& x) const;
    /// The point of the surface that x is above or below, for x near it.
    [[nodiscard]] Vec3 settle(Vec3 x) const;

    [[nodiscard]] bool is_torus() const { return torus_; }
    [[nodiscard]] double core() const { return core_; }
    [[nodiscard]] double tube() const { return tube_; }
    /// The longest of its half axes, mm; of a cylinder its radius, of a torus its tube's.
    [[nodiscard]] double size() const { return size_; }
    /// Half axes; those without end are infinite.
    [[nodiscard]] const Vec3& half_axes() const { return half_axes_; }

private:
    bool torus_ = false;
    double core_ = 0, tube_ = 0, size_ = 0;
    Vec3 half_axes_ = Vec3::Zero(), diagonal_ = Vec3::Zero();
};

inline Vec3 WrapSurface::gradient(const Vec3& x) const {
    if (!torus_) return diagonal_.cwiseProduct(x);
    const double shrink = 1 - core_ / std::sqrt(x[0] * x[0] + x[1] * x[1]);
    return {shrink * x[0], shrink * x[1], x[2]};
}

inline Vec3 WrapSurface::bend(const Vec3& x, const Vec3& u) const {
    if (!torus_) return diagonal_.cwiseProduct(u);
    // Around the axis by 1 - core / |xy|, else by 1.
    const double square = x[0] * x[0] + x[1] * x[1];
    const double around = core_ * (x[0] * u[1] - x[1] * u[0]) / (square * std::sqrt(square));
    return {u[0] + around * x[1], u[1] - around * x[0], u[2]};
}

inline double WrapSurface::gauss_curvature(const Vec3& x, const Vec3& g) const {
    const double square = g.squaredNorm();
    if (torus_) return (1 - core_ / std::sqrt(x[0] * x[0] + x[1] * x[1])) / square;
    // g^T adj(D) g / |g|^4
    const Vec3& d = diagonal_;
    return (g[0] * g[0] * d[1] * d[2] + g[1] * g[1] * d[0] * d[2] + g[2] * g[2] * d[0] * d[1]) /
           (square * square);
}

}  // namespace myotet::skeleton
