// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>

#include "LabelShapes.h"
#include "LevelSet/Claims.h"
#include "LevelSet/LabelGrid.h"

namespace myotet::levelset {
namespace {

std::vector<Claim> claims_of(const LabelVolume& volume, double spacing, RegionMap* out = nullptr) {
    const RegionMap map = map_regions(volume, std::vector<std::int32_t>{1});
    LabelOptions options;
    options.spacing = spacing;
    const LabelGrid grid = lay_grid(volume, shared_walls(map, face_area(volume)), options);
    if (out) *out = map;
    return claim_samples(map, grid.lattice);
}

// A sheet, a tube and specks of one voxel.
LabelVolume thin_things(const Vec3& spacing) {
    return test::make_volume({30, 30, 12}, spacing, [](int i, int j, int k) {
        const bool sheet = i == 5 && j > 2 && j < 20 && k > 1 && k < 10;
        const bool tube = i == 15 && j == 8 && k > 1 && k < 10;
        const bool speck = i % 7 == 4 && i > 10 && j == 25 && k % 4 == 1;
        return sheet || tube || speck ? 1 : 0;
    });
}

TEST(Claims, none_where_samples_sit_in_the_voxels_middles) {
    EXPECT_TRUE(claims_of(thin_things({1, 1, 1}), 1).empty());
}

TEST(Claims, every_speck_has_a_sample_however_wide_the_lattice) {
    RegionMap map;
    const auto claims = claims_of(thin_things({0.3, 0.3, 1}), 0.45, &map);
    std::set<RegionMap::Owner> owners;
    for (const Claim& c : claims) owners.insert(map.owner_at(c.voxel[0], c.voxel[1], c.voxel[2]));
    EXPECT_EQ(owners.size(), map.regions.size());
    EXPECT_GT(map.regions.size(), 5u);
}

TEST(Claims, no_sample_is_claimed_twice) {
    const auto claims = claims_of(thin_things({0.3, 0.3, 1}), 0.7);
    for (std::size_t i = 1; i < claims.size(); ++i)
        EXPECT_LT(claims[i - 1].sample, claims[i].sample);
}

}  // namespace
}  // namespace myotet::levelset
