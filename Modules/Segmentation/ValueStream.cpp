// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/ValueStream.h"

#include <charconv>

#include "Core/Errors.h"

namespace myotet::segmentation {
namespace {

constexpr std::size_t kLongestWord = 64;
// Some writers end with a line break or fill the last word; more is data that
// the header does not know, and then every voxel may lie elsewhere.
constexpr std::uint64_t kMostSurplusBytes = 16;

}  // namespace

std::string number_text(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    return {text, end};
}

std::string size_text(const ScalarLayout& layout) {
    const Index3& s = layout.size;
    const std::string text =
        std::to_string(s[0]) + " x " + std::to_string(s[1]) + " x " + std::to_string(s[2]);
    return layout.layers == 1 ? text : text + " x " + std::to_string(layout.layers);
}

ValueStream::ValueStream(ByteStream& stream, const ScalarLayout& layout)
    : stream_(stream), layout_(layout) {
    const Index3& s = layout.size;
    const double count = static_cast<double>(s[0]) * s[1] * s[2],
                 bytes = count * static_cast<double>(layout.layers) *
                         (layout.ascii ? 1.0 : static_cast<double>(size_of(layout.type)));
    if (bytes > static_cast<double>(stream.at_most()))
        throw IoError(file() + ": the header tells of " + size_text(layout) +
                      " voxels, which the file is too short to hold; it is cut short or its "
                      "header is wrong: copy or export it again");
    voxels_ = static_cast<std::size_t>(count);
}

std::string ValueStream::voxel_text(std::size_t index) const {
    const Index3& s = layout_.size;
    const std::size_t voxels = static_cast<std::size_t>(s[0]) * s[1] * s[2];
    const auto layers = static_cast<std::size_t>(layout_.layers);
    const std::size_t layer = layout_.interleaved ? index % layers : index / voxels;
    const std::size_t voxel = layout_.interleaved ? index / layers : index % voxels;
    const std::string text = "voxel (" + std::to_string(voxel % s[0]) + ", " +
                             std::to_string(voxel / s[0] % s[1]) + ", " +
                             std::to_string(voxel / s[0] / s[1]) + ")";
    return layers == 1 ? text : text + " of layer " + std::to_string(layer);
}

/// Words stand apart by white space or commas.
std::string ValueStream::next_word() {
    std::string word;
    for (;; ++at_) {
        if (at_ == filled_) {
            at_ = 0;
            filled_ = stream_.read(piece_.data(), piece_.size());
            if (filled_ == 0) return word;
        }
        const auto c = static_cast<char>(piece_[at_]);
        const bool space = c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == ',';
        if (space && !word.empty()) return word;
        if (!space && word.size() <= kLongestWord) word += c;
    }
}

double ValueStream::next_number() {
    const std::string word = next_word();
    if (word.empty()) stream_.read_exactly(piece_.data(), 1, "voxel data");
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.size() > kLongestWord || error != std::errc() || end != word.data() + word.size())
        throw InputError(file() + ": '" + word.substr(0, 40) +
                         "' stands where a value should; export the file again");
    return value;
}

void ValueStream::finish(std::vector<std::string>& warnings) {
    if (layout_.ascii && !next_word().empty())
        throw InputError(file() + ": goes on behind the last of the " + size_text(layout_) +
                         " voxels that its header tells of; correct the header's sizes or export "
                         "the file again");
    const std::uint64_t surplus = stream_.drain();
    if (surplus > kMostSurplusBytes && !layout_.ascii)
        throw InputError(file() + ": holds " + std::to_string(surplus) + " bytes more than the " +
                         size_text(layout_) +
                         " voxels that its header tells of, so its header is wrong; correct its "
                         "sizes, type or byte skip, or export the file again");
    if (surplus > 0 && !layout_.ascii)
        warnings.push_back(file() + " holds " + std::to_string(surplus) +
                           " bytes more than its header tells of; they were ignored.");
    if (stream_.garbage_follows())
        warnings.push_back(file() + " has bytes behind its compressed data; they were ignored.");
}

std::size_t size_of(ScalarType type) {
    switch (type) {
        case ScalarType::int8:
        case ScalarType::uint8:
            return 1;
        case ScalarType::int16:
        case ScalarType::uint16:
            return 2;
        case ScalarType::int32:
        case ScalarType::uint32:
        case ScalarType::float32:
            return 4;
        default:
            return 8;
    }
}

}  // namespace myotet::segmentation
