// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/Npz.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "Core/Errors.h"
#include "Support/RunProgram.h"

namespace myotet::meshfiles {
namespace {

using ::testing::HasSubstr;

const std::vector<NpzArray> kArrays = {
    {"weights", 4, std::vector<double>{1, 0.5, -0.25, 0, 0.1, 0.2, 0.3, 0.4}},
    {"tets", 1, std::vector<std::int32_t>{7, -1}}};

TEST(Npz, HoldsNumbersAsTheyAre) {
    const testing::TemporaryFolder folder;
    const auto file = folder / "a.npz";
    write_npz(kArrays, file);
    const std::string bytes = testing::read_bytes(file);
    EXPECT_EQ(bytes.substr(0, 4), "PK\x03\x04");
    EXPECT_THAT(bytes, HasSubstr("'<f8', 'fortran_order': False, 'shape': (2, 4), }"));
    EXPECT_THAT(bytes, HasSubstr("'<i4', 'fortran_order': False, 'shape': (2,), }"));
    const auto& numbers = std::get<std::vector<double>>(kArrays[0].values);
    EXPECT_THAT(bytes, HasSubstr(std::string(reinterpret_cast<const char*>(numbers.data()),
                                             numbers.size() * sizeof(double))));
}

TEST(Npz, OtherProgramsReadIt) {
    const testing::TemporaryFolder folder;
    write_npz(kArrays, folder / "a.npz");
    const std::string python = "/usr/bin/python3";
    if (!std::filesystem::exists(python)) GTEST_SKIP() << "no Python here";
    // Check sums, sizes and the directory of the archive.
    EXPECT_EQ(testing::run_program(python, {"-m", "zipfile", "-t", folder / "a.npz"}).code, 0);
    if (testing::run_program(python, {"-c", "import numpy"}).code != 0)
        GTEST_SKIP() << "no numpy here";
    const testing::Ran ran = testing::run_program(
        python,
        {"-c",
         "import numpy,sys; a=numpy.load(sys.argv[1]); print(sorted(a), a['weights'].sum(), "
         "a['weights'].shape, a['tets'].tolist(), a['tets'].dtype)",
         folder / "a.npz"});
    EXPECT_EQ(ran.out, "['tets', 'weights'] 2.25 (2, 4) [7, -1] int32\n") << ran.err;
}

TEST(Npz, SaysWhatIsWrong) {
    const testing::TemporaryFolder folder;
    const std::vector<NpzArray> torn = {{"a", 3, std::vector<double>(4)}};
    const std::vector<NpzArray> twice = {{"a", 1, std::vector<double>(4)}, {"a", 1, {}}};
    EXPECT_THROW(write_npz(torn, folder / "a.npz"), MeshError);
    EXPECT_THROW(write_npz(twice, folder / "a.npz"), MeshError);
    EXPECT_THROW(write_npz(kArrays, folder / "none" / "a.npz"), IoError);
}

}  // namespace
}  // namespace myotet::meshfiles
