// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "LabelShapes.h"
#include "LevelSet/LabelGrid.h"
#include "LevelSet/VoxelBand.h"

namespace myotet::levelset {
namespace {

struct Made {
    RegionMap map;
    LabelGrid grid;
    std::vector<Claim> claims;
};
Made make(const LabelVolume& volume, double spacing) {
    Made m;
    m.map = map_regions(volume, std::vector<std::int32_t>{1});
    LabelOptions options;
    options.spacing = spacing;
    m.grid = lay_grid(volume, shared_walls(m.map, face_area(volume)), options);
    m.claims = claim_samples(m.map, m.grid.lattice);
    return m;
}

// A box of voxels 4..11 in i and j, 3..6 in k, and its exact distance.
LabelVolume box_volume(const Vec3& spacing) {
    return test::make_volume({16, 16, 10}, spacing, [](int i, int j, int k) {
        return i >= 4 && i < 12 && j >= 4 && j < 12 && k >= 3 && k < 7 ? 1 : 0;
    });
}
double box_distance(const Vec3& p, const Vec3& spacing) {
    const Vec3 low = Vec3(3.5, 3.5, 2.5).cwiseProduct(spacing);
    const Vec3 high = Vec3(11.5, 11.5, 6.5).cwiseProduct(spacing);
    const Vec3 q = (low - p).cwiseMax(p - high);
    const double outside = q.cwiseMax(0).norm();
    return outside > 0 ? outside : q.maxCoeff();
}

TEST(VoxelBand, distances_next_to_the_walls_are_exact) {
    const Vec3 spacing(0.7, 0.7, 2);
    const Made m = make(box_volume(spacing), 0.5);
    const RegionBand r = voxel_band({m.map, m.grid.lattice, m.claims, {}, 3}, 1);
    int seen = 0;
    for (std::size_t b = 0; b < r.band.position.size(); ++b)
        for (int at = 0; at < Band::kSize; ++at) {
            const Index3 p = r.band.position[b];
            const Vec3 x = r.band.origin +
                           0.5 * Vec3(8 * p[0] + at % 8, 8 * p[1] + at / 8 % 8, 8 * p[2] + at / 64);
            const double exact = box_distance(m.grid.frame.to_lps(x), spacing);
            if (std::abs(exact) > 0.5) continue;
            ++seen;
            EXPECT_NEAR(r.band.values[b * Band::kSize + at], exact, 1e-5);
        }
    EXPECT_GT(seen, 1000);
}

TEST(VoxelBand, background_is_the_rest) {
    const Made m = make(box_volume({1, 1, 1}), 1);
    const VoxelScene scene{m.map, m.grid.lattice, m.claims, {}, 3};
    const RegionBand inside = voxel_band(scene, 1), outside = voxel_band(scene, 0);
    for (const Vec3& p : {Vec3(4, 4, 4), Vec3(3.2, 8, 5), Vec3(12, 12, 7), Vec3(8, 8, 2)}) {
        const Vec3 x = m.grid.frame.to_local(p);
        EXPECT_NEAR(sample(inside.band, x).value, -sample(outside.band, x).value, 1e-5);
    }
}

TEST(VoxelBand, locks_hold_the_voxels_middles_and_what_lies_deeper) {
    const Made m = make(box_volume({1, 1, 1}), 1);
    const RegionBand r = voxel_band({m.map, m.grid.lattice, m.claims, {}, 3}, 1);
    int middles = 0;
    for (std::size_t i = 0; i < r.locks.size(); ++i) {
        const float v = r.band.values[i];
        const double bound = r.locks[i] * r.lock_unit;
        if (v > -0.6f && v < 0) {
            EXPECT_LT(bound, 0);
            EXPECT_GT(bound, -0.1);
            ++middles;
        }
        if (v < -1.4f && v > -1.6f) {
            EXPECT_LT(bound, -0.9);
        }
        if (v > 1.4f && v < 1.6f) {
            EXPECT_GT(bound, 0.9);
        }
    }
    EXPECT_GT(middles, 100);
}

}  // namespace
}  // namespace myotet::levelset
