// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/Census.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "Core/Errors.h"
#include "Samples.h"

namespace myotet::segmentation {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Sums of whole numbers are exact; only the last products round.
constexpr double kRounding = 1e-11;

TEST(Census, AgreesWithACountVoxelByVoxel) {
    LabelVolume volume = samples::make_volume(samples::oblique_axes());
    volume.size = {13, 9, 7};
    volume.values.assign(13 * 9 * 7, 0);
    std::mt19937 random(11);
    std::uniform_int_distribution<int> label(0, 4);
    for (auto& v : volume.values) v = label(random) * 1000;
    const std::vector<LabelCount> counts = count_labels(volume);
    ASSERT_EQ(counts.size(), 4u);
    std::int64_t total = std::count(volume.values.begin(), volume.values.end(), 0);
    for (const LabelCount& c : counts) {
        LabelCount expected{0, c.value, 0, volume.size, {-1, -1, -1}, Vec3::Zero()};
        for (int k = 0; k < 7; ++k)
            for (int j = 0; j < 9; ++j)
                for (int i = 0; i < 13; ++i)
                    if (volume.values[volume.offset(i, j, k)] == c.value) {
                        ++expected.voxels;
                        expected.centroid += volume.index_to_lps * Vec3(i, j, k);
                        const Index3 at{i, j, k};
                        for (int a = 0; a < 3; ++a) {
                            expected.min[a] = std::min(expected.min[a], at[a]);
                            expected.max[a] = std::max(expected.max[a], at[a]);
                        }
                    }
        EXPECT_EQ(c.voxels, expected.voxels);
        EXPECT_EQ(c.min, expected.min);
        EXPECT_EQ(c.max, expected.max);
        EXPECT_LT((c.centroid - expected.centroid / expected.voxels).norm(), kRounding);
        total += c.voxels;
    }
    EXPECT_EQ(total, 13 * 9 * 7);
    EXPECT_TRUE(std::is_sorted(counts.begin(), counts.end(),
                               [](const auto& a, const auto& b) { return a.value < b.value; }));
}

TEST(Census, OfAnEmptyVolumeIsEmpty) {
    LabelVolume volume = samples::make_volume();
    volume.values.assign(60, 0);
    EXPECT_TRUE(count_labels(volume).empty());
}

class Choice : public ::testing::Test {
protected:
    std::vector<std::int32_t> choose(const std::string& asked) {
        std::vector<std::int32_t> values;
        for (const LabelCount& c : choose_labels({&volume, 1}, counts, asked))
            values.push_back(c.value);
        return values;
    }
    void expect_refused(const std::string& asked, const char* reason) {
        try {
            (void)choose(asked);
            ADD_FAILURE() << asked;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(reason));
        }
    }
    LabelVolume volume = samples::make_volume();  // labels 1 to 4; 3 has no name
    std::vector<LabelCount> counts = count_labels(volume);
};

TEST_F(Choice, OfNothingIsEverything) {
    EXPECT_THAT(choose(""), ElementsAre(1, 2, 3, 4));
    EXPECT_THAT(choose("  "), ElementsAre(1, 2, 3, 4));
}

TEST_F(Choice, TakesValuesAndNames) {
    EXPECT_THAT(choose("4, BICEPS"), ElementsAre(1, 4));
    EXPECT_THAT(choose("2,2,1"), ElementsAre(1, 2));
    EXPECT_THAT(choose("M. Soleus,label_3"), ElementsAre(3, 4));
}

TEST_F(Choice, OfASharedNameIsAllThatCarryIt) {
    volume.names[3].name = "Biceps";
    EXPECT_THAT(choose("biceps"), ElementsAre(1, 3));
}

TEST_F(Choice, RefusesWhatIsNotThere) {
    volume.names[9].name = "tibia";
    expect_refused("7", "label 7 has no voxels in the volume, whose labels are 1 to 4");
    expect_refused("0", "label 0 has no voxels");
    expect_refused("1,bicps", "the nearest are 1 biceps");
    expect_refused("soleus", "the nearest are 4 m. soleus");
    expect_refused("tibia", "'tibia' (9) is in the name table but has no voxels");
    expect_refused(" , ", "names no label");
}

TEST(ChoiceAmongLayers, TakesAValueFromEveryLayerOrFromOne) {
    std::vector<LabelVolume> layers(2, samples::make_volume());  // labels 1 to 4 twice
    layers[1].names[1].name = "brachialis";
    const auto counts = count_labels(layers);
    ASSERT_EQ(counts.size(), 8u);
    const auto choose = [&](const std::string& asked) {
        std::vector<std::pair<int, std::int32_t>> keys;
        for (const LabelCount& c : choose_labels(layers, counts, asked))
            keys.emplace_back(c.layer, c.value);
        return keys;
    };
    using Keys = std::vector<std::pair<int, std::int32_t>>;
    EXPECT_EQ(choose("4"), (Keys{{0, 4}, {1, 4}}));
    EXPECT_EQ(choose("1:4"), (Keys{{1, 4}}));
    EXPECT_EQ(choose("brachialis,0:2"), (Keys{{0, 2}, {1, 1}}));
    EXPECT_THROW((void)choose("2:4"), InputError);
}

}  // namespace
}  // namespace myotet::segmentation
