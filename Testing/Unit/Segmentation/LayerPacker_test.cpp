// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/LayerPacker.h"

#include <gtest/gtest.h>

#include "Core/Errors.h"

namespace myotet::segmentation {
namespace {

using Mask = std::vector<std::uint8_t>;

std::size_t add(LayerPacker& packer, std::int32_t label, const Mask& mask, std::size_t offset = 0) {
    const MaskRun run{offset, mask};
    return packer.add(label, {&run, 1});
}

TEST(LayerPacker, SharesALayerAmongLabelsThatDoNotOverlap) {
    LayerPacker packer({2, 2, 2}, "scan");
    EXPECT_EQ(add(packer, 7, Mask{1, 1, 0, 0}), 0u);
    EXPECT_EQ(add(packer, 3, Mask{0, 1, 1, 0}), 1u);
    EXPECT_EQ(add(packer, 5, Mask{1, 1, 1, 1}, 4), 0u);
    EXPECT_EQ(add(packer, 4, Mask{0, 0, 0, 1}), 0u);
    const auto layers = packer.finish(Eigen::Affine3d::Identity(),
                                      {{7, {"a", {}}}, {3, {"b", {}}}, {9, {"absent", {}}}});
    ASSERT_EQ(layers.size(), 2u);
    EXPECT_EQ(layers[0].values, (std::vector<std::int32_t>{7, 7, 0, 4, 5, 5, 5, 5}));
    EXPECT_EQ(layers[1].values, (std::vector<std::int32_t>{0, 3, 3, 0, 0, 0, 0, 0}));
    EXPECT_EQ(layers[0].name_of(7), "a");
    EXPECT_EQ(layers[1].name_of(3), "b");
    EXPECT_EQ(layers[1].names.size(), 1u);
}

TEST(LayerPacker, WithoutLabelsIsOneEmptyLayer) {
    LayerPacker packer({2, 1, 1}, "scan");
    const auto layers = packer.finish(Eigen::Affine3d::Identity(), {});
    ASSERT_EQ(layers.size(), 1u);
    EXPECT_EQ(layers[0].values, (std::vector<std::int32_t>{0, 0}));
}

TEST(LayerPacker, TakesNoMoreMemoryThanItMay) {
    LayerPacker packer({2, 1, 1}, "scan", 4);
    EXPECT_EQ(add(packer, 1, Mask{1, 1}), 0u);
    EXPECT_EQ(add(packer, 2, Mask{1, 1}), 1u);
    EXPECT_THROW((void)add(packer, 3, Mask{1, 1}), ResourceError);
}

}  // namespace
}  // namespace myotet::segmentation
