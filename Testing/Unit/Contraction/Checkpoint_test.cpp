// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "Core/Errors.h"
#include "Core/Sha256.h"
#include "Support/TemporaryFolder.h"

namespace myotet::contraction {
namespace {

using myotet::testing::read_bytes;
using myotet::testing::TemporaryFolder;
using myotet::testing::write_bytes;
using ::testing::HasSubstr;

Checkpoint moment() {
    using Limits = std::numeric_limits<double>;
    return {.fingerprint = sha256("scene"),
            .time = 0.1 + 0.2,
            .reals = {{"biceps/x", {1.0 / 3, -0.0, Limits::denorm_min(), Limits::max()}},
                      {"odd", {Limits::infinity(), Limits::quiet_NaN()}},
                      {"empty", {}}},
            .integers = {{"step", {std::numeric_limits<std::int64_t>::min(), 7}}, {"none", {}}}};
}

std::vector<std::uint64_t> bits(const std::vector<double>& values) {
    std::vector<std::uint64_t> all;
    for (const double value : values) all.push_back(std::bit_cast<std::uint64_t>(value));
    return all;
}

TEST(Checkpoint, ReadsBackBitForBit) {
    const TemporaryFolder folder;
    write_checkpoint(moment(), folder / "a.checkpoint");
    const Checkpoint back = read_checkpoint(folder / "a.checkpoint", sha256("scene"));
    EXPECT_EQ(back.time, moment().time);
    EXPECT_EQ(back.fingerprint, moment().fingerprint);
    ASSERT_EQ(back.reals.size(), moment().reals.size());
    for (const auto& [name, values] : moment().reals)
        EXPECT_EQ(bits(back.reals_of(name, values.size())), bits(values)) << name;
    EXPECT_EQ(back.integers, moment().integers);
    EXPECT_EQ(back.integers_of("step", 2)[1], 7);
    write_checkpoint(back, folder / "b.checkpoint");
    EXPECT_EQ(read_bytes(folder / "a.checkpoint"), read_bytes(folder / "b.checkpoint"));
}

TEST(Checkpoint, AnotherSceneIsRefusedInWords) {
    const TemporaryFolder folder;
    write_checkpoint(moment(), folder / "a");
    try {
        (void)read_checkpoint(folder / "a", sha256("another scene"));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("belongs to another scene"));
    }
}

TEST(Checkpoint, EveryDamageIsFound) {
    const TemporaryFolder folder;
    write_checkpoint(moment(), folder / "a");
    const std::string whole = read_bytes(folder / "a");
    for (std::size_t length = 0; length < whole.size(); length += 7) {
        write_bytes(folder / "b", whole.substr(0, length));
        EXPECT_THROW((void)read_checkpoint(folder / "b", sha256("scene")), Error) << length;
    }
    for (std::size_t at = 0; at < whole.size(); at += 5) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ 4);
        write_bytes(folder / "b", bytes);
        EXPECT_THROW((void)read_checkpoint(folder / "b", sha256("scene")), Error) << at;
    }
    write_bytes(folder / "b", whole + "more");
    EXPECT_THROW((void)read_checkpoint(folder / "b", sha256("scene")), IoError);
}

/// What a file with these bytes, their sum put right, is refused for.
std::string refusal(std::string bytes) {
    const TemporaryFolder folder;
    constexpr std::size_t kSum = 64;
    bytes.replace(bytes.size() - kSum, kSum, sha256(bytes.substr(0, bytes.size() - kSum)));
    write_bytes(folder / "a", bytes);
    try {
        (void)read_checkpoint(folder / "a", sha256("scene"));
    } catch (const Error& error) {
        return error.what();
    }
    return "no refusal";
}

TEST(Checkpoint, OtherKindsOfFilesAreRefusedInWords) {
    const TemporaryFolder folder;
    write_checkpoint(moment(), folder / "a");
    const std::string whole = read_bytes(folder / "a");
    const auto changed = [&](std::size_t at, char byte) {
        std::string bytes = whole;
        bytes[at] = byte;
        return refusal(bytes);
    };
    EXPECT_THAT(changed(0, 'X'), HasSubstr("is no checkpoint"));
    EXPECT_THAT(changed(8, 2), HasSubstr("version 2"));
    EXPECT_THAT(changed(12, 1), HasSubstr("byte order"));
    // The number of arrays, and the length of a name, as large as can be.
    EXPECT_THAT(changed(16 + 64 + 8 + 7, 127), HasSubstr("damaged"));
    EXPECT_THAT(changed(16 + 64 + 8 + 8 + 7, 127), HasSubstr("damaged"));
    EXPECT_THROW((void)read_checkpoint(folder / "absent", sha256("scene")), IoError);
    EXPECT_THROW(write_checkpoint(moment(), folder / "no/such/a"), IoError);
}

TEST(Checkpoint, ArraysAreAskedForByNameAndLength) {
    EXPECT_THROW((void)moment().reals_of("biceps/v", 4), InputError);
    EXPECT_THROW((void)moment().reals_of("biceps/x", 5), InputError);
    EXPECT_THROW((void)moment().integers_of("step", 1), InputError);
}

}  // namespace
}  // namespace myotet::contraction
