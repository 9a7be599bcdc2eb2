// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

namespace myotet::segmentation {

/// How the bytes of a payload are stored.
enum class Coding {
    plain,    ///< as they are
    deflate,  ///< gzip (one or several members) or zlib
};

/// True when the file starts as a gzip file does, whatever its name says.
[[nodiscard]] bool starts_as_gzip(const std::filesystem::path& file);

/// The bytes of a file from `offset` on, inflated when they are compressed,
/// read once from front to back in bounded memory. A damaged or unfinished
/// stream is an IoError: the image libraries return what they got of it.
class ByteStream {
public:
    ByteStream(const std::filesystem::path& file, Coding coding, std::uint64_t offset = 0);
    ~ByteStream();
    ByteStream(ByteStream&&) noexcept;

    /// Up to `count` bytes; fewer only at the end. Throws IoError.
    std::size_t read(void* to, std::size_t count);
    /// All `count` bytes, or an IoError that the file is cut short in its `part`.
    void read_exactly(void* to, std::size_t count, const char* part);
    /// Passes over `count` bytes; the same error.
    void skip(std::uint64_t count, const char* part);
    /// Passes over what is left and so verifies the checksum at the end.
    /// Returns how many bytes were left.
    std::uint64_t drain();
    /// True when bytes that belong to no compressed stream follow it (known after drain).
    [[nodiscard]] bool garbage_follows() const;
    /// Most bytes that can still come: what a header claims beyond is a lie.
    [[nodiscard]] std::uint64_t at_most() const;
    [[nodiscard]] const std::filesystem::path& file() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace myotet::segmentation
