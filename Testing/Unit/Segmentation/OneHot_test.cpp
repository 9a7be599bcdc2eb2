// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/OneHot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Core/Errors.h"

namespace myotet::segmentation {
namespace {

TEST(OneHot, VolumeNIsLabelNPlusOne) {
    OneHot labels({3, 1, 1}, "scan");
    labels.take({1, 0, 0});
    labels.take({0, 0, 0});
    labels.take({0, 9, 9});
    labels.take({1, 1, 0});
    std::vector<std::string> warnings;
    const auto layers = labels.finish(Eigen::Affine3d::Identity(), {{4, {"d", {}}}}, warnings);
    ASSERT_EQ(layers.size(), 2u);
    EXPECT_EQ(layers[0].values, (std::vector<std::int32_t>{1, 3, 3}));
    EXPECT_EQ(layers[1].values, (std::vector<std::int32_t>{4, 4, 0}));
    EXPECT_EQ(layers[1].name_of(4), "d");
    EXPECT_THAT(warnings, ::testing::ElementsAre(::testing::HasSubstr("volume 2,")));
}

TEST(OneHot, RefusesAVolumeOfSeveralValues) {
    OneHot labels({3, 1, 1}, "scan");
    EXPECT_THROW(labels.take({1, 2, 0}), InputError);
}

}  // namespace
}  // namespace myotet::segmentation
