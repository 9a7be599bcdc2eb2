// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/Hdf5.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "Core/Errors.h"
#include "Support/TemporaryFolder.h"

namespace myotet::meshfiles {
namespace {

using myotet::testing::read_bytes;
using myotet::testing::TemporaryFolder;
using myotet::testing::write_bytes;
using ::testing::ElementsAre;

TEST(Hdf5, TablesComeBack) {
    const TemporaryFolder folder;
    const std::vector<double> reals{1.5, -2, 1.0 / 3, 4, 5e300, 6};
    const std::vector<std::int32_t> integers{1, -7};
    write_hdf5(std::vector<Table>{{"a", 3, reals, {}}, {"b", 1, {}, integers}}, folder / "a.h5");
    EXPECT_EQ(read_reals(folder / "a.h5", "a", 3), reals);
    EXPECT_EQ(read_reals(folder / "a.h5", "/a", 3), reals);
    EXPECT_THAT(read_integers(folder / "a.h5", "b", 1), ElementsAre(1, -7));
    EXPECT_THAT(read_reals(folder / "a.h5", "b", 1), ElementsAre(1, -7));
}

/// More than fit into one leaf of a group.
TEST(Hdf5, ManyTablesComeBack) {
    const TemporaryFolder folder;
    std::vector<std::vector<std::int32_t>> numbers;
    for (int n = 0; n < 300; ++n) numbers.push_back({n, n + 1});
    std::vector<Table> tables;
    for (int n = 0; n < 300; ++n) tables.push_back({"t" + std::to_string(n), 2, {}, numbers[n]});
    write_hdf5(tables, folder / "a.h5");
    for (int n = 0; n < 300; ++n)
        EXPECT_THAT(read_integers(folder / "a.h5", "t" + std::to_string(n), 2),
                    ElementsAre(n, n + 1));
}

TEST(Hdf5, WhatIsNotThereOrOfAnotherShapeIsRefused) {
    const TemporaryFolder folder;
    const auto file = folder / "a.h5";
    const std::vector<double> reals{1, 2, 3};
    write_hdf5(std::vector<Table>{{"a", 3, reals, {}}}, file);
    EXPECT_THROW((void)read_reals(file, "b", 3), IoError);
    EXPECT_THROW((void)read_reals(file, "a/b", 3), InputError);
    EXPECT_THROW((void)read_reals(file, "/", 3), InputError);
    EXPECT_THROW((void)read_reals(file, "a", 2), InputError);
    EXPECT_THROW((void)read_integers(file, "a", 3), InputError);
    EXPECT_THROW((void)read_reals(folder / "b.h5", "a", 3), IoError);
    EXPECT_THROW((void)read_reals(folder.path(), "a", 3), IoError);
    write_bytes(folder / "c.h5", std::string(200, 'x'));
    EXPECT_THROW((void)read_reals(folder / "c.h5", "a", 3), InputError);
}

/// Law: whatever byte is changed, numbers of that shape come out, or an Error.
TEST(Hdf5, ChangedAndCutFilesBreakNothing) {
    const TemporaryFolder folder;
    const auto file = folder / "a.h5";
    const std::vector<double> reals{1, 2, 3, 4, 5, 6};
    write_hdf5(std::vector<Table>{{"a", 3, reals, {}}}, file);
    const std::string whole = read_bytes(file);
    std::fstream changing(file, std::ios::binary | std::ios::in | std::ios::out);
    for (std::size_t at = 0; at < whole.size(); ++at)
        for (const char byte : {static_cast<char>(whole[at] ^ 0x15), '\xff', whole[at]}) {
            changing.seekp(static_cast<std::streamoff>(at));
            changing.put(byte).flush();  // the last one mends it
            try {
                EXPECT_EQ(read_reals(file, "a", 3).size() % 3, 0u);
            } catch (const Error&) {
                EXPECT_NE(byte, whole[at]);
            }
        }
    changing.close();
    for (std::size_t length = 0; length < whole.size(); length += 50) {
        write_bytes(file, whole.substr(0, length));
        try {
            EXPECT_EQ(read_reals(file, "a", 3), reals) << length;
        } catch (const Error&) {
        }
    }
}

/// A group whose list of names has itself as its part is left.
TEST(Hdf5, CirclesEnd) {
    const TemporaryFolder folder;
    const std::vector<double> reals{1};
    write_hdf5(std::vector<Table>{{"a", 1, reals, {}}}, folder / "a.h5");
    std::string bytes = read_bytes(folder / "a.h5");
    const std::size_t tree = bytes.find("TREE");
    bytes[tree + 5] = 9;  // level
    for (int b = 0; b < 8; ++b)
        bytes[tree + 32 + b] = b < 4 ? static_cast<char>(tree >> 8 * b & 0xff) : '\0';
    write_bytes(folder / "a.h5", bytes);
    EXPECT_THROW((void)read_reals(folder / "a.h5", "a", 1), InputError);
}

}  // namespace
}  // namespace myotet::meshfiles
