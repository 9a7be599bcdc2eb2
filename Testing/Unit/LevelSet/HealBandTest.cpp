// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "CrackedShapes.h"
#include "LevelSet/FromSurface.h"
#include "LevelSet/HealBand.h"
#include "LevelSet/Measure.h"
#include "LevelSet/WindingTree.h"

namespace myotet::levelset {
namespace {

constexpr double kRadius = 10, kSpacing = 0.5;
const Vec3 kCentre(1, 2, 3);
// The polyhedron of the tests lies 0.05 mm inside its sphere.
constexpr double kBall = 4.0 / 3.0 * std::numbers::pi * kRadius * kRadius * kRadius;

SilentProgress silent;

TriMesh sphere() { return test::sphere_surface(kCentre, kRadius, 30); }

/// Leaves out what lies above a height over the centre.
TriMesh without_cap(double height) {
    TriMesh surface = sphere();
    std::erase_if(surface.triangles, [&](const Triangle& t) {
        return (surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]]).z() / 3 >
               kCentre.z() + height;
    });
    return surface;
}

struct Healed {
    LevelSet phi;
    HealSummary summary;
};

Healed heal(const TriMesh& surface, double spacing = kSpacing) {
    Healed healed;
    healed.phi = from_surface(surface, {.spacing = spacing, .heal = true}, silent, &healed.summary);
    return healed;
}

double volume_of(const TriMesh& surface) { return enclosed_volume(heal(surface).phi); }

TEST(HealBand, a_closed_surface_takes_the_same_way_as_without) {
    const Healed healed = heal(sphere());
    const LevelSet plain = from_surface(sphere(), {.spacing = kSpacing}, silent);
    EXPECT_EQ(healed.phi.values, plain.values);
    EXPECT_EQ(healed.summary.open_edges, 0);
    EXPECT_EQ(healed.summary.guessed_area, 0);
}

TEST(HealBand, away_from_a_hole_distances_are_as_exact_as_without_one) {
    TriMesh surface = sphere();
    surface.triangles.pop_back();  // at the south pole
    const LevelSet healed = heal(surface).phi;
    const LevelSet plain = from_surface(sphere(), {.spacing = kSpacing}, silent);
    const WindingTree truth = build_winding_tree(sphere());
    double healed_worst = 0, plain_worst = 0;
    for (const Vec3& u : test::directions(300)) {
        if (u.z() < -0.9) continue;
        for (const double d : {-0.4, 0.1, 0.3}) {
            const Vec3 p = kCentre + (kRadius + d) * u;
            const double distance = std::copysign(distance_to_triangles(truth, p, 2), d);
            healed_worst = std::max(healed_worst, std::abs(healed.value(p) - distance));
            plain_worst = std::max(plain_worst, std::abs(plain.value(p) - distance));
        }
    }
    constexpr double kAlike = 1.1;  // two hundred thousand roundings of 32-bit numbers
    EXPECT_LT(healed_worst, kAlike * plain_worst);
}

TEST(HealBand, half_a_ball_is_closed_by_a_disc) {
    // By symmetry the winding number is 1/2 exactly on the disc.
    const Healed healed = heal(without_cap(0));
    constexpr double kTolerance = 0.02;  // a row of triangles is 0.1 of the radius high
    EXPECT_NEAR(enclosed_volume(healed.phi), 0.5 * kBall, kTolerance * kBall);
    const double disc = std::numbers::pi * kRadius * kRadius;
    // The rim follows the triangles up and down.
    EXPECT_NEAR(healed.summary.guessed_area, disc, 0.05 * disc);
    EXPECT_NEAR(healed.summary.guessed_share, 1.0 / 3.0, 0.02);  // disc : half sphere = 1 : 2
    EXPECT_EQ(healed.summary.holes, 1);
    EXPECT_GT(healed.summary.doubtful_share, 0);
}

TEST(HealBand, a_missing_cap_costs_no_more_than_what_is_above_the_plane) {
    for (const double height : {7.0, 8.5}) {
        const double above = kRadius - height;  // of the cap
        const double cap = std::numbers::pi * above * above * (kRadius - above / 3);
        const double volume = volume_of(without_cap(height));
        constexpr double kTolerance = 0.02;  // one row of triangles, and the polyhedron
        EXPECT_GT(volume, kBall - cap - kTolerance * kBall);
        EXPECT_LT(volume, kBall);
    }
}

TEST(HealBand, missing_triangles_are_bridged) {
    TriMesh surface = sphere();
    std::mt19937 random(3);
    std::erase_if(surface.triangles, [&](const Triangle&) { return random() % 10 == 0; });
    // A tenth of the surface, in holes of a triangle or two.
    EXPECT_NEAR(volume_of(surface), kBall, 0.02 * kBall);
}

TEST(HealBand, cracks_and_overlaps_of_shifted_patches_are_bridged) {
    const TriMesh surface = test::cut_into_patches(sphere(), 5, 0.2);
    const Healed healed = heal(surface);
    // Shifts of 0.2 mm cancel in the mean of some hundred patches; a shell of
    // 0.1 mm is 3 % of the ball.
    EXPECT_NEAR(enclosed_volume(healed.phi), kBall, 0.03 * kBall);
    EXPECT_EQ(healed.summary.turned_triangles, 0);
    EXPECT_GT(healed.summary.open_edges, 100);
    EXPECT_GT(healed.summary.crossing_pairs, 0);
    // Cracks and steps of some 0.2 mm on all four sides of patches of 5 mm.
    EXPECT_LT(healed.summary.guessed_share, 4 * 0.2 / 5);
}

TEST(HealBand, doubled_and_reversed_triangles_do_no_harm) {
    TriMesh surface = sphere();
    surface.triangles.pop_back();
    std::mt19937 random(5);
    const std::size_t all = surface.triangles.size();
    for (std::size_t n = 0; n < all; ++n) {
        if (random() % 10 == 0) surface.triangles.push_back(surface.triangles[n]);
        if (random() % 10 == 0) std::swap(surface.triangles[n][0], surface.triangles[n][1]);
    }
    EXPECT_NEAR(volume_of(surface), kBall, 0.02 * kBall);
}

TEST(HealBand, parts_that_cross_become_one) {
    // Two balls with a hole each, their centres a radius apart.
    TriMesh one = sphere();
    one.triangles.pop_back();
    TriMesh two = one;
    for (Vec3& p : two.points) p.x() += kRadius;
    const double lens = 5.0 / 12.0 * std::numbers::pi * kRadius * kRadius * kRadius;
    const Healed healed = heal(test::together(one, two));
    EXPECT_NEAR(enclosed_volume(healed.phi), 2 * kBall - lens, 0.02 * kBall);
    // Walls inside the other ball are no interface.
    const double value = healed.phi.value(kCentre + Vec3(kRadius, 0, 0));
    EXPECT_LT(value, -8);
}

TEST(HealBand, same_bytes_for_any_number_of_threads) {
    const auto make = [](int threads) {
        const ThreadLimit limit(threads);
        return heal(test::cut_into_patches(without_cap(6), 5, 0.1));
    };
    const Healed one = make(1), two = make(2);
    EXPECT_EQ(one.phi.brick_of, two.phi.brick_of);
    EXPECT_EQ(one.phi.values, two.phi.values);
    EXPECT_EQ(one.summary.guessed_area, two.summary.guessed_area);
}

TEST(HealBand, what_encloses_nothing_is_refused) {
    TriMesh sheet;
    sheet.points = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    EXPECT_THROW((void)heal(sheet), InputError);
}

TEST(HealBand, an_open_surface_is_refused_with_the_remedy) {
    try {
        (void)from_surface(without_cap(8), {.spacing = kSpacing}, silent);
        FAIL() << "an open surface was accepted";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("--heal"));
    }
}

TEST(HealBand, crossing_triangles_of_a_closed_surface_are_a_warning) {
    struct Ears final : ProgressSink {
        void report(std::string_view, double) override {}
        void warn(std::string_view sentence) override { heard += sentence; }
        void note(std::string_view) override {}
        std::string heard;
    } ears;
    TriMesh other = sphere();
    for (Vec3& p : other.points) p.x() += kRadius;
    HealSummary summary;
    (void)from_surface(test::together(sphere(), other), {.spacing = kSpacing}, ears, &summary);
    EXPECT_GT(summary.crossing_pairs, 0);
    EXPECT_THAT(ears.heard, ::testing::HasSubstr("crosses itself"));
}

/// Points and triangles of a .obj; points at one place become one.
TriMesh read_obj(const std::filesystem::path& file) {
    TriMesh surface;
    std::map<std::array<double, 3>, std::int32_t> known;
    std::vector<std::int32_t> number;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string key;
        words >> key;
        if (key == "v") {
            std::array<double, 3> p{};
            words >> p[0] >> p[1] >> p[2];
            const auto next = static_cast<std::int32_t>(surface.points.size());
            const auto [it, fresh] = known.try_emplace(p, next);
            if (fresh) surface.points.emplace_back(p[0], p[1], p[2]);
            number.push_back(it->second);
        } else if (key == "f") {
            Triangle t{};
            for (std::int32_t& v : t) {
                std::string corner;
                words >> corner;
                v = number.at(std::stoul(corner) - 1);
            }
            if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) surface.triangles.push_back(t);
        }
    }
    return surface;
}

TEST(HealBand, cracked_muscles_keep_the_volume_that_winding_voxels_have) {
    const auto folder =
        std::filesystem::path(MYOTET_SHARED_DIR) / "data/surfaces_arm/bodyparts3d_right_arm";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
    // Voxels of 1 mm whose centre has a winding number of 1/2 or more.
    const std::vector<std::pair<std::string, double>> voxels = {
        {"teres_minor__FMA32553", 37595}, {"coracobrachialis__FMA37665", 21248}};
    constexpr double kTolerance = 0.01;  // a voxel's rounding in the mean, lost tips
    for (const auto& [name, volume] : voxels) {
        const Healed healed = heal(read_obj(folder / (name + ".obj")), 1);
        EXPECT_NEAR(enclosed_volume(healed.phi), volume, kTolerance * volume) << name;
        EXPECT_GT(healed.summary.open_edges, 0);
        EXPECT_LT(healed.summary.guessed_share, 0.001);  // slits, not holes
    }
}

}  // namespace
}  // namespace myotet::levelset
