// SPDX-License-Identifier: Apache-2.0
#include "Core/Sha256.h"

#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <vector>

#include "Core/Errors.h"

namespace myotet {
namespace {

constexpr std::size_t kBlock = 64;

/// First 32 bits of the fractions of the cube roots of the first 64 primes
/// (FIPS 180-4, sec. 4.2.2).
constexpr std::array<std::uint32_t, 64> kRound = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

class Hash {
public:
    /// Takes whole blocks; returns what is left over.
    std::string_view take_blocks(std::string_view bytes) {
        length_ += bytes.size() / kBlock * kBlock;
        for (; bytes.size() >= kBlock; bytes.remove_prefix(kBlock)) take_block(bytes.data());
        return bytes;
    }
    /// Takes the last bytes, fewer than a block, and pads (sec. 5.1.1).
    std::string finish(std::string_view rest) {
        const std::uint64_t bits = 8 * (length_ + rest.size());
        std::string tail(rest);
        tail += '\x80';
        while (tail.size() % kBlock != kBlock - 8) tail += '\0';
        for (int shift = 56; shift >= 0; shift -= 8) tail += static_cast<char>(bits >> shift);
        take_blocks(tail);
        std::string hex;
        for (const std::uint32_t word : state_)
            for (int shift = 28; shift >= 0; shift -= 4)
                hex += "0123456789abcdef"[word >> shift & 15];
        return hex;
    }

private:
    void take_block(const char* bytes) {  // sec. 6.2.2
        std::array<std::uint32_t, 64> w;
        for (int t = 0; t < 16; ++t) {
            w[t] = 0;
            for (int i = 0; i < 4; ++i)
                w[t] = w[t] << 8 | static_cast<unsigned char>(bytes[4 * t + i]);
        }
        for (int t = 16; t < 64; ++t) {
            const std::uint32_t x = w[t - 15], y = w[t - 2];
            w[t] = w[t - 16] + w[t - 7] + (std::rotr(x, 7) ^ std::rotr(x, 18) ^ x >> 3) +
                   (std::rotr(y, 17) ^ std::rotr(y, 19) ^ y >> 10);
        }
        auto [a, b, c, d, e, f, g, h] = state_;
        for (int t = 0; t < 64; ++t) {
            const std::uint32_t t1 = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                                     ((e & f) ^ (~e & g)) + kRound[t] + w[t];
            const std::uint32_t t2 = (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) +
                                     ((a & b) ^ (a & c) ^ (b & c));
            h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
        }
        const std::array<std::uint32_t, 8> sum = {a, b, c, d, e, f, g, h};
        for (int i = 0; i < 8; ++i) state_[i] += sum[i];
    }

    /// From the square roots of the first eight primes (sec. 5.3.3).
    std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                           0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::uint64_t length_ = 0;
};

}  // namespace

std::string sha256(std::string_view bytes) {
    Hash hash;
    const std::string_view rest = hash.take_blocks(bytes);
    return hash.finish(rest);
}

std::string sha256_of_file(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::vector<char> piece(1024 * kBlock);
    Hash hash;
    std::string_view rest;
    while (in) {
        in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        rest = hash.take_blocks({piece.data(), static_cast<std::size_t>(in.gcount())});
    }
    if (!in.eof() || std::filesystem::is_directory(file))
        throw IoError(file.string() + ": cannot be read; check its name and permissions");
    return hash.finish(rest);
}

}  // namespace myotet
