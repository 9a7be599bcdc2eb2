// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Wrap.h"

#include "Skeleton/WrapCurved.h"
#include "Skeleton/WrapRound.h"

namespace myotet::skeleton {
namespace {

// Of the object's size: an end less deep than this lies on the surface.
constexpr double kSkin = 1e-9;
// So far out such an end is taken, so that Newton's method has a tangent to find. A path
// lengthens by the power 3/2 of it.
constexpr double kLift = 1e-10;

Vec3 lifted(const WrapSurface& surface, const Vec3& x) {
    const double least = kLift * surface.size();
    if (surface.height(x) >= least) return x;
    const Vec3 settled = surface.settle(x);
    return settled + least * surface.normal(settled);
}

}  // namespace

Wrap find_wrap(const WrapObject& object, const WrapSurface& surface, const Vec3& from,
               const Vec3& to, const WrapMemory& before) {
    const double skin = -kSkin * surface.size();
    if (!(surface.height(from) > skin && surface.height(to) > skin)) {
        Wrap wrap;
        wrap.touch = WrapTouch::inside;
        return wrap;
    }
    switch (object.shape) {
        case WrapShape::sphere:
            return wrap_sphere(object, from, to, before);
        case WrapShape::cylinder:
            return wrap_cylinder(object, from, to, before);
        case WrapShape::ellipsoid:
        case WrapShape::torus:
            break;
    }
    return wrap_curved(object, surface, lifted(surface, from), lifted(surface, to), before);
}

double wrapped_length(const WrapContact& contact, const Vec3& from, const Vec3& to) {
    return (contact.first.at - from).norm() + contact.curve + (to - contact.last.at).norm();
}

}  // namespace myotet::skeleton
