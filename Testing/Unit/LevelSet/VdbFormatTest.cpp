// SPDX-License-Identifier: Apache-2.0
// Against OpenVDB itself, which writes what is read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>

#include "Core/Errors.h"
#include "LevelSet/VdbFormat.h"
#include "Support/TemporaryFolder.h"

namespace myotet::levelset {
namespace {

using openvdb::FloatGrid;
using ::testing::HasSubstr;

constexpr float kHalfPrecision = 1e-3f;  // of a value: 11 bits

/// Of no class: level sets are never zipped.
FloatGrid::Ptr ball() {
    const auto grid = openvdb::tools::createLevelSetSphere<FloatGrid>(6, {1, 2, 3}, 0.5, 3);
    grid->setName("ball");
    grid->setGridClass(openvdb::GRID_UNKNOWN);
    grid->insertMeta("label", openvdb::Int32Metadata(7));
    return grid;
}

/// As File writes it, where other grids can be passed over.
std::string bytes_of(const openvdb::GridPtrVec& grids, std::uint32_t compression) {
    const testing::TemporaryFolder folder;
    openvdb::io::File file((folder / "a.vdb").string());
    file.setCompression(compression);
    file.write(grids);
    std::ifstream in(folder / "a.vdb", std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void expect_same(const VdbGrid& read, const FloatGrid& written, float precision) {
    ASSERT_TRUE(read.has_samples);
    EXPECT_EQ(read.text.at("name"), "ball");
    EXPECT_EQ(read.text.at("class"), "unknown");
    EXPECT_EQ(read.whole.at("label"), 7);
    EXPECT_NEAR(read.background, written.background(), precision);
    ASSERT_EQ(read.leaves.size(), written.tree().leafCount());
    ASSERT_EQ(read.values.size(), read.leaves.size() * VdbGrid::kLeafSize);
    const float* value = read.values.data();
    const auto accessor = written.getConstAccessor();
    for (const Index3& leaf : read.leaves) {
        ASSERT_TRUE(accessor.getTree()->probeConstLeaf({leaf[0], leaf[1], leaf[2]}));
        for (int i = 0; i < 8; ++i)
            for (int j = 0; j < 8; ++j)
                for (int k = 0; k < 8; ++k, ++value) {
                    const float truth = accessor.getValue({leaf[0] + i, leaf[1] + j, leaf[2] + k});
                    ASSERT_NEAR(*value, truth, precision * std::abs(truth));
                }
    }
    EXPECT_EQ(read.axes[1], Vec3(0, 0.5, 0));
}

class VdbFormat : public ::testing::Test {
protected:
    void SetUp() override { openvdb::initialize(); }
};

TEST_F(VdbFormat, EveryPackingHoldsTheSameNumbers) {
    using namespace openvdb::io;
    for (const std::uint32_t packing : {0u, 0u + COMPRESS_ZIP, 0u + COMPRESS_BLOSC})
        for (const std::uint32_t mask : {0u, 0u + COMPRESS_ACTIVE_MASK})
            for (const bool half : {false, true}) {
                SCOPED_TRACE(std::to_string(packing | mask) + (half ? " half" : ""));
                const FloatGrid::Ptr grid = ball();
                grid->setSaveFloatAsHalf(half);
                const auto read = parse_vdb(bytes_of({grid}, packing | mask));
                ASSERT_EQ(read.size(), 1u);
                expect_same(read[0], *grid, half ? kHalfPrecision : 0);
            }
}

TEST_F(VdbFormat, AllThatLeavesCanHoldBesidesActiveValues) {
    // One other number, two, the background alone, its negative: each leaf its own form.
    const FloatGrid::Ptr grid = ball();
    int number = 0;
    for (auto leaf = grid->tree().beginLeaf(); leaf; ++leaf, ++number)
        for (auto value = leaf->beginValueOff(); value; ++value) {
            const bool odd = value.pos() % 2;
            const float background = grid->background();
            value.setValue(number % 5 == 0   ? background
                           : number % 5 == 1 ? -background
                           : number % 5 == 2 ? 4.25f
                           : number % 5 == 3 ? (odd ? 4.25f : background)
                                             : (odd ? 4.25f : -2.5f));
        }
    expect_same(parse_vdb(bytes_of({grid}, openvdb::io::COMPRESS_ACTIVE_MASK))[0], *grid, 0);
}

TEST_F(VdbFormat, OtherGridsArePassedOver) {
    const FloatGrid::Ptr grid = ball(), shared = ball();
    shared->setTree(grid->treePtr());
    const auto read = parse_vdb(
        bytes_of({openvdb::Vec3DGrid::create(), grid, shared}, openvdb::io::COMPRESS_ACTIVE_MASK));
    ASSERT_EQ(read.size(), 3u);
    EXPECT_EQ(read[0].type, "Tree_vec3d_5_4_3");
    EXPECT_FALSE(read[0].has_samples);
    expect_same(read[1], *grid, 0);
    EXPECT_FALSE(read[2].has_samples) << "its samples are the other's";
}

TEST_F(VdbFormat, StreamsSayNoOffsets) {
    const auto streamed = [](const openvdb::GridPtrVec& grids) {
        std::ostringstream out;
        openvdb::io::Stream(out).write(grids);
        return out.str();
    };
    const FloatGrid::Ptr grid = ball();
    expect_same(parse_vdb(streamed({grid}))[0], *grid, 0);
    EXPECT_THROW((void)parse_vdb(streamed({openvdb::Vec3DGrid::create(), grid})), InputError);
}

TEST_F(VdbFormat, EveryCutIsAnError) {
    const std::string whole = bytes_of({ball()}, openvdb::io::COMPRESS_ACTIVE_MASK);
    for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 301)
        EXPECT_THROW((void)parse_vdb(std::string_view(whole).substr(0, length)), InputError);
}

TEST_F(VdbFormat, BytesThatAreOthersEndInNoOtherWay) {
    using namespace openvdb::io;
    for (const std::uint32_t packing : {COMPRESS_ZIP, COMPRESS_BLOSC}) {
        const std::string whole = bytes_of({ball()}, packing | COMPRESS_ACTIVE_MASK);
        for (const char other : {'\x01', '\x7f', '\x80', '\xff'})
            for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 151) {
                std::string bytes = whole;
                bytes[at] = static_cast<char>(bytes[at] ^ other);
                try {
                    (void)parse_vdb(bytes);
                } catch (const InputError&) {
                }
            }
    }
}

TEST_F(VdbFormat, SizesOfChunksAreHeldAgainstWhatTheyFill) {
    // The size of an unpacked chunk is its negative: OpenVDB reads as much, into
    // a buffer of what it should be.
    const FloatGrid::Ptr noise = FloatGrid::create(3);
    std::mt19937 random(1);  // bytes that zlib cannot make fewer
    for (const openvdb::Coord& at : openvdb::CoordBBox({0, 0, 0}, {7, 7, 7})) {
        const std::uint32_t bits = random();
        float value;
        std::memcpy(&value, &bits, sizeof value);
        noise->tree().setValue(at, value);
    }
    std::string bytes =
        bytes_of({noise}, openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
    const std::int64_t size = -2048;
    const std::string said(reinterpret_cast<const char*>(&size), sizeof size);
    const std::size_t at = bytes.rfind(said);
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(parse_vdb(bytes).size(), 1u);
    const std::int64_t more = -4096;
    std::memcpy(bytes.data() + at, &more, sizeof more);
    bytes.resize(bytes.size() + 8192);
    try {
        (void)parse_vdb(bytes);
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("has another size than its 2048 bytes"));
    }
}

}  // namespace
}  // namespace myotet::levelset
