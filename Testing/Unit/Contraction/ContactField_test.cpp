// SPDX-License-Identifier: Apache-2.0
#include "Contraction/ContactField.h"

#include "ContactShapes.h"
#include "Core/Progress.h"
#include "LevelSet/FromSurface.h"

namespace myotet::contraction {
namespace {

// Samples are floats: values of up to 10 mm, 1e-6; their slopes over 0.5 mm.
constexpr double kFloat = 2e-6, kFloatSlope = 1e-5;

TEST(ContactField, APlaneIsAPlane) {
    const ContactField floor = test::floor_field();
    for (const Vec3& p : test::random_vectors(50, 5, 1)) {
        const FieldSample s = floor.sample(p);
        EXPECT_NEAR(s.value, p.z(), kFloat);
        EXPECT_LT((s.gradient - Vec3::UnitZ()).norm(), kFloatSlope);
    }
}

TEST(ContactField, ABallIsFoundAsFarInAsTheHeaderSays) {
    constexpr double radius = 10, h = 0.5;
    const ContactField ball = test::ball_field(radius, h);
    constexpr double shift = h * h * 2 / radius / 8;
    for (const Vec3& d : test::random_vectors(50, 1, 1)) {
        const FieldSample s = ball.sample(radius * d.normalized());
        // Beyond the second order: (h / R)^3 of R, 1e-4.
        EXPECT_NEAR(s.value, shift, 2e-4);
        EXPECT_LT((s.gradient - d.normalized()).norm(), 2e-3);
        EXPECT_NEAR(s.curvature.trace(), 2 / radius, 0.01);
    }
}

// A level set as the program makes it: a narrow band, a far field, and nothing outside.
ContactField cube_of_surface(const Frame& frame) {
    const TetMesh mesh = test::block(1, 20);
    SilentProgress progress;
    return {std::make_shared<levelset::LevelSet>(
                levelset::from_surface(boundary_surface(mesh), {.spacing = 0.5}, progress)),
            frame};
}

TEST(ContactField, GradientAndCurvatureAreDerivativesEverywhere) {
    Frame frame;
    frame.rotation = Eigen::AngleAxisd(0.7, Vec3(3, 1, 2).normalized()).toRotationMatrix();
    frame.origin = {5, -3, 8};
    const ContactField cube = cube_of_surface(frame);
    for (const Vec3& r : test::random_vectors(200, 14, 2)) {
        const Vec3 p = frame.to_lps(Vec3::Constant(10) + r);
        const FieldSample s = cube.sample(p);
        for (int a = 0; a < 3; ++a) {
            const Vec3 e = test::kStep * Vec3::Unit(a);
            const FieldSample up = cube.sample(p + e), down = cube.sample(p - e);
            EXPECT_NEAR((up.value - down.value) / (2 * test::kStep), s.gradient[a],
                        10 * test::kDifference);
            EXPECT_LT(
                ((up.gradient - down.gradient) / (2 * test::kStep) - s.curvature.col(a)).norm(),
                1e-4);  // third derivatives are jumps of 1 / h^2 between cells
        }
    }
}

TEST(ContactField, DeepInsideStillPushesOut) {
    const ContactField cube = cube_of_surface({});
    for (double depth = 0.5; depth < 9; depth += 0.5) {
        const FieldSample s = cube.sample({depth, 10.2, 9.7});
        EXPECT_NEAR(s.value, -depth, 0.3) << depth;  // of the far field: samples 2 mm apart
        EXPECT_LT(s.gradient.x(), -0.7) << depth;
    }
}

TEST(ContactField, NothingFarAwayAndTheSameNear) {
    const ContactField cube = cube_of_surface({});
    int near = 0;
    for (const Vec3& r : test::random_vectors(2000, 14, 3)) {
        const Vec3 p = Vec3::Constant(10) + r;
        const FieldSample s = cube.sample(p);
        for (const double bound : {-1.0, 0.3, 3.0}) {
            const auto below = cube.sample_below(bound, p);
            ASSERT_EQ(below.has_value(), s.value < bound) << p.transpose();
            if (!below) continue;
            ++near;
            EXPECT_EQ(below->value, s.value);
            EXPECT_EQ(below->gradient, s.gradient);
        }
    }
    EXPECT_GT(near, 1000);
}

}  // namespace
}  // namespace myotet::contraction
