// SPDX-License-Identifier: Apache-2.0
#include "Fibres/ImageFibres.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "FibreShapes.h"

namespace myotet::fibres {
namespace {

using ::testing::HasSubstr;
constexpr double kRounding = 1e-12;

/// Over the spindle with a margin, in voxels of 1.5 x 2 x 4 mm along turned axes.
VectorImage image_of(const std::function<Vec3(const Vec3&)>& vector) {
    VectorImage image;
    image.size = {64, 52, 28};
    const Mat3 direction = Eigen::AngleAxisd(0.5, Vec3(1, 2, 8).normalized()).toRotationMatrix();
    const Vec3 spacing(1.5, 2, 4);
    const Vec3 middle(0, 0, 50), half = 0.5 * spacing.cwiseProduct(Vec3(63, 51, 27));
    image.index_to_lps = place_image(spacing, middle - direction * half, direction);
    for (int k = 0; k < image.size[2]; ++k)
        for (int j = 0; j < image.size[1]; ++j)
            for (int i = 0; i < image.size[0]; ++i)
                image.vectors.push_back(vector(image.index_to_lps * Vec3(i, j, k)));
    return image;
}

TEST(ImageFibres, OfAConstantImageAreConstantWhateverTheSignsAndLengths) {
    const Vec3 v = Vec3(1, -2, 3).normalized();
    std::mt19937 random(6);
    const VectorImage image = image_of([&](const Vec3&) {
        return (random() % 2 ? -1.0 : 1.0) * (0.5 + static_cast<double>(random() % 10)) * v;
    });
    const TetMesh mesh = test::fusiform(3, 20);
    const FibreField fibres = image_fibres(mesh, image);
    for (const Vec3& f : fibres.direction)
        EXPECT_LT(std::min((f - v).norm(), (f + v).norm()), kRounding);
    EXPECT_TRUE(fibres.notes.empty());
}

TEST(ImageFibres, AreThoseOfTheSpindle) {
    const TetMesh mesh = test::fusiform(4, 40);
    const auto error = test::angle_error(
        mesh, image_fibres(mesh, image_of(phantoms::fusiform_fibre)), phantoms::fusiform_fibre);
    std::cout << "mean " << error.mean << ", 95 % " << error.share95 << ", most " << error.most
              << " degrees\n";
    // Voxels of 4 mm along slopes that change by 15 degrees over 15 mm.
    EXPECT_LT(error.mean, 0.5);
    EXPECT_LT(error.most, 3);
}

TEST(ImageFibres, PointFromOriginToInsertionIfTheseAreGiven) {
    std::mt19937 random(6);
    const VectorImage image = image_of([&](const Vec3& p) -> Vec3 {
        return (random() % 2 ? -1.0 : 1.0) * phantoms::fusiform_fibre(p);
    });
    const TetMesh mesh = test::fusiform(3, 20);
    const auto low = test::nodes_at(mesh, 0), high = test::nodes_at(mesh, 100);
    for (const Vec3& f : image_fibres(mesh, image, {low, high}).direction) EXPECT_GT(f.z(), 0.9);
    for (const Vec3& f : image_fibres(mesh, image, {high, low}).direction) EXPECT_LT(f.z(), -0.9);
    EXPECT_THROW((void)image_fibres(mesh, image, {low, {}}), InputError);
}

TEST(ImageFibres, PassOverVoxelsWithoutAVector) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::mt19937 random(6);
    const VectorImage image = image_of([&](const Vec3& p) -> Vec3 {
        if (p.z() > 60 && p.z() < 80) return Vec3::Zero();
        return random() % 3 == 0 ? Vec3(nan, 0, 1) : Vec3(0, 0, 2);
    });
    const FibreField fibres = image_fibres(test::fusiform(3, 20), image);
    for (const Vec3& f : fibres.direction) EXPECT_LT((f - Vec3::UnitZ()).norm(), kRounding);
    ASSERT_EQ(fibres.notes.size(), 1u);
    EXPECT_THAT(fibres.notes[0], HasSubstr("neighbours"));
}

TEST(ImageFibres, InterpolatesDyadsBetweenVoxels) {
    VectorImage image;
    image.size = {2, 1, 1};
    const Vec3 a = Vec3(1, 1, 0).normalized(), b = Vec3(-1, 0, 0);
    image.vectors = {a, b};
    // A tetrahedron whose centroid lies in the middle of the two.
    const TetMesh mesh{{{0.4, -0.1, -0.1}, {0.8, -0.1, -0.1}, {0.4, 0.3, -0.1}, {0.4, -0.1, 0.3}},
                       {{0, 1, 2, 3}},
                       {}};
    ASSERT_LT((centroid_of(mesh, mesh.tets[0]) - Vec3(0.5, 0, 0)).norm(), kRounding);
    const Vec3 f = image_fibres(mesh, image).direction[0];
    EXPECT_NEAR(test::line_angle(f, a), 22.5, 1e-9);
    EXPECT_NEAR(test::line_angle(f, b), 22.5, 1e-9);
}

TEST(ImageFibres, SayHowManyTetrahedraLieOutside) {
    VectorImage image = image_of([](const Vec3&) { return Vec3(0, 0, 1); });
    image.index_to_lps.pretranslate(Vec3(0, 0, 60));
    try {
        (void)image_fibres(test::fusiform(3, 20), image);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("of 3240 tetrahedra lie outside"));
    }
}

TEST(ImageFibres, RefuseImagesThatCannotBe) {
    const TetMesh mesh = test::fusiform(2, 10);
    const VectorImage good = image_of([](const Vec3&) { return Vec3(0, 0, 1); });
    VectorImage image = good;
    image.vectors.pop_back();
    EXPECT_THROW((void)image_fibres(mesh, image), InputError);
    image = good;
    image.size[1] = 0;
    EXPECT_THROW((void)image_fibres(mesh, image), InputError);
    image = good;
    image.index_to_lps.linear().col(1).setZero();
    EXPECT_THROW((void)image_fibres(mesh, image), InputError);
    image = image_of([](const Vec3&) -> Vec3 { return Vec3::Zero(); });
    EXPECT_THROW((void)image_fibres(mesh, image), InputError);
}

TEST(ImageFibres, AreTheSameOnOneThreadAndMany) {
    const TetMesh mesh = test::fusiform(3, 20);
    const VectorImage image = image_of(phantoms::fusiform_fibre);
    const auto many = image_fibres(mesh, image).direction;
    const ThreadLimit limit(1);
    EXPECT_EQ(image_fibres(mesh, image).direction, many);
}

}  // namespace
}  // namespace myotet::fibres
