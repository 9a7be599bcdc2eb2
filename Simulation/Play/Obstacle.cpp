// SPDX-License-Identifier: Apache-2.0
#include "Play/Obstacle.h"

#include <cmath>

namespace myotet::play {
namespace {

Apart apart_from_box(const Box& box, const Vec3& p) {
    const Vec3 on = p.cwiseMax(box.min).cwiseMin(box.max);
    const double outside = (p - on).norm();
    if (outside > 0) return {outside, (p - on) / outside};
    Apart nearest{-std::numeric_limits<double>::infinity(), Vec3::UnitZ()};
    for (int a = 0; a < 3; ++a) {
        const double low = box.min[a] - p[a], high = p[a] - box.max[a];
        if (low > nearest.distance) nearest = {low, -Vec3::Unit(a)};
        if (high > nearest.distance) nearest = {high, Vec3::Unit(a)};
    }
    return nearest;
}

}  // namespace

Apart apart(const Obstacle& obstacle, const Vec3& p) {
    switch (obstacle.form) {
        case Form::plane:
            return {obstacle.normal.dot(p - obstacle.point), obstacle.normal};
        case Form::box:
            return apart_from_box(obstacle.box, p);
        case Form::sphere:
            break;
    }
    const Vec3 from = p - obstacle.point;
    const double far = from.norm();
    return {far - obstacle.radius, far > 0 ? Vec3(from / far) : Vec3(Vec3::UnitZ())};
}

// |from + s by|^2 = radius^2, the smaller root, without cancellation.
double first_reach(const Vec3& from, const Vec3& by, double radius) {
    const double c = from.squaredNorm() - radius * radius;
    if (c <= 0) return 0;
    const double a = by.squaredNorm(), half_b = from.dot(by);
    const double root = half_b * half_b - a * c;
    if (half_b >= 0 || root < 0) return -1;
    const double s = c / (-half_b + std::sqrt(root));
    return s <= 1 ? s : -1;
}

}  // namespace myotet::play
