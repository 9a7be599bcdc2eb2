// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/ByteStream.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "Core/Errors.h"
#include "Samples.h"

namespace myotet::segmentation {
namespace {

constexpr int kZlib = 15, kGzip = 15 + 16;  // window bits

std::string pack(const std::string& plain, int window_bits) {
    z_stream z{};
    deflateInit2(&z, 6, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY);
    std::string packed(deflateBound(&z, plain.size()), '\0');
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
    z.avail_in = static_cast<uInt>(plain.size());
    z.next_out = reinterpret_cast<Bytef*>(packed.data());
    z.avail_out = static_cast<uInt>(packed.size());
    deflate(&z, Z_FINISH);
    packed.resize(z.total_out);
    deflateEnd(&z);
    return packed;
}

std::string noise(std::size_t count) {
    std::mt19937 random(1);
    std::string bytes(count, '\0');
    for (char& c : bytes) c = static_cast<char>(random() & 15);
    return bytes;
}

class Bytes : public ::testing::Test {
protected:
    std::filesystem::path write(const std::string& bytes) {
        return samples::write_bytes(folder.path() / "bytes", bytes);
    }
    static std::string read_all(ByteStream& stream) {
        std::string all, piece(1000, '\0');
        while (const std::size_t got = stream.read(piece.data(), piece.size()))
            all.append(piece, 0, got);
        return all;
    }
    ::myotet::testing::TemporaryFolder folder;
    const std::string plain = noise(1'000'000);  // several chunks
};

TEST_F(Bytes, PassUnchanged) {
    ByteStream stream(write("head" + plain), Coding::plain, 4);
    EXPECT_EQ(stream.at_most(), plain.size());
    EXPECT_EQ(read_all(stream), plain);
}

TEST_F(Bytes, AreInflatedFromGzipAndZlib) {
    for (const int format : {kZlib, kGzip}) {
        ByteStream stream(write("head" + pack(plain, format)), Coding::deflate, 4);
        EXPECT_GE(stream.at_most(), plain.size());
        EXPECT_EQ(read_all(stream), plain);
        EXPECT_FALSE(stream.garbage_follows());
    }
}

TEST_F(Bytes, OfSeveralGzipMembersFollowOneAnother) {
    ByteStream stream(write(pack(plain, kGzip) + pack("", kGzip) + pack("end", kGzip)),
                      Coding::deflate);
    EXPECT_EQ(read_all(stream), plain + "end");
    EXPECT_FALSE(stream.garbage_follows());
}

TEST_F(Bytes, BehindTheStreamAreNoticed) {
    ByteStream stream(write(pack("abc", kGzip) + "garbage"), Coding::deflate);
    EXPECT_EQ(stream.drain(), 3u);
    EXPECT_TRUE(stream.garbage_follows());
}

TEST_F(Bytes, ThatAreMissingOrDamagedAreAnError) {
    const std::string packed = pack(plain, kGzip);
    for (const std::size_t length :
         {packed.size() - 1, packed.size() - 8, packed.size() / 2, std::size_t{1}}) {
        ByteStream stream(write(packed.substr(0, length)), Coding::deflate);
        EXPECT_THROW((void)stream.drain(), IoError);
    }
    for (const std::size_t at : {std::size_t{0}, packed.size() / 2, packed.size() - 5}) {
        std::string damaged = packed;
        damaged[at] = static_cast<char>(damaged[at] ^ 4);
        ByteStream stream(write(damaged), Coding::deflate);
        EXPECT_THROW((void)stream.drain(), IoError) << at;
    }
    EXPECT_THROW(ByteStream(write("abc"), Coding::plain, 4), IoError);
    EXPECT_THROW(ByteStream(folder.path() / "absent", Coding::plain), IoError);
    ByteStream stream(write("abc"), Coding::plain);
    char four[4];
    EXPECT_THROW(stream.read_exactly(four, 4, "voxel data"), IoError);
}

TEST_F(Bytes, AreSkippedUpToTheEnd) {
    ByteStream stream(write(pack(plain, kGzip)), Coding::deflate);
    stream.skip(plain.size() - 2, "header");
    EXPECT_EQ(read_all(stream), plain.substr(plain.size() - 2));
    EXPECT_THROW(stream.skip(1, "header"), IoError);
}

TEST_F(Bytes, TellGzipByItsFirstBytes) {
    EXPECT_TRUE(starts_as_gzip(write(pack("abc", kGzip))));
    EXPECT_FALSE(starts_as_gzip(write(pack("abc", kZlib))));
    EXPECT_FALSE(starts_as_gzip(write("")));
    EXPECT_FALSE(starts_as_gzip(folder.path() / "absent"));
}

}  // namespace
}  // namespace myotet::segmentation
