// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/WrapRound.h"

#include "WrapShapes.h"

namespace myotet::skeleton {
namespace {

/// Over a circle of radius r between points at distances p and q, seen `angle` apart.
double around_circle(double p, double q, double angle, double r) {
    return std::sqrt(p * p - r * r) + std::sqrt(q * q - r * r) +
           r * (angle - std::acos(r / p) - std::acos(r / q));
}

TEST(WrapSphere, HasTheLengthOfAGreatCircleWithTangents) {
    Dice dice(1);
    int touching = 0;
    for (int n = 0; n < 2000; ++n) {
        const double r = dice.between(1, 30);
        const Vec3 p = dice.point(60), q = dice.point(60);
        if (std::min(p.norm(), q.norm()) < r) continue;
        const Wrap wrap = begin_wrap(sphere(r), p, q);
        const double angle = std::atan2(p.cross(q).norm(), p.dot(q));
        const double wrapped = around_circle(p.norm(), q.norm(), angle, r);
        const bool over = angle > std::acos(r / p.norm()) + std::acos(r / q.norm());
        EXPECT_EQ(wrap.touch == WrapTouch::touching, over);
        EXPECT_EQ(wrap.pierced, over);
        if (!over) continue;
        ++touching;
        EXPECT_NEAR(length_of(wrap, p, q), wrapped, kClosedForm);
        expect_taut(sphere(r), wrap, p, q, kClosedForm);
        expect_outside(sphere(r), wrap, p, q);
    }
    EXPECT_GT(touching, 200);
}

TEST(WrapSphere, AQuadrantTakesThePathToItsHalf) {
    WrapObject object = sphere(10);
    const Vec3 p{-30, 20, 0}, q{-30, -25, 5};
    const Vec3 through_q{25, -25, 5};
    object.quadrant = {0, 1};
    // Clear of the sphere: nothing to wrap, on whichever side.
    EXPECT_EQ(begin_wrap(object, p, q).touch, WrapTouch::clear);
    object.quadrant = {1, -1};
    const Wrap down = begin_wrap(object, p, through_q);
    object.quadrant = {1, 1};
    const Wrap up = begin_wrap(object, p, through_q);
    ASSERT_EQ(down.touch, WrapTouch::touching);
    ASSERT_EQ(up.touch, WrapTouch::touching);
    EXPECT_LT(down.side[1], 0);
    EXPECT_GT(up.side[1], 0);
    // Both ways around lie in one plane and make up a whole turn.
    const double angle = std::atan2(p.cross(through_q).norm(), p.dot(through_q));
    const double a = around_circle(p.norm(), through_q.norm(), angle, 10);
    const double b = around_circle(p.norm(), through_q.norm(), 2 * kPi - angle, 10);
    EXPECT_NEAR(length_of(down, p, through_q) + length_of(up, p, through_q), a + b, kClosedForm);
}

TEST(WrapSphere, EndsInLineWithTheMiddleHaveAPathToo) {
    for (const Vec3& p : {Vec3{30, 0, 0}, Vec3{0, 0, -30}, Vec3{17, 17, 17}})
        for (const Quadrant& quadrant : {Quadrant{0, 0}, Quadrant{0, 1}, Quadrant{2, -1}}) {
            WrapObject object = sphere(10);
            object.quadrant = quadrant;
            const Wrap wrap = begin_wrap(object, p, -2 * p);
            ASSERT_EQ(wrap.touch, WrapTouch::touching);
            expect_taut(object, wrap, p, -2 * p, kClosedForm);
            EXPECT_NEAR(length_of(wrap, p, -2 * p), around_circle(p.norm(), 2 * p.norm(), kPi, 10),
                        kClosedForm);
        }
}

TEST(WrapCylinder, IsStraightOnItsUnrolledSurface) {
    Dice dice(2);
    int touching = 0;
    for (int n = 0; n < 2000; ++n) {
        const double r = dice.between(1, 30);
        const Vec3 p = dice.point(60), q = dice.point(60);
        const Vec3 flat_p{p[0], p[1], 0}, flat_q{q[0], q[1], 0};
        if (std::min(flat_p.norm(), flat_q.norm()) < r) continue;
        const Wrap wrap = begin_wrap(cylinder(r), p, q);
        const double angle = std::atan2(flat_p.cross(flat_q).norm(), flat_p.dot(flat_q));
        const bool over = angle > std::acos(r / flat_p.norm()) + std::acos(r / flat_q.norm());
        EXPECT_EQ(wrap.touch == WrapTouch::touching, over);
        if (!over) continue;
        ++touching;
        const double flat = around_circle(flat_p.norm(), flat_q.norm(), angle, r);
        EXPECT_NEAR(length_of(wrap, p, q), std::hypot(flat, q[2] - p[2]), kClosedForm);
        expect_taut(cylinder(r), wrap, p, q, kClosedForm);
        expect_outside(cylinder(r), wrap, p, q);
    }
    EXPECT_GT(touching, 300);
}

TEST(WrapCylinder, AQuadrantHoldsThePathWhereTheLineWouldPassClear) {
    WrapObject object = cylinder(10);
    object.quadrant = {0, 1};
    const Vec3 p{-15, 30, 0}, q{-20, -30, 4};
    const Wrap held = begin_wrap(object, p, q);
    ASSERT_EQ(held.touch, WrapTouch::touching);
    EXPECT_FALSE(held.pierced);
    EXPECT_GT(held.side[0], 0);
    expect_taut(object, held, p, q, kClosedForm);
    // On the right side, or beside the object, it is free.
    EXPECT_EQ(begin_wrap(object, {15, 30, 0}, {20, -30, 4}).touch, WrapTouch::clear);
    EXPECT_EQ(begin_wrap(object, {-15, 30, 0}, {15, 40, 4}).touch, WrapTouch::clear);
    object.quadrant = {0, -1};
    EXPECT_EQ(begin_wrap(object, p, q).touch, WrapTouch::clear);
}

TEST(WrapCylinder, ComesIntoContactWithinItsLengthAndThenStays) {
    const WrapObject object = cylinder(10, 40);
    const auto ends = [](double z) { return std::pair(Vec3{-30, 4, z}, Vec3{30, 2, z + 5}); };
    const auto [p, q] = ends(0);
    const auto [far_p, far_q] = ends(30);
    EXPECT_EQ(begin_wrap(object, far_p, far_q).touch, WrapTouch::clear);
    const Wrap wrap = begin_wrap(object, p, q);
    ASSERT_EQ(wrap.touch, WrapTouch::touching);
    const WrapSurface surface(object);
    const Wrap slid = find_wrap(object, surface, far_p, far_q, remembered(wrap, p, q));
    ASSERT_EQ(slid.touch, WrapTouch::touching);
    EXPECT_NEAR(length_of(slid, far_p, far_q), length_of(wrap, p, q), kClosedForm);
}

TEST(WrapCylinder, StaysOnItsSideBeyondHalfATurn) {
    const WrapObject object = cylinder(10);
    const WrapSurface surface(object);
    const Vec3 p{-30, 0, 0};
    WrapMemory memory;
    memory.side = Vec3::UnitY();
    double before = 0;
    for (int n = 0; n <= 340; ++n) {
        const double angle = n * kPi / 180;  // of the far end, over +y and on
        const Vec3 q{-40 * std::cos(angle), 40 * std::sin(angle), 10};
        const Wrap wrap = find_wrap(object, surface, p, q, memory);
        const double length = length_of(wrap, p, q);
        if (n > 0) {
            EXPECT_LT(std::abs(length - before), 40 * kPi / 180 + kClosedForm) << n;
        }
        before = length;
        if (wrap.touch != WrapTouch::touching) continue;
        memory = remembered(wrap, p, q);
        const double flat = around_circle(30, 40, angle, 10);
        EXPECT_NEAR(length, std::hypot(flat, 10), kClosedForm) << n;
    }
    EXPECT_TRUE(memory.touching);
}

TEST(WrapRound, AnEndInsideLeavesTheObjectOut) {
    for (const WrapObject& object : {sphere(10), cylinder(10)}) {
        EXPECT_EQ(begin_wrap(object, {1, 2, 3}, {30, 0, 0}).touch, WrapTouch::inside);
        EXPECT_EQ(begin_wrap(object, {30, 0, 0}, {-9.9, 0, 0}).touch, WrapTouch::inside);
        // On the surface is not inside.
        const Wrap on = begin_wrap(object, {-10, 0, 0}, {10, 0.5, 0});
        ASSERT_EQ(on.touch, WrapTouch::touching);
        EXPECT_NEAR(length_of(on, {-10, 0, 0}, {10, 0.5, 0}),
                    around_circle(10, std::hypot(10, 0.5), kPi - std::atan2(0.5, 10), 10),
                    kClosedForm);
    }
}

TEST(WrapSurface, ATorusIsItsHoleAndItsWhole) {
    const WrapSurface surface(torus(30, 8));
    EXPECT_EQ(surface.core(), 30);
    EXPECT_EQ(surface.tube(), 8);
    EXPECT_NEAR(surface.height({22, 0, 0}), 0, kClosedForm);
    EXPECT_NEAR(surface.height({0, -38, 0}), 0, kClosedForm);
    EXPECT_NEAR(surface.height({0, 0, 0}), 22, kClosedForm);
    EXPECT_NEAR(surface.height({30, 0, 1}), -7, kClosedForm);
}

}  // namespace
}  // namespace myotet::skeleton
