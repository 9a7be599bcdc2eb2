// SPDX-License-Identifier: Apache-2.0
#include "Core/Sha256.h"

#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "Support/TemporaryFolder.h"

namespace myotet {
namespace {

// Known answers of NIST's examples for FIPS 180-4.
TEST(Sha256, KnownAnswers) {
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256(std::string(1'000'000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, AFileAsItsBytes) {
    const testing::TemporaryFolder folder;
    for (const std::size_t size : {0, 1, 55, 56, 63, 64, 65, 65535, 65536, 65537, 200000}) {
        const std::string bytes(size, '\x9c');
        testing::write_bytes(folder / "file", bytes);
        EXPECT_EQ(sha256_of_file(folder / "file"), sha256(bytes)) << size;
    }
    EXPECT_THROW((void)sha256_of_file(folder / "absent"), IoError);
    EXPECT_THROW((void)sha256_of_file(folder.path()), IoError);
}

}  // namespace
}  // namespace myotet
