// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <sstream>

#include "Core/Errors.h"
#include "Segmentation/Formats.h"
#include "Segmentation/ItkImage.h"
#include "Segmentation/NrrdHeader.h"
#include "Segmentation/OneHot.h"
#include "Segmentation/TextHeader.h"

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

/// Volumes into layers as they are, with the names of each layer's segments.
std::vector<LabelVolume> read_layers(ByteStream& stream, const ScalarLayout& layout,
                                     const TextHeader& header, NrrdMeaning& meaning) {
    std::vector<LabelVolume> layers;
    read_volumes(stream, layout, meaning.warnings, [&](std::vector<std::int32_t>&& values) {
        layers.push_back({meaning.size, meaning.index_to_lps, std::move(values), {}});
    });
    auto names = segment_names(header, meaning.layers);
    bool any = false;
    for (std::size_t n = 0; n < layers.size(); ++n) {
        layers[n].names = std::move(names[n]);
        any |= !layers[n].names.empty();
    }
    if (!any && layers.size() > 1)
        meaning.warnings.push_back(stream.file().string() + ": its " +
                                   std::to_string(layers.size()) +
                                   " values a voxel were taken as layers of labels, though it "
                                   "names no segments.");
    return layers;
}

/// Volumes as masks of labels, which segment n of the header names.
std::vector<LabelVolume> read_one_hot(ByteStream& stream, const ScalarLayout& layout,
                                      const TextHeader& header, NrrdMeaning& meaning) {
    OneHot labels(meaning.size, stream.file());
    read_volumes(stream, layout, meaning.warnings,
                 [&](std::vector<std::int32_t>&& values) { labels.take(values); });
    std::map<std::int32_t, LabelName> names;
    std::int32_t label = 0;
    for (auto& layer : segment_names(header, meaning.layers)) {
        ++label;
        if (layer.size() == 1) names.emplace(label, std::move(layer.begin()->second));
    }
    return labels.finish(meaning.index_to_lps, names, meaning.warnings);
}

}  // namespace

LabelFile read_nrrd(const fs::path& file, const ReadOptions& options) {
    const TextHeader header = read_nrrd_header(file);
    NrrdMeaning meaning = interpret_nrrd(header, file, options.one_hot);
    const Storage storage = find_storage(header, file);
    const bool stored_big = lower_case(header.get("endian")) == "big";
    ByteStream stream = open_data(header, storage, meaning, file);
    const ScalarLayout layout{.type = meaning.type,
                              .swap_bytes = stored_big != (std::endian::native == std::endian::big),
                              .ascii = storage.ascii,
                              .size = meaning.size,
                              .layers = meaning.layers,
                              .interleaved = meaning.interleaved};
    LabelFile result;
    result.layers = options.one_hot ? read_one_hot(stream, layout, header, meaning)
                                    : read_layers(stream, layout, header, meaning);
    result.warnings = std::move(meaning.warnings);
    return result;
}

void write_nrrd(const LabelVolume& volume, const fs::path& file) {
    std::map<std::string, std::string> metadata;
    int number = 0;
    for (const auto& [value, label] : volume.names) {
        const std::string segment = "Segment" + std::to_string(number++);
        metadata[segment + "_ID"] = segment;
        metadata[segment + "_Name"] = label.name;
        metadata[segment + "_LabelValue"] = std::to_string(value);
        metadata[segment + "_Layer"] = "0";
        if (label.colour) {
            std::ostringstream text;
            text << (*label.colour)[0] << ' ' << (*label.colour)[1] << ' ' << (*label.colour)[2];
            metadata[segment + "_Color"] = text.str();
        }
    }
    write_itk(volume, file, ItkFormat::nrrd, metadata);
}

}  // namespace myotet::segmentation
