// SPDX-License-Identifier: Apache-2.0
#include "Fibres/BSplineSolid.h"

#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "SolidShapes.h"

namespace myotet::fibres {
namespace {

// Of coordinates of 100 mm.
constexpr double kRounding = 1e-11;
// Where the locator ends is a point of the solid to within rounding; its parameters are
// then known to that over the least stretch of the solid.
constexpr double kPlace = 1e-8;

Vec3 random_place(std::mt19937& random) {
    std::uniform_real_distribution<double> in(0, 1);
    return {in(random), in(random), in(random)};
}

TEST(BSplineSolid, DerivativesAreFiniteDifferences) {
    constexpr double kStep = 1e-5, kDifference = 1e-4;
    std::mt19937 random(1);
    for (const SolidShape& shape : test::some_shapes()) {
        const BSplineSolid solid = test::some_solid(shape);
        for (int n = 0; n < 50; ++n) {
            const Vec3 at = 0.001 * Vec3::Ones() + 0.998 * random_place(random);
            const Mat3 J = evaluate(solid, at).derivative;
            for (int a = 0; a < 3; ++a) {
                const double spans = shape.count[a] - shape.degree[a];
                if (std::abs(at[a] * spans - std::round(at[a] * spans)) < 2 * kStep * spans)
                    continue;  // a knot between the two points
                const Vec3 by = kStep * Vec3::Unit(a);
                const Vec3 slope =
                    (evaluate(solid, at + by).position - evaluate(solid, at - by).position) /
                    (2 * kStep);
                EXPECT_LT((slope - J.col(a)).norm(), kDifference);
            }
        }
    }
}

TEST(BSplineSolid, CornersAreControlPointsAndAllMoveTogether) {
    for (const SolidShape& shape : test::some_shapes()) {
        BSplineSolid solid = test::some_solid(shape);
        EXPECT_LT((evaluate(solid, Vec3::Zero()).position - solid.control.front()).norm(),
                  kRounding);
        EXPECT_LT((evaluate(solid, Vec3::Ones()).position - solid.control.back()).norm(),
                  kRounding);
        const Vec3 at(0.2, 0.7, 0.4);
        const Vec3 before = evaluate(solid, at).position;
        const Mat3 R = test::some_rotation();
        for (Vec3& p : solid.control) p = R * p + Vec3(1, 2, 3);
        EXPECT_LT((evaluate(solid, at).position - R * before - Vec3(1, 2, 3)).norm(), kRounding);
    }
}

TEST(BSplineSolid, FindsThePlaceOfItsOwnPoints) {
    std::mt19937 random(2);
    for (const SolidShape& shape : test::some_shapes()) {
        const BSplineSolid solid = test::some_solid(shape);
        const SolidLocator locator(solid);
        for (int n = 0; n < 200; ++n) {
            Vec3 at = random_place(random);
            if (n % 4 == 0) at[n / 4 % 3] = n / 12 % 2;  // on a face
            const SolidPlace place = locator.find(evaluate(solid, at).position);
            EXPECT_LT(place.distance, 1e-7);
            EXPECT_LT((place.uvw - at).norm(), kPlace) << at.transpose();
        }
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 at(corner & 1, corner >> 1 & 1, corner >> 2);
            EXPECT_LT((locator.find(evaluate(solid, at).position).uvw - at).norm(), kPlace);
        }
    }
}

TEST(BSplineSolid, PlacesOutsideAreOnItsBoundaryAndNearest) {
    const BSplineSolid solid = test::some_solid({{3, 3, 3}, {5, 5, 8}});
    const SolidLocator locator(solid);
    std::mt19937 random(3);
    for (int n = 0; n < 60; ++n) {
        Vec3 at = random_place(random);
        const int axis = n % 3;
        at[axis] = n / 3 % 2;
        const SolidPoint wall = evaluate(solid, at);
        Vec3 out = wall.derivative.col((axis + 1) % 3).cross(wall.derivative.col((axis + 2) % 3));
        if (out.dot(wall.derivative.col(axis)) * (at[axis] - 0.5) < 0) out = -out;
        // Near: the point's foot is `at` itself, the wall's bends being far wider.
        const SolidPlace place = locator.find(wall.position + 0.5 * out.normalized());
        EXPECT_NEAR(place.distance, 0.5, 1e-6);
        EXPECT_LT((place.uvw - at).norm(), 1e-4);
        EXPECT_EQ(place.uvw[axis], at[axis]);
    }
}

TEST(BSplineSolid, FibresAreItsLinesOfConstantUAndV) {
    const BSplineSolid solid = test::some_solid({{3, 3, 3}, {5, 5, 8}});
    constexpr double kStep = 1e-5;
    const Vec3 at(0.3, 0.6, 0.5);
    const Vec3 along = evaluate(solid, at + Vec3(0, 0, kStep)).position -
                       evaluate(solid, at - Vec3(0, 0, kStep)).position;
    EXPECT_LT((fibre_at(solid, at) - along.normalized()).norm(), 1e-7);
    BSplineSolid flat = solid;
    for (Vec3& p : flat.control) p.setZero();
    EXPECT_EQ(fibre_at(flat, at), Vec3::Zero());
}

TEST(BSplineSolid, FibresOfAMeshAreThoseAtItsCentroids) {
    // A mesh of the block that a solid of degree 1 is; half of a second one sticks out.
    BSplineSolid block{{{1, 1, 1}, {2, 2, 2}}, {}};
    for (int corner = 0; corner < 8; ++corner)
        block.control.emplace_back(20.0 * (corner & 1) - 10, 20.0 * (corner >> 1 & 1) - 10,
                                   100.0 * (corner >> 2));
    const TetMesh mesh = test::fusiform(3, 20);
    const FibreField inside = solid_fibres(mesh, block);
    EXPECT_TRUE(inside.notes.empty());
    for (const Vec3& v : inside.direction) EXPECT_LT((v - Vec3::UnitZ()).norm(), 1e-12);
    for (Vec3& p : block.control) p.x() += 10;
    const FibreField half = solid_fibres(mesh, block);
    ASSERT_EQ(half.notes.size(), 1u);
    EXPECT_NE(half.notes[0].find("outside"), std::string::npos) << half.notes[0];
    for (const Vec3& v : half.direction) EXPECT_LT((v - Vec3::UnitZ()).norm(), 1e-12);
}

TEST(BSplineSolid, IsTheSameOnOneThreadAndMany) {
    const BSplineSolid solid = test::some_solid({{3, 3, 3}, {5, 5, 8}});
    const TetMesh mesh = test::fusiform(3, 20);
    const auto many = solid_fibres(mesh, solid).direction;
    const ThreadLimit limit(1);
    EXPECT_EQ(solid_fibres(mesh, solid).direction, many);
}

TEST(BSplineSolid, RefusesShapesThatCannotBe) {
    BSplineSolid solid = test::some_solid({{3, 3, 3}, {5, 5, 8}});
    solid.control.pop_back();
    EXPECT_THROW(SolidLocator{solid}, InputError);
    solid.control.emplace_back(0, 0, std::nan(""));
    EXPECT_THROW(SolidLocator{solid}, InputError);
    EXPECT_THROW((SolidShape{{4, 3, 3}, {6, 6, 6}}.validate()), InputError);
    EXPECT_THROW((SolidShape{{0, 3, 3}, {6, 6, 6}}.validate()), InputError);
    EXPECT_THROW((SolidShape{{3, 3, 3}, {3, 6, 6}}.validate()), InputError);
    EXPECT_THROW((SolidShape{{3, 3, 3}, {6000, 6000, 6000}}.validate()), InputError);
}

}  // namespace
}  // namespace myotet::fibres
