// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/Inspect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace myotet::segmentation {
namespace {

using ::testing::ElementsAre;

constexpr double kRounding = 1e-9;  // products of a few numbers

/// Boxes of labels, one painted over the other.
class Inspected : public ::testing::Test {
protected:
    Inspected() {
        volume.size = {16, 14, 12};
        volume.index_to_lps.linear() = Vec3(0.5, 1, 2).asDiagonal();
        volume.index_to_lps.translation() = Vec3(100, 200, 300);
        volume.values.assign(16 * 14 * 12, 0);
    }
    void paint(std::int32_t label, const Index3& min, const Index3& max) {
        for (int k = min[2]; k <= max[2]; ++k)
            for (int j = min[1]; j <= max[1]; ++j)
                for (int i = min[0]; i <= max[0]; ++i)
                    volume.values[volume.offset(i, j, k)] = label;
    }
    [[nodiscard]] LabelInspection of(std::int32_t label) const {
        for (LabelInspection& l : inspect(volume).labels)
            if (l.value == label) return l;
        ADD_FAILURE() << "label " << label << " is missing";
        return {};
    }
    LabelVolume volume;
};

TEST_F(Inspected, PiecesAreCountedAndPlaced) {
    paint(3, {1, 1, 1}, {2, 2, 2});
    paint(3, {5, 5, 5}, {9, 6, 7});
    paint(3, {12, 12, 10}, {12, 12, 10});
    const LabelInspection label = of(3);
    EXPECT_EQ(label.voxels, 8 + 30 + 1);
    EXPECT_NEAR(label.volume, 39 * 1.0, kRounding);
    ASSERT_EQ(label.pieces.size(), 3u);
    EXPECT_EQ(label.pieces[0].voxels, 30);
    EXPECT_EQ(label.pieces[1].voxels, 8);
    EXPECT_EQ(label.pieces[2].voxels, 1);
    EXPECT_LT((label.pieces[0].centre - Vec3(103.5, 205.5, 312)).norm(), kRounding);
    EXPECT_EQ(label.cavities.count, 0);
}

TEST_F(Inspected, CavitiesAreWhatOneLabelEncloses) {
    paint(1, {1, 1, 1}, {9, 9, 9});
    paint(0, {3, 3, 3}, {7, 7, 7});  // a void of 125
    paint(2, {4, 4, 4}, {6, 6, 6});  // with another label in it
    paint(0, {5, 5, 5}, {5, 5, 5});  // that has a void itself
    EXPECT_EQ(of(1).cavities.count, 1);
    EXPECT_EQ(of(1).cavities.voxels, 125);
    EXPECT_EQ(of(1).cavities.unlabelled_count, 0);
    EXPECT_EQ(of(2).cavities.count, 1);
    EXPECT_EQ(of(2).cavities.voxels, 1);
    EXPECT_EQ(of(2).cavities.unlabelled_count, 1);
    EXPECT_EQ(of(2).cavities.unlabelled_voxels, 1);
    EXPECT_EQ(inspect(volume).pockets, 2);
    EXPECT_EQ(inspect(volume).pocket_voxels, 125 - 27 + 1);
}

TEST_F(Inspected, AWayOutAcrossFacesOpensACavity) {
    paint(1, {1, 1, 1}, {9, 9, 9});
    paint(0, {3, 3, 3}, {7, 7, 7});
    paint(0, {2, 2, 2}, {2, 2, 2});  // an edge and a corner away: no way
    EXPECT_EQ(of(1).cavities.count, 2);
    paint(0, {1, 5, 5}, {2, 5, 5});
    EXPECT_EQ(of(1).cavities.count, 1);
    paint(2, {1, 5, 5}, {1, 5, 5});  // closed by another label: not enclosed by one
    EXPECT_EQ(of(1).cavities.count, 1);
    EXPECT_EQ(inspect(volume).pockets, 2);
}

TEST_F(Inspected, AVoidAtTheBorderIsNoCavity) {
    paint(1, {0, 0, 0}, {9, 9, 9});
    paint(0, {0, 4, 4}, {3, 6, 6});
    EXPECT_EQ(of(1).cavities.count, 0);
    EXPECT_EQ(inspect(volume).pockets, 0);
}

TEST_F(Inspected, ContactsAreFacesAndAreas) {
    paint(1, {1, 1, 1}, {4, 4, 4});
    paint(2, {5, 1, 1}, {6, 4, 4});
    paint(5, {1, 5, 1}, {4, 6, 2});
    const std::vector<Contact> contacts = of(1).contacts;
    ASSERT_EQ(contacts.size(), 3u);
    EXPECT_EQ(contacts[0].value, 0);
    EXPECT_EQ(contacts[1].value, 2);
    EXPECT_EQ(contacts[1].faces, 16);
    EXPECT_NEAR(contacts[1].area, 2.0 / 3.0 * 16 * 1 * 2, kRounding);
    EXPECT_EQ(contacts[2].value, 5);
    EXPECT_EQ(contacts[2].faces, 8);
    EXPECT_NEAR(contacts[2].area, 2.0 / 3.0 * 8 * 0.5 * 2, kRounding);
    EXPECT_EQ(contacts[0].faces, 6 * 16 - 16 - 8);
    EXPECT_EQ(of(2).contacts[1].faces, 16);
}

TEST_F(Inspected, TheAreaOfABallIsRightInTheMean) {
    // All directions of the surface occur alike; voxels of a tenth of the
    // radius leave a few percent.
    constexpr double kRadius = 10, kTolerance = 0.03;
    volume.size = {60, 30, 30};
    volume.index_to_lps.linear() = Vec3(0.5, 1, 1).asDiagonal();
    volume.values.assign(60 * 30 * 30, 0);
    for (int k = 0; k < 30; ++k)
        for (int j = 0; j < 30; ++j)
            for (int i = 0; i < 60; ++i)
                if ((Vec3(0.5 * i, j, k) - Vec3(14.7, 14.6, 14.5)).norm() < kRadius)
                    volume.values[volume.offset(i, j, k)] = 1;
    const double area = 4 * std::numbers::pi * kRadius * kRadius;
    EXPECT_NEAR(of(1).contacts.at(0).area, area, kTolerance * area);
}

TEST_F(Inspected, TheFieldOfViewCutsAtSixSides) {
    paint(1, {0, 0, 3}, {2, 4, 11});
    paint(2, {4, 4, 4}, {5, 5, 5});
    EXPECT_THAT(of(1).cut, ElementsAre(45, 0, 27, 0, 0, 15));
    EXPECT_THAT(of(2).cut, ElementsAre(0, 0, 0, 0, 0, 0));
}

TEST_F(Inspected, RadiiComeWithTheLabel) {
    paint(1, {1, 1, 1}, {12, 12, 10});  // 6 x 12 x 20 mm
    const LabelInspection label = of(1);
    EXPECT_NEAR(label.median_radius, 3, 1e-5);  // mm, of 32-bit numbers
    EXPECT_NEAR(label.pieces[0].inscribed_radius, 3, 1e-5);
    EXPECT_EQ(label.one_voxel_thick, 0);
}

TEST_F(Inspected, LayersOverlapByVoxels) {
    std::vector<LabelVolume> layers(3, volume);
    layers[0].values[5] = layers[0].values[6] = 1;
    layers[1].values[6] = layers[1].values[7] = 4;
    layers[2].values[6] = layers[2].values[7] = 2;
    const std::vector<Overlap> overlaps = find_overlaps(layers);
    ASSERT_EQ(overlaps.size(), 3u);
    EXPECT_EQ(overlaps[0].value_a, 1);
    EXPECT_EQ(overlaps[0].value_b, 4);
    EXPECT_EQ(overlaps[0].voxels, 1);
    EXPECT_EQ(overlaps[2].layer_a, 1u);
    EXPECT_EQ(overlaps[2].layer_b, 2u);
    EXPECT_EQ(overlaps[2].voxels, 2);
}

TEST_F(Inspected, NothingIsFoundInNothing) {
    EXPECT_TRUE(inspect(volume).labels.empty());
    EXPECT_EQ(inspect(volume).pockets, 0);
}

}  // namespace
}  // namespace myotet::segmentation
