// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/WrapSurface.h"

#include <algorithm>
#include <limits>

#include "Core/Errors.h"

namespace myotet::skeleton {
namespace {

constexpr int kSettling = 30;
constexpr double kSettled = 1e-9;  // of the surface's size
constexpr double kEndless = std::numeric_limits<double>::infinity();

Vec3 half_axes_of(const WrapObject& object) {
    const auto& size = object.size;
    switch (object.shape) {
        case WrapShape::sphere:
            return Vec3::Constant(size[0]);
        case WrapShape::cylinder:
            return {size[0], size[0], kEndless};
        case WrapShape::ellipsoid:
            return {size[0], size[1], size[2]};
        case WrapShape::torus:
            break;
    }
    return {size[1], size[1], 0.5 * (size[1] - size[0])};
}

}  // namespace

WrapSurface::WrapSurface(const WrapObject& object)
    : torus_(object.shape == WrapShape::torus), half_axes_(half_axes_of(object)) {
    if (!(half_axes_.minCoeff() > 0) || (torus_ && !(object.size[0] > 0)))
        throw InputError("wrap object " + object.name +
                         " has a size that is not positive, or a hole larger than the whole");
    diagonal_ = half_axes_.cwiseAbs2().cwiseInverse();
    core_ = torus_ ? 0.5 * (object.size[0] + object.size[1]) : 0;
    tube_ = torus_ ? half_axes_[2] : 0;
    size_ = torus_ ? tube_ : 0;
    for (int i = 0; i < 3 && !torus_; ++i)
        if (half_axes_[i] < kEndless) size_ = std::max(size_, half_axes_[i]);
}

Vec3 WrapSurface::normal_rate(const Vec3& x, const Vec3& u) const {
    const Vec3 g = gradient(x), turned = bend(x, u);
    const double square = g.squaredNorm();
    return (turned - g * (g.dot(turned) / square)) / std::sqrt(square);
}

double WrapSurface::height(const Vec3& x) const {
    if (torus_) return std::hypot(std::sqrt(x[0] * x[0] + x[1] * x[1]) - core_, x[2]) - tube_;
    const Vec3 g = gradient(x);
    const double value = x.dot(g), slope = g.norm();
    // sqrt(x^T D x) - 1 over its slope: exact for a sphere and a cylinder.
    const double root = std::sqrt(value);
    return slope > 0 ? (root - 1) * root / slope : -half_axes_.minCoeff();
}

Vec3 WrapSurface::settle(Vec3 x) const {
    for (int step = 0; step < kSettling; ++step) {
        const double away = height(x);
        x -= away * normal(x);
        if (!(std::abs(away) > kSettled * size_)) break;  // the next one would be its square
    }
    return x;
}

}  // namespace myotet::skeleton
