// SPDX-License-Identifier: Apache-2.0
#include "SoftParts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "Core/Parallel.h"
#include "LevelSet/Extract.h"
#include "Support/AnalyticLevelSet.h"
#include "Surface/Crossings.h"

namespace myotet::app {
namespace {

using levelset::LevelSet;

constexpr double kHalf = 6;  // mm; samples are 1 mm apart
const surface::Options kOptions{.edge_length = 2.4, .smallest_edge_length = 0.6};
// Of parts that do not touch the level sets stay; those that do may have to part, by
// what smoothing takes from a ridge of a sample or two.
constexpr double kMoved = 1.5;

/// Level sets and where their surfaces begin.
struct Layers {
    std::vector<LevelSet> phis;
    std::vector<TriMesh> starts;
    [[nodiscard]] std::vector<Part> parts() const {
        std::vector<Part> parts;
        for (std::size_t i = 0; i < phis.size(); ++i) parts.push_back({starts[i], phis[i], {}, {}});
        return parts;
    }
};

/// A height over the plane z = 0 that waves as no one chose; about a distance.
surface::Field waves(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    struct Wave {
        Vec3 number;
        double phase, height;
    };
    std::vector<Wave> waves(8);
    for (Wave& w : waves) {
        const double x = unit(random), y = unit(random), z = unit(random);
        const double length = 3 * (3 + unit(random));
        w.number = 2 * std::numbers::pi / length * Vec3(x, y, z).normalized();
        w.phase = std::numbers::pi * unit(random);
        w.height = 0.9 * unit(random);
    }
    return [waves](const Vec3& p) {
        surface::FieldSample s{p[2], Vec3::UnitZ()};
        for (const Wave& w : waves) {
            const double at = w.number.dot(p) + w.phase;
            s.value += w.height * std::cos(at);
            s.gradient -= w.height * std::sin(at) * w.number;
        }
        s.value /= s.gradient.norm();
        return s;
    };
}

/// A ball cut along waves into layers, `gap` apart: between heights one after the other.
Layers layers(unsigned seed, const std::vector<double>& heights, double gap) {
    const surface::Field height = waves(seed);
    Layers made;
    for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
        const double low = heights[i] + gap / 2, high = heights[i + 1] - gap / 2;
        made.phis.push_back(support::sample_level_set(support::cube(kHalf), 1, [&](const Vec3& p) {
            const double h = height(p).value;
            return std::max({low - h, h - high, p.norm() - kHalf + 1.2});
        }));
        made.starts.push_back(levelset::extract_surface(made.phis.back()));
    }
    return made;
}

std::size_t count_crossings(const std::vector<SoftSurface>& made) {
    TriMesh all;
    for (const SoftSurface& s : made) all = surface::joined(all.points, all.triangles, s.made.mesh);
    return surface::crossings(all.points, all.triangles).size();
}

std::vector<SoftSurface> make(const Layers& layers) {
    SilentProgress silent;
    return make_soft_parts(layers.parts(), kOptions, silent);
}

std::vector<SoftSurface> make_alone(const Layers& layers) {
    SilentProgress silent;
    std::vector<SoftSurface> made;
    for (const Part& part : layers.parts())
        made.push_back(make_soft_surface(part, kOptions, silent));
    return made;
}

void expect_good(const std::vector<SoftSurface>& made) {
    EXPECT_EQ(count_crossings(made), 0u);
    for (const SoftSurface& s : made) {
        EXPECT_EQ(surface::broken_promises(s.made.quality), std::vector<std::string>{});
        EXPECT_EQ(surface::shortfalls(s.made.quality), std::vector<std::string>{});
        EXPECT_LT(s.moved, kMoved);
    }
}

TEST(SoftParts, chords_of_one_part_do_not_reach_through_another) {
    int crossed = 0;
    for (unsigned seed = 0; seed < 8; ++seed) {
        SCOPED_TRACE(seed);
        const Layers two = layers(seed, {-20, 0, 20}, 0.1);
        crossed += count_crossings(make_alone(two)) > 0;
        expect_good(make(two));
    }
    EXPECT_GT(crossed, 2) << "or nothing was tried";
}

TEST(SoftParts, a_part_between_two_others) {
    for (const unsigned seed : {2u, 3u, 5u}) {
        SCOPED_TRACE(seed);
        const Layers three = layers(seed, {-20, -1.5, 1.5, 20}, 0.1);
        EXPECT_GT(count_crossings(make_alone(three)), 0u) << "or nothing was tried";
        expect_good(make(three));
    }
}

TEST(SoftParts, parts_that_share_a_wall_come_apart) {
    for (const unsigned seed : {0u, 2u}) {
        SCOPED_TRACE(seed);
        const std::vector<SoftSurface> made = make(layers(seed, {-20, 0, 20}, 0));
        expect_good(made);
        EXPECT_TRUE(made[0].softened || made[1].softened);
    }
}

TEST(SoftParts, those_that_do_not_cross_are_as_if_alone) {
    const Layers two = layers(1, {-20, 0, 20}, 1);
    const std::vector<SoftSurface> alone = make_alone(two), made = make(two);
    for (std::size_t i = 0; i < made.size(); ++i) {
        EXPECT_EQ(made[i].made.mesh.points, alone[i].made.mesh.points);
        EXPECT_EQ(made[i].made.mesh.triangles, alone[i].made.mesh.triangles);
    }
}

TEST(SoftParts, one_thread_and_many_give_the_same_bytes) {
    const Layers two = layers(3, {-20, 0, 20}, 0.1);
    std::vector<std::vector<SoftSurface>> made;
    for (const int threads : {1, 4}) {
        const ThreadLimit limit(threads);
        made.push_back(make(two));
    }
    for (std::size_t i = 0; i < made[0].size(); ++i) {
        EXPECT_EQ(made[0][i].made.mesh.points, made[1][i].made.mesh.points);
        EXPECT_EQ(made[0][i].made.mesh.triangles, made[1][i].made.mesh.triangles);
    }
}

}  // namespace
}  // namespace myotet::app
