// SPDX-License-Identifier: Apache-2.0
#include <sstream>

#include "Segmentation/Formats.h"
#include "Segmentation/ItkImage.h"
#include "Segmentation/NrrdData.h"
#include "Segmentation/OneHot.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

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
    NrrdMeaning meaning =
        interpret_nrrd(header, file, options.one_hot ? NrrdHolds::masks : NrrdHolds::labels);
    NrrdData data = open_nrrd_data(header, meaning, file);
    LabelFile result;
    result.layers = options.one_hot ? read_one_hot(data.stream, data.layout, header, meaning)
                                    : read_layers(data.stream, data.layout, header, meaning);
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
