// SPDX-License-Identifier: Apache-2.0
#include "Fibres/SolidFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "Core/Errors.h"
#include "SolidShapes.h"
#include "Support/TemporaryFolder.h"

namespace myotet::fibres {
namespace {

using ::testing::HasSubstr;

const std::string kHead = "myotet-bspline-solid 1\nunit mm\nframe LPS\n";
const std::string kSmall = kHead + "degree 1 1 1\ncount 2 2 2\n";
const std::string kPoints = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n";

std::string refusal(const std::string& text) {
    const testing::TemporaryFolder folder;
    testing::write_bytes(folder / "x.txt", text);
    try {
        (void)read_solid(folder / "x.txt");
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

TEST(SolidFile, ReadsBackTheSameBits) {
    const testing::TemporaryFolder folder;
    for (const SolidShape& shape : test::some_shapes()) {
        BSplineSolid solid = test::some_solid(shape);
        solid.control[0] = Vec3(-0.0, 1e-310, 1.0 / 3);
        solid.control[1] = Vec3(1e300, -4e-17, 0.1);
        write_solid(solid, folder / "solid.txt");
        const BSplineSolid again = read_solid(folder / "solid.txt");
        EXPECT_EQ(again.shape.degree, shape.degree);
        EXPECT_EQ(again.shape.count, shape.count);
        ASSERT_EQ(again.control.size(), solid.control.size());
        EXPECT_EQ(0, std::memcmp(again.control.data(), solid.control.data(),
                                 solid.control.size() * sizeof(Vec3)));
        const std::string bytes = testing::read_bytes(folder / "solid.txt");
        write_solid(again, folder / "again.txt");
        EXPECT_EQ(testing::read_bytes(folder / "again.txt"), bytes);
    }
}

TEST(SolidFile, PassesOverCommentsAndEmptyLines) {
    EXPECT_EQ(refusal("# mine\n\n" + kSmall + "# points\r\n" + kPoints + "\n"), "accepted");
}

TEST(SolidFile, SaysInWhichLineItIsBroken) {
    EXPECT_THAT(refusal(""), HasSubstr("line 0"));
    EXPECT_THAT(refusal("solid\n"), HasSubstr("line 1"));
    EXPECT_THAT(refusal("myotet-bspline-solid 1\nunit m\n"), HasSubstr("line 2"));
    EXPECT_THAT(refusal("myotet-bspline-solid 1\nunit mm\nframe RAS\n"), HasSubstr("line 3"));
    EXPECT_THAT(refusal(kHead + "degree 3 3\n"), HasSubstr("line 4"));
    EXPECT_THAT(refusal(kHead + "degree 3 3 3\ncount 3 6 6\n"), HasSubstr("line 5"));
    EXPECT_THAT(refusal(kHead + "degree 1 1 1\ncount 2 2 99999999999\n"), HasSubstr("line 5"));
    EXPECT_THAT(refusal(kHead + "degree 1 1 1\ncount 2000 2000 2000\n"), HasSubstr("10^7"));
    EXPECT_THAT(refusal(kSmall + "0 0 0\n1 0 x\n"), HasSubstr("line 7"));
    EXPECT_THAT(refusal(kSmall + "0 0 0\n1 0\n"), HasSubstr("line 7"));
    EXPECT_THAT(refusal(kSmall + "0 0 0\n1 0 inf\n"), HasSubstr("line 7"));
    EXPECT_THAT(refusal(kSmall + "0 0 0\n1 0 0 0\n"), HasSubstr("line 7"));
    EXPECT_THAT(refusal(kSmall + "0 0 0\n1 0 0\n"), HasSubstr("2 of 8"));
    EXPECT_THAT(refusal(kSmall + kPoints + "1 1 1\n"), HasSubstr("line 14"));
}

TEST(SolidFile, WritesNothingWhereItMayNot) {
    const testing::TemporaryFolder folder;
    BSplineSolid solid = test::some_solid({{1, 1, 1}, {2, 3, 5}});
    EXPECT_THROW(write_solid(solid, folder / "no/such/folder.txt"), IoError);
    solid.control.pop_back();
    EXPECT_THROW(write_solid(solid, folder / "solid.txt"), InputError);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_THROW((void)read_solid(folder / "solid.txt"), IoError);
}

}  // namespace
}  // namespace myotet::fibres
