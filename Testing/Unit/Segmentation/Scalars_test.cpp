// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/Scalars.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "Core/Errors.h"
#include "Samples.h"

namespace myotet::segmentation {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Scalars : public ::testing::Test {
protected:
    template <class T>
    std::vector<std::int32_t> read(ScalarType type, const std::vector<T>& values) {
        std::string bytes(values.size() * sizeof(T), '\0');
        std::memcpy(bytes.data(), values.data(), bytes.size());
        return read_bytes(type, static_cast<int>(values.size()), bytes, false);
    }
    std::vector<std::int32_t> read_bytes(ScalarType type, int count, const std::string& bytes,
                                         bool swap) {
        ByteStream stream(samples::write_bytes(folder.path() / "values", bytes), Coding::plain);
        warnings.clear();
        return read_scalars(stream, {type, swap, false, {count, 1, 1}}, warnings);
    }
    template <class T>
    void expect_refused(ScalarType type, T value, const char* reason) {
        try {
            (void)read<T>(type, {1, value, 2});
            ADD_FAILURE() << value;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr("voxel (1, 0, 0) has the value"));
            EXPECT_THAT(error.what(), HasSubstr(reason));
        }
    }
    ::myotet::testing::TemporaryFolder folder;
    std::vector<std::string> warnings;
};

TEST_F(Scalars, OfEveryTypeAreRead) {
    EXPECT_THAT(read<std::int8_t>(ScalarType::int8, {0, 1, 127}), ElementsAre(0, 1, 127));
    EXPECT_THAT(read<std::uint8_t>(ScalarType::uint8, {0, 1, 255}), ElementsAre(0, 1, 255));
    EXPECT_THAT(read<std::int16_t>(ScalarType::int16, {0, 32767}), ElementsAre(0, 32767));
    EXPECT_THAT(read<std::uint16_t>(ScalarType::uint16, {0, 65535}), ElementsAre(0, 65535));
    const std::int32_t last = std::numeric_limits<std::int32_t>::max();
    EXPECT_THAT(read<std::int32_t>(ScalarType::int32, {0, last}), ElementsAre(0, last));
    EXPECT_THAT(read<std::uint32_t>(ScalarType::uint32, {0, 2147483647}), ElementsAre(0, last));
    EXPECT_THAT(read<std::int64_t>(ScalarType::int64, {0, 2147483647}), ElementsAre(0, last));
    EXPECT_THAT(read<std::uint64_t>(ScalarType::uint64, {0, 2147483647}), ElementsAre(0, last));
    EXPECT_THAT(read<float>(ScalarType::float32, {-0.0F, 16777216}), ElementsAre(0, 16777216));
    EXPECT_THAT(read<double>(ScalarType::float64, {0, 2147483647}), ElementsAre(0, last));
    EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(Scalars, OfTheOtherByteOrderAreTurned) {
    EXPECT_THAT(read_bytes(ScalarType::int16, 2, std::string("\1\2\0\3", 4), true),
                ElementsAre(258, 3));
    EXPECT_THAT(read_bytes(ScalarType::float32, 1, std::string("\x40\x40\0\0", 4), true),
                ElementsAre(3));
}

TEST_F(Scalars, ThatAreNearlyWholeAreRoundedNotCut) {
    EXPECT_THAT(read<float>(ScalarType::float32, {2.9995F, 3.0005F}), ElementsAre(3, 3));
    EXPECT_THAT(warnings, IsEmpty());
    EXPECT_THAT(read<double>(ScalarType::float64, {2.976, -0.02}), ElementsAre(3, 0));
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("up to 0.024 away")));
}

TEST_F(Scalars, ThatAreNoLabelsAreRefused) {
    expect_refused<std::int8_t>(ScalarType::int8, -1, "not negative");
    expect_refused<std::int16_t>(ScalarType::int16, -1024, "not negative");
    expect_refused<std::int32_t>(ScalarType::int32, -7, "not negative");
    expect_refused<std::int64_t>(ScalarType::int64, -7, "not negative");
    expect_refused<std::uint32_t>(ScalarType::uint32, 2147483648U, "end at 2147483647");
    expect_refused<std::int64_t>(ScalarType::int64, std::int64_t{1} << 40, "end at");
    expect_refused<std::uint64_t>(ScalarType::uint64, ~std::uint64_t{0}, "end at");
    expect_refused<float>(ScalarType::float32, 2147483648.0F, "end at");
    expect_refused<float>(ScalarType::float32, 1.5F, "whole numbers");
    expect_refused<float>(ScalarType::float32, -3.0F, "not negative");
    for (const double bad : {0.5, 2.06, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()})
        expect_refused<double>(ScalarType::float64, bad, "whole numbers");
}

TEST_F(Scalars, ThatTheFileCannotHoldAreRefusedBeforeMemoryIsTaken) {
    // 2^62 bytes and more, of which the file has four.
    ByteStream stream(samples::write_bytes(folder.path() / "few", "abcd"), Coding::plain);
    const int most = std::numeric_limits<int>::max();
    EXPECT_THROW(
        (void)read_scalars(stream, {ScalarType::int32, false, false, {most, most, most}}, warnings),
        IoError);
}

}  // namespace
}  // namespace myotet::segmentation
