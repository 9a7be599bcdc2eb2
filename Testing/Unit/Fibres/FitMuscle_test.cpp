// SPDX-License-Identifier: Apache-2.0
#include "Fibres/FitMuscle.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "FibreShapes.h"
#include "Fibres/Sections.h"
#include "Fibres/SurfaceDistance.h"

namespace myotet::fibres {
namespace {

// Degrees: mean and greatest error of fibres.
constexpr double kMean = 1.5, kMost = 8;
// mm: of a spindle of 5 to 10 mm radius, meshed with edges of 1.7 mm.
constexpr double kMeanDistance = 0.1, kMostDistance = 0.6;

MuscleFit fit(const TetMesh& mesh, double length, const MuscleFitOptions& options = {}) {
    return fit_muscle(mesh, test::nodes_at(mesh, 0), test::nodes_at(mesh, length), options);
}

void tell(const MuscleFit& f, const test::AngleError& error) {
    std::cout << "distance mean " << f.mean_distance << ", most " << f.max_distance
              << "; uncovered mean " << f.mean_uncovered << ", most " << f.max_uncovered
              << " mm; folded " << f.folded << "; fibres mean " << error.mean << ", 95 % "
              << error.share95 << ", most " << error.most << " degrees\n";
    for (const std::string& note : f.notes) std::cout << note << '\n';
}

/// The phantom's surface as one body: tendons and belly without the ends between them.
double whole_distance(const Vec3& p) {
    const double r = p.head<2>().norm();
    const double z = p.z();
    return std::max({r - phantoms::fusiform_radius(z), -z, z - phantoms::kFusiformLength});
}

TEST(FitMuscle, FindsTheFibresOfASpindle) {
    const TetMesh mesh = test::fusiform(6, 60);
    const MuscleFit f = fit(mesh, phantoms::kFusiformLength);
    const auto error =
        test::angle_error(mesh, solid_fibres(mesh, f.solid), phantoms::fusiform_fibre);
    tell(f, error);
    EXPECT_LT(error.mean, kMean);
    EXPECT_LT(error.most, kMost);
    EXPECT_LT(f.mean_distance, kMeanDistance);
    EXPECT_LT(f.max_distance, kMostDistance);
    EXPECT_LT(f.max_uncovered, kMostDistance);
    EXPECT_EQ(f.folded, 0);
    EXPECT_TRUE(f.notes.empty());
}

TEST(FitMuscle, FindsTheFibresOfASpindleMeshedElsewhere) {
    const std::string name = std::string(MYOTET_SHARED_DIR) + "/research/febio/d/d_D2_tet4_lc3";
    if (!std::filesystem::exists(name + ".nodes"))
        GTEST_SKIP() << "no meshes made elsewhere on this machine";
    const TetMesh mesh = test::spindle_made_elsewhere(name);
    const MuscleFit f = fit(mesh, phantoms::kFusiformLength);
    const auto error =
        test::angle_error(mesh, solid_fibres(mesh, f.solid), phantoms::fusiform_fibre);
    tell(f, error);
    EXPECT_LT(error.mean, kMean);
    EXPECT_LT(error.most, kMost);
    EXPECT_LT(f.mean_distance, kMeanDistance);
    EXPECT_EQ(f.folded, 0);
}

TEST(FitMuscle, ALevelSetBringsACoarseMeshsSolidToTheSurface) {
    const TetMesh mesh = test::fusiform(2, 24);
    const MuscleFit rough = fit(mesh, phantoms::kFusiformLength);
    MuscleFitOptions options;
    options.level_set = whole_distance;
    const MuscleFit f = fit(mesh, phantoms::kFusiformLength, options);
    const auto error =
        test::angle_error(mesh, solid_fibres(mesh, f.solid), phantoms::fusiform_fibre);
    tell(f, error);
    EXPECT_LT(error.mean, 2 * kMean);
    EXPECT_LT(f.mean_distance, kMeanDistance);
    // Twelve edges around a radius of 10 mm cut 0.3 mm off.
    const auto widest = [](const MuscleFit& m) {
        double r = 0;
        for (int n = 0; n <= 100; ++n)
            r = std::max(r, evaluate(m.solid, Vec3(n / 100.0, 0, 0.5)).position.head<2>().norm());
        return r;
    };
    EXPECT_NEAR(widest(f), phantoms::kFusiformThick, 0.1);
    EXPECT_LT(widest(rough), widest(f));
}

TEST(FitMuscle, AStraightCylinderHasStraightFibres) {
    const TetMesh mesh = test::spindle(4, 12, 40, [](double) { return 6.0; });
    const MuscleFit f = fit(mesh, 40);
    const auto error = test::angle_error(mesh, solid_fibres(mesh, f.solid),
                                         [](const Vec3&) { return Vec3(0, 0, 1); });
    tell(f, error);
    EXPECT_LT(error.most, 0.5);
    for (const Vec3& v : solid_fibres(mesh, f.solid).direction) EXPECT_GT(v.z(), 0);
}

/// Bends z = 0 to 100 into a quarter of a circle and flattens the section to a half.
Vec3 bent(const Vec3& p) {
    constexpr double kRadius = 200 / std::numbers::pi;
    const double angle = p.z() / kRadius, r = kRadius + 0.5 * p.x();
    return {r * std::cos(angle) - kRadius, p.y(), r * std::sin(angle)};
}

TEST(FitMuscle, FollowsABentFlatMuscle) {
    TetMesh mesh = test::fusiform(6, 60);
    const auto origin = test::nodes_at(mesh, 0), insertion = test::nodes_at(mesh, 100);
    const TetMesh straight = mesh;
    for (Vec3& p : mesh.points) p = bent(p);
    const MuscleFit f = fit_muscle(mesh, origin, insertion);
    const FibreField fibres = solid_fibres(mesh, f.solid);
    double mean = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const Vec3 x = centroid_of(straight, straight.tets[t]);
        const Vec3 along = 1e-4 * phantoms::fusiform_fibre(x);
        mean += test::line_angle(fibres.direction[t], bent(x + along) - bent(x - along)) /
                static_cast<double>(mesh.tets.size());
    }
    tell(f, {mean, 0, 0});
    EXPECT_LT(mean, 2 * kMean);
    EXPECT_LT(f.mean_distance, kMeanDistance);
    EXPECT_EQ(f.folded, 0);
}

TEST(FitMuscle, TurnsWithTheMuscle) {
    TetMesh mesh = test::fusiform(3, 30);
    const auto origin = test::nodes_at(mesh, 0), insertion = test::nodes_at(mesh, 100);
    // Not round: the long axis must be the same one in both.
    for (Vec3& p : mesh.points) p.y() *= 0.7;
    const auto straight = solid_fibres(mesh, fit_muscle(mesh, origin, insertion).solid);
    const Mat3 R = test::some_rotation();
    for (Vec3& p : mesh.points) p = R * p + Vec3(10, 20, 30);
    const auto turned = solid_fibres(mesh, fit_muscle(mesh, origin, insertion).solid);
    // Half a turn of the first point about the long axis changes nothing but rounding.
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        EXPECT_LT((turned.direction[t] - R * straight.direction[t]).norm(), 1e-4);
}

TEST(FitMuscle, IsTheSameOnOneThreadAndMany) {
    const TetMesh mesh = test::fusiform(3, 30);
    const MuscleFit many = fit(mesh, 100);
    const ThreadLimit limit(1);
    const MuscleFit one = fit(mesh, 100);
    EXPECT_EQ(one.solid.control, many.solid.control);
    EXPECT_EQ(one.mean_distance, many.mean_distance);
    EXPECT_EQ(one.mean_uncovered, many.mean_uncovered);
}

TEST(FitMuscle, RefusesWhatMakesNoSense) {
    const TetMesh mesh = test::fusiform(2, 10);
    MuscleFitOptions options;
    options.smoothing = 0;
    EXPECT_THROW((void)fit(mesh, 100, options), InputError);
    options = {};
    options.shape.count = {3, 6, 6};
    EXPECT_THROW((void)fit(mesh, 100, options), InputError);
    EXPECT_THROW((void)fit(mesh, 99), InputError);  // no node there
}

TEST(Sections, OfASpindleAreItsCircles) {
    const TetMesh mesh = test::fusiform(6, 50);
    std::vector<double> height;
    for (const Vec3& p : mesh.points) height.push_back(p.z());
    const auto faces = boundary_faces(mesh.tets);
    for (const double z : {1.0, 33.3, 50.0, 71.0}) {
        const Section s = section_at(mesh, faces, height, z);
        ASSERT_EQ(s.loop.size(), static_cast<std::size_t>(kLoopPoints));
        EXPECT_EQ(s.left_out, 0u);
        EXPECT_LT((s.centre - Vec3(0, 0, z)).norm(), 0.05);
        EXPECT_LT((s.normal - Vec3::UnitZ()).norm(), 1e-9);
        for (const Vec3& p : s.loop)
            EXPECT_NEAR(p.head<2>().norm() / phantoms::fusiform_radius(z), 1, 0.02);
    }
    EXPECT_TRUE(section_at(mesh, faces, height, 101).loop.empty());
}

TEST(Sections, AlignWithoutATwist) {
    const TetMesh mesh = test::fusiform(6, 50);
    std::vector<double> height;
    for (const Vec3& p : mesh.points) height.push_back(p.z());
    const auto faces = boundary_faces(mesh.tets);
    const Section first = section_at(mesh, faces, height, 30);
    Section second = section_at(mesh, faces, height, 41);
    std::rotate(second.loop.begin(), second.loop.begin() + 77, second.loop.end());
    align(first, second);
    for (int i = 0; i < kLoopPoints; ++i)
        EXPECT_LT(test::line_angle(first.loop[i] - first.centre, second.loop[i] - second.centre),
                  1.5);
}

TEST(SurfaceDistance, OfATriangleIsThatOfItsNearestPoint) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> in(-2, 2);
    const auto somewhere = [&] { return Vec3(in(random), in(random), in(random)); };
    for (int n = 0; n < 100; ++n) {
        const Vec3 a = somewhere(), b = somewhere(), c = somewhere(), p = somewhere();
        constexpr int kCuts = 200;
        double nearest = 1e9;
        for (int i = 0; i <= kCuts; ++i)
            for (int j = 0; i + j <= kCuts; ++j) {
                const double s = static_cast<double>(i) / kCuts, t = static_cast<double>(j) / kCuts;
                nearest = std::min(nearest, ((1 - s - t) * a + s * b + t * c - p).norm());
            }
        const double exact = triangle_distance(p, a, b, c);
        EXPECT_LE(exact, nearest + 1e-12);
        EXPECT_NEAR(exact, nearest, 0.03);
    }
}

}  // namespace
}  // namespace myotet::fibres
