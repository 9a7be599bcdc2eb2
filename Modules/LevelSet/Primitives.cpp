// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Primitives.h"

#include <algorithm>
#include <cmath>

namespace myotet::levelset {
namespace {

using Vec2 = Eigen::Vector2d;

// From a point to the segment a - b.
double segment_distance(const Vec2& point, const Vec2& a, const Vec2& b) {
    const Vec2 along = b - a;
    const double length2 = along.squaredNorm();
    const double t = length2 > 0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0.0;
    return (point - a - t * along).norm();
}

// Height along the axis from `from`, and distance from the axis.
Vec2 about_axis(const Vec3& point, const RoundCone& cone, double length) {
    const Vec3 axis = length > 0 ? Vec3((cone.to - cone.from) / length) : Vec3(Vec3::UnitZ());
    const Vec3 p = point - cone.from;
    const double height = p.dot(axis);
    return {height, (p - height * axis).norm()};
}

// Foot of a point y >= 0 on the ellipsoid sum (x_i / e_i)^2 = 1: x_i = e_i^2
// y_i / (t + e_i^2), where t is the root of sum (e_i y_i / (t + e_i^2))^2 = 1
// that is greater than -min e_i^2.
double ellipsoid_foot_distance(const Vec3& y, const Vec3& e) {
    const double least = e.minCoeff();
    double low = -least * least, high = low + e.cwiseProduct(y).norm() + least * least;
    const auto excess = [&](double t) {
        double sum = -1;
        for (int a = 0; a < 3; ++a) {
            const double denominator = t + e[a] * e[a];
            if (y[a] > 0) sum += std::pow(e[a] * y[a] / denominator, 2);
        }
        return sum;
    };
    for (int i = 0; i < 200 && low < high; ++i) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        (excess(middle) > 0 ? low : high) = middle;
    }
    Vec3 foot = Vec3::Zero();
    double rest = 1;
    for (int a = 0; a < 3; ++a)
        if (y[a] > 0) {
            foot[a] = e[a] * e[a] * y[a] / (high + e[a] * e[a]);
            rest -= std::pow(foot[a] / e[a], 2);
        }
    // On the plane across the shortest axis the root may be the bound itself:
    // then the foot lies off that plane.
    for (int a = 0; a < 3; ++a)
        if (e[a] == least && !(y[a] > 0)) {
            foot[a] = e[a] * std::sqrt(std::max(rest, 0.0));
            break;
        }
    return (y - foot).norm();
}

}  // namespace

double sphere_distance(const Vec3& point, const Vec3& centre, double radius) {
    return (point - centre).norm() - radius;
}

double ellipsoid_distance(const Vec3& point, const Vec3& semi_axes) {
    const bool inside = point.cwiseQuotient(semi_axes).squaredNorm() < 1;
    const double distance = ellipsoid_foot_distance(point.cwiseAbs(), semi_axes);
    return inside ? -distance : distance;
}

double round_cone_distance(const Vec3& point, const RoundCone& cone) {
    const double length = (cone.to - cone.from).norm();
    const double shrinks = cone.radius_from - cone.radius_to;
    if (!(length > std::abs(shrinks)))
        return shrinks > 0 ? sphere_distance(point, cone.from, cone.radius_from)
                           : sphere_distance(point, cone.to, cone.radius_to);
    // The side touches both balls; its normal leans by asin(sine) towards the
    // smaller one. A foot on the axis, seen along that normal, decides.
    const double sine = shrinks / length, cosine = std::sqrt(1 - sine * sine);
    const Vec2 p = about_axis(point, cone, length);
    const double along = p[0] * cosine - p[1] * sine;
    if (along < 0) return (point - cone.from).norm() - cone.radius_from;
    if (along > length * cosine) return (point - cone.to).norm() - cone.radius_to;
    return p[0] * sine + p[1] * cosine - cone.radius_from;
}

double cone_distance(const Vec3& point, const RoundCone& cone) {
    const double length = (cone.to - cone.from).norm();
    const Vec2 p = about_axis(point, cone, length);
    const Vec2 low(0, cone.radius_from), high(length, cone.radius_to);
    const double distance =
        std::min({segment_distance(p, Vec2(0, 0), low), segment_distance(p, low, high),
                  segment_distance(p, high, Vec2(length, 0))});
    const bool inside =
        p[0] > 0 && p[0] < length && p[1] < low[1] + (high[1] - low[1]) * p[0] / length;
    return inside ? -distance : distance;
}

double box_distance(const Vec3& point, const Vec3& half_sides) {
    const Vec3 q = point.cwiseAbs() - half_sides;
    return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

double torus_distance(const Vec3& point, double ring, double tube) {
    return Vec2(Vec2(point.x(), point.y()).norm() - ring, point.z()).norm() - tube;
}

double half_space_distance(const Vec3& point, const Vec3& on, const Vec3& outward) {
    return (point - on).dot(outward);
}

}  // namespace myotet::levelset
