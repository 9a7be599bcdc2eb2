// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "Skeleton/Wrap.h"

// Wrap objects, points around them and what every taut path over one of them obeys.
namespace myotet::skeleton {

constexpr double kPi = std::numbers::pi;
// What closed forms are held to, of lengths of about 100 mm.
constexpr double kClosedForm = 1e-10;
// A sampled path may lie this deep inside its object by rounding, mm.
constexpr double kSkinDepth = 1e-9;

inline WrapObject sphere(double radius) {
    return {.shape = WrapShape::sphere, .size = {radius, 0, 0}};
}
inline WrapObject cylinder(double radius, double length = 1000) {
    return {.shape = WrapShape::cylinder, .size = {radius, length, 0}};
}
inline WrapObject ellipsoid(double a, double b, double c) {
    return {.shape = WrapShape::ellipsoid, .size = {a, b, c}};
}
/// Radii of the circle in the tube's middle and of the tube.
inline WrapObject torus(double core, double tube) {
    return {.shape = WrapShape::torus, .size = {core - tube, core + tube, 0}};
}
/// The shapes of arm26 among others.
inline std::vector<WrapObject> convex_objects() {
    return {sphere(10), cylinder(16, 500), ellipsoid(35, 20, 20), ellipsoid(25, 20, 14),
            ellipsoid(30, 30, 18)};
}

class Dice {
public:
    explicit Dice(unsigned seed) : engine_(seed) {}
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    Vec3 point(double reach) {
        return {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
    }
    Mat3 rotation() {
        Eigen::Quaterniond q(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
        return q.normalized().toRotationMatrix();
    }

private:
    std::mt19937 engine_;
};

inline Wrap begin_wrap(const WrapObject& object, const Vec3& from, const Vec3& to) {
    return find_wrap(object, WrapSurface(object), from, to, {});
}
inline WrapMemory remembered(const Wrap& wrap, const Vec3& from, const Vec3& to) {
    return {wrap.touch == WrapTouch::touching, wrap.side, wrap.contact, from, to};
}
/// Of the path, straight or not.
inline double length_of(const Wrap& wrap, const Vec3& from, const Vec3& to) {
    return wrap.touch == WrapTouch::touching ? wrapped_length(wrap.contact, from, to)
                                             : (to - from).norm();
}

/// Its contact lies on the surface, its straight pieces and the ends of its geodesic are in
/// line, and the geodesic leads from one to the other.
inline void expect_taut(const WrapObject& object, const Wrap& wrap, const Vec3& from,
                        const Vec3& to, double precision) {
    const WrapSurface surface(object);
    const WrapContact& c = wrap.contact;
    EXPECT_GT(c.curve, 0);
    for (const GeodesicPoint& p : {c.first, c.last}) {
        EXPECT_NEAR(surface.height(p.at), 0, precision);
        EXPECT_NEAR(p.along.norm(), 1, precision);
    }
    const Vec3 before = c.first.at - from, after = to - c.last.at;
    EXPECT_LT((before - before.norm() * c.first.along).norm(), precision);
    EXPECT_LT((after - after.norm() * c.last.along).norm(), precision);
    const GeodesicPoint end = follow_geodesic(surface, c.first, c.curve).point;
    EXPECT_LT((end.at - c.last.at).norm(), precision);
    EXPECT_LT((end.along - c.last.along).norm(), precision);
}

/// No point of the path lies inside.
inline void expect_outside(const WrapObject& object, const Wrap& wrap, const Vec3& from,
                           const Vec3& to) {
    const WrapSurface surface(object);
    std::vector<Vec3> points{from};
    if (wrap.touch == WrapTouch::touching) {
        points.push_back(wrap.contact.first.at);
        for (int i = 1; i < 20; ++i)
            points.push_back(
                follow_geodesic(surface, wrap.contact.first, wrap.contact.curve * i / 20).point.at);
        points.push_back(wrap.contact.last.at);
    }
    points.push_back(to);
    for (std::size_t n = 1; n < points.size(); ++n) {
        const bool straight = n == 1 || n + 1 == points.size();
        for (int i = 0; i <= (straight ? 50 : 0); ++i) {
            const Vec3 at = points[n] + i / 50.0 * (points[n - 1] - points[n]);
            EXPECT_GT(surface.height(at), -kSkinDepth);
        }
    }
}

}  // namespace myotet::skeleton
