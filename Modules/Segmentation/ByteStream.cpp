// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/ByteStream.h"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "Core/Errors.h"

namespace myotet::segmentation {
namespace {

constexpr std::size_t kChunk = std::size_t{1} << 18;
// Deflate cannot pack more than 1032 bytes into one; a little more for short files.
constexpr std::uint64_t kMostInflation = 1040;
constexpr int kGzipOrZlib = 15 + 32;  // zlib's window bits for "either, by its header"

}  // namespace

bool starts_as_gzip(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    char magic[2] = {0, 0};
    in.read(magic, 2);
    return in.gcount() == 2 && magic[0] == '\x1f' && magic[1] == '\x8b';
}

struct ByteStream::Impl {
    std::filesystem::path file;
    Coding coding;
    std::ifstream in;
    std::uint64_t left = 0;  // bytes of the file not yet taken into `buffer`
    std::vector<unsigned char> buffer;
    z_stream z{};
    bool ended = false;    // the last compressed stream is complete
    bool garbage = false;  // bytes follow it

    ~Impl() {
        if (coding == Coding::deflate) inflateEnd(&z);
    }

    [[noreturn]] void cut_short(const char* part) const {
        throw IoError(file.string() + ": the file ends inside its " + part +
                      "; it is cut short: copy or export it again");
    }

    std::size_t take(void* to, std::size_t count) {
        count = static_cast<std::size_t>(std::min<std::uint64_t>(count, left));
        in.read(static_cast<char*>(to), static_cast<std::streamsize>(count));
        if (static_cast<std::size_t>(in.gcount()) != count)
            throw IoError(file.string() + ": reading failed; check the disk and the file's rights");
        left -= count;
        return count;
    }

    bool refill() {
        z.next_in = buffer.data();
        z.avail_in = static_cast<uInt>(take(buffer.data(), buffer.size()));
        return z.avail_in > 0;
    }

    /// At the end of one compressed stream: another gzip member may follow.
    void after_stream_end() {
        if (z.avail_in == 0 && !refill()) {
            ended = true;
        } else if (z.next_in[0] == 0x1f) {
            inflateReset(&z);
        } else {
            ended = garbage = true;
        }
    }

    std::size_t inflate_some(unsigned char* to, std::size_t count) {
        z.next_out = to;
        z.avail_out = static_cast<uInt>(std::min<std::size_t>(count, kChunk * 16));
        const uInt wanted = z.avail_out;
        while (z.avail_out > 0 && !ended) {
            if (z.avail_in == 0 && !refill()) cut_short("compressed data");
            const int status = inflate(&z, Z_NO_FLUSH);
            if (status == Z_STREAM_END) {
                after_stream_end();
            } else if (status != Z_OK && status != Z_BUF_ERROR) {
                throw IoError(file.string() + ": the compressed data are damaged (" +
                              (z.msg ? z.msg : "unknown reason") +
                              "); copy or export the file again");
            }
        }
        return wanted - z.avail_out;
    }
};

ByteStream::ByteStream(const std::filesystem::path& file, Coding coding, std::uint64_t offset)
    : impl_(std::make_unique<Impl>()) {
    impl_->file = file;
    impl_->coding = Coding::plain;
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(file, error);
    if (!error) impl_->in.open(file, std::ios::binary);
    if (error || !impl_->in)
        throw IoError(file.string() +
                      ": cannot be opened; check that the file exists and may be read");
    if (offset > size) impl_->cut_short("header");
    impl_->in.seekg(static_cast<std::streamoff>(offset));
    impl_->left = size - offset;
    if (coding == Coding::deflate) {
        if (inflateInit2(&impl_->z, kGzipOrZlib) != Z_OK)
            throw ResourceError(file.string() + ": no memory to inflate the file");
        impl_->coding = Coding::deflate;
        impl_->buffer.resize(kChunk);
    }
}

ByteStream::~ByteStream() = default;
ByteStream::ByteStream(ByteStream&&) noexcept = default;

std::size_t ByteStream::read(void* to, std::size_t count) {
    if (impl_->coding == Coding::plain) return impl_->take(to, count);
    std::size_t got = 0;
    while (got < count && !impl_->ended)
        got += impl_->inflate_some(static_cast<unsigned char*>(to) + got, count - got);
    return got;
}

void ByteStream::read_exactly(void* to, std::size_t count, const char* part) {
    if (read(to, count) != count) impl_->cut_short(part);
}

void ByteStream::skip(std::uint64_t count, const char* part) {
    std::vector<char> unused(static_cast<std::size_t>(std::min<std::uint64_t>(count, kChunk)));
    while (count > 0) {
        const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(count, unused.size()));
        read_exactly(unused.data(), piece, part);
        count -= piece;
    }
}

std::uint64_t ByteStream::drain() {
    std::vector<char> unused(kChunk);
    std::uint64_t surplus = 0;
    while (const std::size_t got = read(unused.data(), unused.size())) surplus += got;
    return surplus;
}

bool ByteStream::garbage_follows() const { return impl_->garbage; }

std::uint64_t ByteStream::at_most() const {
    if (impl_->coding == Coding::plain) return impl_->left;
    return (impl_->left + impl_->z.avail_in + kChunk) * kMostInflation;
}

const std::filesystem::path& ByteStream::file() const { return impl_->file; }

}  // namespace myotet::segmentation
