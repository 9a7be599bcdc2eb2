// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Geodesic.h"

#include "WrapShapes.h"

namespace myotet::skeleton {
namespace {

// Rounding of extrapolated steps, of lengths of about 100 mm.
constexpr double kFollowed = 1e-10;
// The Jacobi fields are only followed to 1e-9 a step; they lead Newton's method.
constexpr double kShifted = 1e-6;

GeodesicPoint random_start(Dice& dice, const WrapSurface& surface) {
    GeodesicPoint start;
    Vec3 x = dice.point(1) + Vec3(0.1, 0.2, 0.3);
    if (surface.is_torus())
        x = surface.core() * Vec3(x[0], x[1], 0).normalized() + 0.9 * surface.tube() * x;
    else
        for (int i = 0; i < 3; ++i) x[i] *= std::min(surface.half_axes()[i], 50.0);
    start.at = surface.settle(x);
    const Vec3 normal = surface.normal(start.at);
    start.along = normal.cross(dice.point(1)).normalized();
    return start;
}

std::vector<WrapObject> all_objects() {
    std::vector<WrapObject> objects = convex_objects();
    objects.push_back(torus(30, 12));
    objects.push_back(ellipsoid(100, 10, 12));
    return objects;
}

TEST(Geodesic, IsAGreatCircleOnASphere) {
    Dice dice(3);
    const double r = 17;
    const WrapSurface surface(sphere(r));
    for (int n = 0; n < 50; ++n) {
        const GeodesicPoint start = random_start(dice, surface);
        const double angle = dice.between(-3, 3), c = std::cos(angle), s = std::sin(angle);
        const GeodesicEnd end = follow_geodesic(surface, start, r * angle);
        EXPECT_LT((end.point.at - c * start.at - r * s * start.along).norm(), kFollowed);
        EXPECT_LT((end.point.along - c * start.along + s / r * start.at).norm(), kFollowed);
        EXPECT_NEAR(end.shift, c, kShifted);
        EXPECT_NEAR(end.turn, r * s, kShifted);
        EXPECT_NEAR(end.shift_rate, -s / r, kShifted);
        EXPECT_NEAR(end.turn_rate, c, kShifted);
    }
}

TEST(Geodesic, KeepsItsAngularMomentumAboutAnAxisOfSymmetry) {
    Dice dice(4);
    for (const WrapObject& object : {cylinder(16), ellipsoid(20, 20, 35), ellipsoid(40, 40, 8),
                                     torus(30, 12), torus(15, 12)}) {
        const WrapSurface surface(object);
        for (int n = 0; n < 20; ++n) {
            const GeodesicPoint start = random_start(dice, surface);
            const GeodesicPoint end = follow_geodesic(surface, start, dice.between(5, 60)).point;
            // Clairaut: distance from the axis times cosine with the parallel.
            EXPECT_NEAR(end.at.cross(end.along)[2], start.at.cross(start.along)[2], kFollowed * 30);
        }
    }
}

TEST(Geodesic, LeadsBackAndStaysOnTheSurface) {
    Dice dice(5);
    for (const WrapObject& object : all_objects()) {
        const WrapSurface surface(object);
        for (int n = 0; n < 20; ++n) {
            const GeodesicPoint start = random_start(dice, surface);
            const double length = dice.between(1, 60);
            const GeodesicPoint end = follow_geodesic(surface, start, length).point;
            EXPECT_NEAR(surface.height(end.at), 0, kFollowed);
            EXPECT_NEAR(surface.normal(end.at).dot(end.along), 0, kFollowed);
            const GeodesicPoint back = follow_geodesic(surface, end, -length).point;
            // Neighbours spread by less than this on the way.
            EXPECT_LT((back.at - start.at).norm(), 1e3 * kFollowed);
        }
    }
}

TEST(Geodesic, JacobiFieldsAreDifferencesOfNeighbours) {
    Dice dice(6);
    // Central differences err by the square of the step and by rounding over it.
    const double step = 1e-5, difference = 1e-4;
    for (const WrapObject& object : all_objects()) {
        const WrapSurface surface(object);
        for (int n = 0; n < 10; ++n) {
            const GeodesicPoint start = random_start(dice, surface);
            const double length = dice.between(5, 30);
            const GeodesicEnd end = follow_geodesic(surface, start, length);
            const Vec3 side = start.along.cross(surface.normal(start.at));
            const Vec3 end_side = end.point.along.cross(surface.normal(end.point.at));
            const auto turned = [&](double angle) {
                const Vec3 along = std::cos(angle) * start.along + std::sin(angle) * side;
                return follow_geodesic(surface, {start.at, along}, length).point.at;
            };
            const Vec3 rate = (turned(step) - turned(-step)) / (2 * step);
            EXPECT_NEAR(rate.dot(end_side), end.turn, difference * (1 + std::abs(end.turn)));
        }
    }
}

}  // namespace
}  // namespace myotet::skeleton
