// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <random>

#include "BandShapes.h"
#include "LevelSet/Measure.h"
#include "LevelSet/Seams.h"

namespace myotet::levelset {
namespace {

using Corners = Seams::Corners;

double interpolate(const Corners& v, const Vec3& t) {
    double sum = 0;
    for (int c = 0; c < 8; ++c)
        sum += v[c] * (c & 1 ? t.x() : 1 - t.x()) * (c & 2 ? t.y() : 1 - t.y()) *
               (c & 4 ? t.z() : 1 - t.z());
    return sum;
}

// phi of a region in a cell, as a level set gives it.
double phi_at(std::span<const Corners> regions, std::size_t own, const Vec3& t) {
    std::vector<Corners> pieces;
    find_pieces(regions, own, 0.25f, pieces);
    if (pieces.empty()) {  // the partitioned samples themselves
        pieces.emplace_back();
        for (int c = 0; c < 8; ++c) {
            float others = std::numeric_limits<float>::infinity();
            for (std::size_t r = 0; r < regions.size(); ++r)
                if (r != own) others = std::min(others, regions[r][c]);
            pieces[0][c] = 0.5f * (regions[own][c] - others);
        }
    }
    double largest = -std::numeric_limits<double>::infinity();
    for (const Corners& p : pieces) largest = std::max(largest, interpolate(p, t));
    return largest;
}

std::vector<Corners> random_regions(std::mt19937& random, int count) {
    std::uniform_real_distribution<float> value(-1, 1);
    std::vector<Corners> regions(static_cast<std::size_t>(count));
    for (Corners& r : regions)
        for (float& v : r) v = value(random);
    return regions;
}

TEST(Seams, every_point_of_a_cell_is_in_exactly_one_region) {
    // Values are floats: closer than their rounding to a wall nothing is said.
    constexpr double kRounding = 1e-6;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int trial = 0; trial < 300; ++trial) {
        const auto regions = random_regions(random, 2 + trial % 4);
        for (int point = 0; point < 20; ++point) {
            const Vec3 t(unit(random), unit(random), unit(random));
            int claims = 0;
            bool near = false;
            for (std::size_t r = 0; r < regions.size(); ++r) {
                const double v = phi_at(regions, r, t);
                claims += v < 0;
                near = near || std::abs(v) < kRounding;
            }
            if (near) continue;
            ASSERT_EQ(claims, 1) << "trial " << trial;
        }
    }
}

TEST(Seams, two_regions_need_none) {
    std::mt19937 random(2);
    std::vector<Corners> pieces;
    const auto regions = random_regions(random, 2);
    for (const std::size_t own : {0, 1}) {
        find_pieces(regions, own, 0.25f, pieces);
        EXPECT_TRUE(pieces.empty());
    }
}

TEST(Seams, volumes_of_three_sectors_add_up_to_the_cell) {
    // f_r = -d_r . (x - centre): sectors of 120 degrees about a line along z.
    std::vector<Corners> regions(3), pieces;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 8; ++c) {
            const double angle = 0.3 + 2 * M_PI * r / 3;
            regions[r][c] = static_cast<float>(-std::cos(angle) * ((c & 1) - 0.4) -
                                               std::sin(angle) * ((c >> 1 & 1) - 0.55));
        }
    // The three corners are rounded, together by a third of one small cell's face.
    constexpr double kTolerance = 0.35 / (kSeamSplit * kSeamSplit);
    double sum = 0;
    for (std::size_t r = 0; r < 3; ++r) {
        find_pieces(regions, r, 0.25f, pieces);
        ASSERT_EQ(pieces.size(), 2u);
        sum += inside_fraction(pieces);
    }
    EXPECT_NEAR(sum, 1, kTolerance);
}

TEST(Seams, are_found_again_in_a_level_set) {
    const Vec3 centre(16.2, 15.9, 16.4);
    const LevelSet plain = assemble(test::make_band(test::sphere_field(centre, 9), 4, 1));
    // Pieces that differ from the samples, in cells of several bricks.
    Seams seams;
    for (const Index3& cell : {Index3{25, 16, 16}, Index3{6, 15, 16}, Index3{16, 24, 17},
                               Index3{24, 15, 16}, Index3{16, 16, 7}}) {
        seams.cell.push_back(cell);
        seams.first.push_back(static_cast<std::uint32_t>(seams.piece.size()));
        Corners first, second;
        first.fill(static_cast<float>(cell[0]));
        second.fill(static_cast<float>(cell[1]));
        seams.piece.push_back(first);
        seams.piece.push_back(second);
    }
    LevelSet sewn = plain;
    attach_seams(sewn, seams);
    EXPECT_EQ(sewn.pieces.size(), seams.piece.size());
    for (const Index3& c : seams.cell)
        EXPECT_EQ(sewn.value(Vec3(c[0] + 0.3, c[1] + 0.6, c[2] + 0.2)), std::max(c[0], c[1]));
    for (double x = 2.5; x < 30; ++x)
        for (double y = 2.5; y < 30; ++y)
            for (double z = 2.5; z < 30; ++z) {
                const bool seam =
                    std::any_of(seams.cell.begin(), seams.cell.end(), [&](const Index3& c) {
                        return c[0] == int(x) && c[1] == int(y) && c[2] == int(z);
                    });
                if (seam) continue;
                ASSERT_EQ(sewn.value({x, y, z}), plain.value({x, y, z}));
            }
}

}  // namespace
}  // namespace myotet::levelset
