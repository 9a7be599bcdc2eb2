// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/WrapCurved.h"

#include "WrapShapes.h"

namespace myotet::skeleton {
namespace {

// Newton's method stops where the next step is rounding.
constexpr double kTaut = 1e-9;
// Chains of 64 pieces, extrapolated twice, of lengths of about 100 mm: their error falls as
// the sixth power of a piece, and relaxation stops at 1e-13 of it.
constexpr double kChain = 3e-8;
// 64 pieces around the tip of an ellipsoid ten times as long as wide are long.
constexpr double kCoarseChain = 2e-4;

/// Relaxes a chain whose ends are fixed until each point is level with the middle of its
/// neighbours: a discrete geodesic.
void relax(const WrapSurface& surface, std::vector<Vec3>& chain) {
    const double still = 1e-13 * surface.size();
    for (int sweep = 0; sweep < 100000; ++sweep) {
        double moved = 0;
        for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
            const Vec3 normal = surface.normal(chain[i]);
            Vec3 way = 0.5 * (chain[i - 1] + chain[i + 1]) - chain[i];
            way -= way.dot(normal) * normal;
            // Over-relaxed as is best for a chain of that many pieces.
            way *= 2 / (1 + std::sin(kPi / static_cast<double>(chain.size() - 1)));
            chain[i] = surface.settle(chain[i] + way);
            moved = std::max(moved, way.norm());
        }
        if (moved < still) return;
    }
    ADD_FAILURE() << "chain did not come to rest";
}

double chain_length(const std::vector<Vec3>& chain) {
    double sum = 0;
    for (std::size_t i = 1; i < chain.size(); ++i) sum += (chain[i] - chain[i - 1]).norm();
    return sum;
}

/// Length of the geodesic between two points near a curve, by chains of 16, 32, 64 pieces
/// extrapolated to none.
double chained(const WrapSurface& surface, const WrapContact& near, const Vec3& from,
               const Vec3& to) {
    std::vector<double> lengths;
    for (const int pieces : {16, 32, 64}) {
        std::vector<Vec3> chain{from};
        for (int i = 1; i < pieces; ++i)
            chain.push_back(follow_geodesic(surface, near.first, near.curve * i / pieces).point.at);
        chain.push_back(to);
        relax(surface, chain);
        lengths.push_back(chain_length(chain));
    }
    const double a = (4 * lengths[1] - lengths[0]) / 3, b = (4 * lengths[2] - lengths[1]) / 3;
    return (16 * b - a) / 15;
}

/// The geodesic is as long as the chain; paths that touch elsewhere are longer.
void expect_shortest(const WrapObject& object, const Wrap& wrap, const Vec3& from, const Vec3& to,
                     double precision, Dice& dice) {
    const WrapSurface surface(object);
    const WrapContact& c = wrap.contact;
    EXPECT_NEAR(chained(surface, c, c.first.at, c.last.at), c.curve, precision);
    const double length = wrapped_length(c, from, to);
    for (int n = 0; n < 3; ++n) {
        // On the curve's side of the horizon, where the straight pieces stay outside.
        const auto aside = [&](const GeodesicPoint& p, double sense) -> Vec3 {
            const Vec3 side = p.along.cross(surface.normal(p.at));
            const double reach = std::min(1.0, 0.1 * c.curve);
            return surface.settle(p.at + reach * (dice.between(-1, 1) * side + sense * p.along));
        };
        const Vec3 first = aside(c.first, dice.between(0, 0.1));
        const Vec3 last = aside(c.last, -dice.between(0, 0.1));
        const double beside =
            (first - from).norm() + chained(surface, c, first, last) + (to - last).norm();
        EXPECT_GT(beside, length - precision);
    }
}

TEST(WrapEllipsoid, OfEqualAxesIsASphere) {
    Dice dice(7);
    int touching = 0;
    for (int n = 0; n < 2000; ++n) {
        const double r = dice.between(5, 30);
        const Vec3 p = dice.point(60), q = dice.point(60);
        if (std::min(p.norm(), q.norm()) < 1.0001 * r) continue;
        const Wrap round = begin_wrap(sphere(r), p, q), wrap = begin_wrap(ellipsoid(r, r, r), p, q);
        EXPECT_EQ(wrap.touch, round.touch);
        if (round.touch != WrapTouch::touching) continue;
        ++touching;
        EXPECT_NEAR(length_of(wrap, p, q), length_of(round, p, q), kClosedForm);
        // Near the middle a path's place is known less well than its length.
        EXPECT_LT((wrap.contact.first.at - round.contact.first.at).norm(), 1e-6);
    }
    EXPECT_GT(touching, 150);
}

TEST(WrapEllipsoid, IsTautAndOutsideForAllShapes) {
    Dice dice(8);
    for (const WrapObject& object :
         {ellipsoid(35, 20, 20), ellipsoid(25, 20, 20), ellipsoid(40, 40, 8),
          ellipsoid(100, 10, 12), ellipsoid(10, 100, 90)}) {
        const WrapSurface surface(object);
        const double reach = 2 * surface.size();
        int touching = 0, pierced = 0;
        for (int n = 0; n < 1000; ++n) {
            const Vec3 p = dice.point(reach), q = dice.point(reach);
            const Wrap wrap = begin_wrap(object, p, q);
            if (wrap.touch == WrapTouch::inside) continue;
            pierced += wrap.pierced;
            EXPECT_GE(length_of(wrap, p, q), (q - p).norm());
            if (wrap.touch != WrapTouch::touching) continue;
            ++touching;
            expect_taut(object, wrap, p, q, kTaut);
            expect_outside(object, wrap, p, q);
        }
        EXPECT_EQ(touching, pierced);
        EXPECT_GT(touching, 20);
    }
}

TEST(WrapEllipsoid, InAPlaneOfSymmetryIsAnEllipse) {
    // From tangent to tangent over the arc of x^2/a^2 + y^2/b^2 = 1, by Simpson's rule.
    const double a = 35, b = 20, height = 10;
    const Vec3 p{-50, height, 0}, q{50, height, 0};
    // The tangent from (0, y0) beyond: points at angle t where -50 cos t / a + height sin t / b = 1
    const double far = std::hypot(50 / a, height / b), lean = std::atan2(height / b, -50 / a);
    const double start = lean - std::acos(1 / far), end = kPi - start;
    const int pieces = 2000;
    double arc = 0;
    for (int i = 0; i <= pieces; ++i) {
        const double t = start + (end - start) * i / pieces;
        const double weight = i == 0 || i == pieces ? 1 : (i % 2 == 1 ? 4 : 2);
        arc += weight * std::hypot(a * std::sin(t), b * std::cos(t));
    }
    arc *= std::abs(end - start) / (3 * pieces);
    const Vec3 first{a * std::cos(start), b * std::sin(start), 0};
    const Wrap wrap = begin_wrap(ellipsoid(a, b, 60), p, q);
    ASSERT_EQ(wrap.touch, WrapTouch::touching);
    EXPECT_LT((wrap.contact.first.at - first).norm(), kTaut);
    EXPECT_NEAR(length_of(wrap, p, q), arc + 2 * (first - p).norm(), kTaut);
}

TEST(WrapEllipsoid, IsTheLimitOfChains) {
    Dice dice(9);
    for (const WrapObject& object : {ellipsoid(35, 20, 20), ellipsoid(25, 20, 20),
                                     ellipsoid(40, 40, 15), ellipsoid(100, 10, 12)}) {
        const double reach = 2 * object.size[0];
        const bool slender = object.size[0] > 5 * object.size[1];
        int compared = 0;
        for (int n = 0; n < 20000 && compared < 6; ++n) {
            const Vec3 p = dice.point(reach), q = dice.point(reach);
            const Wrap wrap = begin_wrap(object, p, q);
            if (wrap.touch != WrapTouch::touching || wrap.contact.curve < 5) continue;
            ++compared;
            expect_shortest(object, wrap, p, q, slender ? kCoarseChain : kChain, dice);
        }
        EXPECT_EQ(compared, 6);
    }
}

TEST(WrapEllipsoid, AQuadrantTakesThePathToItsHalf) {
    WrapObject object = ellipsoid(35, 20, 20);
    const Vec3 p{-20, -30, 4}, q{10, 30, 5};
    for (const int sign : {-1, 1})
        for (const int axis : {0, 2}) {
            object.quadrant = {axis, sign};
            const Wrap wrap = begin_wrap(object, p, q);
            ASSERT_EQ(wrap.touch, WrapTouch::touching) << axis << sign;
            EXPECT_GE(wrap.side[axis] * sign, 0);
            expect_taut(object, wrap, p, q, kTaut);
            expect_outside(object, wrap, p, q);
        }
}

TEST(WrapEllipsoid, FollowsItsSideUntilItLiftsOff) {
    const WrapObject object = ellipsoid(60, 20, 20);
    const WrapSurface surface(object);
    const Vec3 p{0, -30, 1};
    const auto end_at = [](int n) {
        const double angle = n * kPi / 180;  // over +z and on
        return Vec3{3, -40 * std::cos(angle), 40 * std::sin(angle)};
    };
    WrapMemory memory;
    double before = (end_at(60) - p).norm();
    int touched = 0, beyond = 0;
    for (int step = 60; step <= 360; ++step) {
        const int n = step <= 210 ? step : 420 - step;  // there and back
        const Vec3 q = end_at(n);
        const Wrap wrap = find_wrap(object, surface, p, q, memory);
        const double length = length_of(wrap, p, q);
        EXPECT_LT(std::abs(length - before), 40 * kPi / 180 + kTaut) << step;
        before = length;
        memory = remembered(wrap, p, q);
        touched += wrap.touch == WrapTouch::touching;
        if (n <= 185) continue;
        // Below would be shorter, but the ends of the ellipsoid are in the way.
        EXPECT_LT(length_of(begin_wrap(object, p, q), p, q), length);
        ++beyond;
        expect_taut(object, wrap, p, q, kTaut);
        expect_outside(object, wrap, p, q);
    }
    EXPECT_EQ(memory.touching, false);
    EXPECT_GT(touched, 150);
    EXPECT_GT(beyond, 40);
}

TEST(WrapEllipsoid, AnEndOnTheSurfaceIsNotInside) {
    const WrapObject object = ellipsoid(35, 20, 20);
    const WrapSurface surface(object);
    Dice dice(10);
    int touching = 0;
    for (int n = 0; n < 300; ++n) {
        const Vec3 p = surface.settle(20 * dice.point(1) + Vec3(0, 0, 5)), q = dice.point(60);
        const Vec3 above = p + 1e-6 * surface.normal(p);
        if (surface.height(q) < 1) continue;
        const Wrap wrap = begin_wrap(object, p, q), near = begin_wrap(object, above, q);
        ASSERT_NE(wrap.touch, WrapTouch::inside);
        // A point a micrometre above has a path that is longer or shorter by no more.
        EXPECT_NEAR(length_of(wrap, p, q), length_of(near, above, q), 1e-6);
        touching += wrap.touch == WrapTouch::touching;
    }
    EXPECT_GT(touching, 50);
}

TEST(WrapTorus, PassesThroughTheHole) {
    Dice dice(11);
    const WrapObject object = torus(30, 10);
    const WrapSurface surface(object);
    int compared = 0;
    for (int n = 0; n < 600; ++n) {
        const Vec3 p{dice.between(-45, 45), dice.between(-45, 45), dice.between(15, 60)};
        const Vec3 q{dice.between(-45, 45), dice.between(-45, 45), dice.between(-60, -15)};
        const Wrap wrap = begin_wrap(object, p, q);
        if (wrap.touch != WrapTouch::touching) continue;
        expect_taut(object, wrap, p, q, kTaut);
        EXPECT_LT(wrap.side.head<2>().norm() * wrap.side[2], 1);
        if (++compared < 8 && wrap.contact.curve > 3)
            expect_shortest(object, wrap, p, q, kChain, dice);
    }
    EXPECT_GT(compared, 200);
}

TEST(WrapTorus, OverTheTubeInAPlaneThroughTheAxisIsACircle) {
    const WrapObject object = torus(30, 10);
    const Vec3 p{35, 0, 40}, q{38, 0, -30};
    const Wrap wrap = begin_wrap(object, p, q);
    ASSERT_EQ(wrap.touch, WrapTouch::touching);
    // Around the circle about (30, 0, 0) on the side of the axis.
    const Vec3 centre{30, 0, 0};
    const double a = (p - centre).norm(), b = (q - centre).norm();
    const double angle = 2 * kPi - std::acos((p - centre).dot(q - centre) / (a * b));
    const double circle = std::sqrt(a * a - 100) + std::sqrt(b * b - 100) +
                          10 * (angle - std::acos(10 / a) - std::acos(10 / b));
    EXPECT_NEAR(length_of(wrap, p, q), circle, kTaut);
    // Through the middle of the hole nothing is in the way.
    EXPECT_EQ(begin_wrap(object, {3, 2, 50}, {-4, 1, -50}).touch, WrapTouch::clear);
}

}  // namespace
}  // namespace myotet::skeleton
