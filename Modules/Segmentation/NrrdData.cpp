// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/NrrdData.h"

#include <algorithm>
#include <bit>

#include "Core/Errors.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

/// Where the voxels lie and how they are stored.
struct Storage {
    fs::path file;
    std::uint64_t offset = 0;
    Coding coding = Coding::plain;
    bool ascii = false;
};

std::uint64_t data_bytes(const NrrdMeaning& meaning) {
    std::uint64_t bytes = size_of(meaning.type) * static_cast<std::uint64_t>(meaning.layers);
    for (const int n : meaning.size) bytes *= static_cast<std::uint64_t>(n);
    return bytes;
}

/// The byte at which line `count` starts, counted from `offset` on.
std::uint64_t skip_lines(const fs::path& file, std::uint64_t offset, std::int64_t count) {
    if (count <= 0) return offset;
    ByteStream stream(file, Coding::plain, offset);
    for (char c = 0; count > 0; ++offset) {
        stream.read_exactly(&c, 1, "lines to skip");
        if (c == '\n') --count;
    }
    return offset;
}

Storage find_storage(const TextHeader& header, const fs::path& file) {
    Storage storage{file, header.data_offset, Coding::plain, false};
    std::string data = header.get("data file");
    if (data.empty()) data = header.get("datafile");
    if (!data.empty()) storage = {data_file_beside(file, data), 0, Coding::plain, false};
    const std::string encoding = lower_case(header.get("encoding"));
    if (encoding == "gzip" || encoding == "gz") {
        storage.coding = Coding::deflate;
    } else if (encoding == "ascii" || encoding == "text" || encoding == "txt") {
        storage.ascii = true;
    } else if (encoding != "raw") {
        throw InputError(file.string() + ": voxels are stored with the encoding '" + encoding +
                         "', but raw, gzip and ascii are read; save it with gzip");
    }
    return storage;
}

ByteStream open_data(const TextHeader& header, const Storage& storage, const NrrdMeaning& meaning,
                     const fs::path& file) {
    const auto number = [&](const char* spaced, const char* joined) {
        std::string text = header.get(spaced);
        if (text.empty()) text = header.get(joined);
        return text.empty() ? std::int64_t{0} : whole_number(text, spaced, file);
    };
    const std::uint64_t offset =
        skip_lines(storage.file, storage.offset, number("line skip", "lineskip"));
    const std::int64_t skip = number("byte skip", "byteskip");
    if (skip < -1)
        throw InputError(file.string() + ": the header's byte skip is " + std::to_string(skip) +
                         " but must be -1 or a number of bytes; correct the header");
    std::uint64_t to_skip = static_cast<std::uint64_t>(std::max<std::int64_t>(skip, 0));
    if (skip < 0) {  // the data are what the stream ends with
        const std::uint64_t all = ByteStream(storage.file, storage.coding, offset).drain();
        to_skip = all - std::min(all, data_bytes(meaning));
    }
    ByteStream stream(storage.file, storage.coding, offset);
    stream.skip(to_skip, "bytes to skip");
    return stream;
}

}  // namespace

NrrdData open_nrrd_data(const TextHeader& header, const NrrdMeaning& meaning,
                        const fs::path& file) {
    const Storage storage = find_storage(header, file);
    const bool stored_big = lower_case(header.get("endian")) == "big";
    return {open_data(header, storage, meaning, file),
            {.type = meaning.type,
             .swap_bytes = stored_big != (std::endian::native == std::endian::big),
             .ascii = storage.ascii,
             .size = meaning.size,
             .layers = meaning.layers,
             .interleaved = meaning.interleaved}};
}

}  // namespace myotet::segmentation
