// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/Scalars.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <type_traits>

#include "Core/Errors.h"

namespace myotet::segmentation {
namespace {

// Labels written through floating-point tools come back this exact.
constexpr double kExact = 1e-3;
// The Colin27 atlas of 2008 is off by 0.024; interpolated labels are off by far more.
constexpr double kNearlyWhole = 0.05;
constexpr std::size_t kChunkBytes = std::size_t{1} << 20;
constexpr double kMostValue = std::numeric_limits<std::int32_t>::max();
// The largest value of a type that an int32 holds: a float skips 2^31 - 1.
template <class T>
constexpr T kMost = std::is_same_v<T, float> ? T(2147483520) : T(kMostValue);
constexpr std::size_t kLongestWord = 64;
// Some writers end with a line break or fill the last word; more is data that
// the header does not know, and then every voxel may lie elsewhere.
constexpr std::uint64_t kMostSurplusBytes = 16;

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

template <class T>
void swap_all(unsigned char* bytes, std::size_t count) {
    if constexpr (sizeof(T) > 1)
        for (std::size_t n = 0; n < count; ++n)
            std::reverse(bytes + n * sizeof(T), bytes + (n + 1) * sizeof(T));
}

/// Takes values from a stream, one run after another, and checks each.
class Reader {
public:
    Reader(ByteStream& stream, const ScalarLayout& layout) : stream_(stream), layout_(layout) {}

    /// Appends the next `count` values to `values`.
    void read(std::size_t count, std::vector<std::int32_t>& values);
    /// Passes over what is left and warns of it, or refuses.
    void finish(std::vector<std::string>& warnings);

private:
    template <class T>
    void read_binary(std::size_t count, std::vector<std::int32_t>& values);
    template <class T>
    void take_all(const unsigned char* bytes, std::size_t count, std::int32_t* out);
    void read_ascii(std::size_t count, std::vector<std::int32_t>& values);
    [[nodiscard]] std::string next_word();
    [[nodiscard]] std::int32_t checked(double value, std::size_t index);
    [[noreturn]] void refuse(std::size_t index, double value) const;
    [[nodiscard]] std::string voxel_text(std::size_t index) const;

    ByteStream& stream_;
    const ScalarLayout& layout_;
    std::vector<unsigned char> chunk_ = std::vector<unsigned char>(kChunkBytes);
    std::size_t at_ = 0, filled_ = 0;  // what of the chunk is text not yet taken
    std::size_t done_ = 0;             // values taken
    double worst_ = 0;                 // largest distance from a whole number
};

std::string Reader::voxel_text(std::size_t index) const {
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

void Reader::refuse(std::size_t index, double value) const {
    const std::string where =
        stream_.file().string() + ": " + voxel_text(index) + " has the value " + number_text(value);
    if (!std::isfinite(value) || std::abs(value - std::nearbyint(value)) > kNearlyWhole)
        throw InputError(where +
                         ", but labels are whole numbers; this looks like an image or a "
                         "resampled label map: resample with nearest neighbour");
    if (value < 0)
        throw InputError(where +
                         ", but labels are not negative; this looks like an image, not a "
                         "segmentation");
    throw InputError(where + ", but labels end at 2147483647; give it a smaller number");
}

std::int32_t Reader::checked(double value, std::size_t index) {
    const double whole = std::nearbyint(value), off = std::abs(value - whole);
    if (!(off <= kNearlyWhole && whole >= 0 && whole <= kMostValue)) refuse(index, value);
    worst_ = std::max(worst_, off);
    return static_cast<std::int32_t>(whole);
}

template <class T>
void Reader::take_all(const unsigned char* bytes, std::size_t count, std::int32_t* out) {
    bool bad = false;
    for (std::size_t n = 0; n < count; ++n) {
        T v;
        std::memcpy(&v, bytes + n * sizeof(T), sizeof(T));
        if constexpr (std::is_floating_point_v<T>) {
            const T whole = std::nearbyint(v), off = std::abs(v - whole);
            const bool good = off <= T(kNearlyWhole) && whole >= 0 && whole <= kMost<T>;
            bad |= !good;
            worst_ = std::max(worst_, good ? static_cast<double>(off) : 0.0);
            out[n] = good ? static_cast<std::int32_t>(whole) : 0;
        } else {
            if constexpr (std::is_signed_v<T>) bad |= v < 0;
            if constexpr (sizeof(T) >= 4 && !std::is_same_v<T, std::int32_t>) bad |= v > kMost<T>;
            out[n] = static_cast<std::int32_t>(v);
        }
    }
    for (std::size_t n = 0; bad && n < count; ++n) {  // the slow way, to name the first
        T v;
        std::memcpy(&v, bytes + n * sizeof(T), sizeof(T));
        out[n] = checked(static_cast<double>(v), done_ + n);
    }
}

template <class T>
void Reader::read_binary(std::size_t count, std::vector<std::int32_t>& values) {
    while (count > 0) {
        const std::size_t piece = std::min(count, kChunkBytes / sizeof(T));
        stream_.read_exactly(chunk_.data(), piece * sizeof(T), "voxel data");
        if (layout_.swap_bytes) swap_all<T>(chunk_.data(), piece);
        values.resize(values.size() + piece);
        take_all<T>(chunk_.data(), piece, values.data() + values.size() - piece);
        done_ += piece;
        count -= piece;
    }
}

/// The next word of a text; words stand apart by white space or commas.
std::string Reader::next_word() {
    std::string word;
    for (;; ++at_) {
        if (at_ == filled_) {
            at_ = 0;
            filled_ = stream_.read(chunk_.data(), chunk_.size());
            if (filled_ == 0) return word;
        }
        const auto c = static_cast<char>(chunk_[at_]);
        const bool space = c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == ',';
        if (space && !word.empty()) return word;
        if (!space && word.size() <= kLongestWord) word += c;
    }
}

void Reader::read_ascii(std::size_t count, std::vector<std::int32_t>& values) {
    for (; count > 0; --count) {
        const std::string word = next_word();
        if (word.empty()) stream_.read_exactly(chunk_.data(), 1, "voxel data");
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (word.size() > kLongestWord || error != std::errc() || end != word.data() + word.size())
            throw InputError(stream_.file().string() + ": '" + word.substr(0, 40) +
                             "' stands where a label value should; export the file again");
        values.push_back(checked(value, done_++));
    }
}

void Reader::read(std::size_t count, std::vector<std::int32_t>& values) {
    if (layout_.ascii) return read_ascii(count, values);
    switch (layout_.type) {
        case ScalarType::int8:
            return read_binary<std::int8_t>(count, values);
        case ScalarType::uint8:
            return read_binary<std::uint8_t>(count, values);
        case ScalarType::int16:
            return read_binary<std::int16_t>(count, values);
        case ScalarType::uint16:
            return read_binary<std::uint16_t>(count, values);
        case ScalarType::int32:
            return read_binary<std::int32_t>(count, values);
        case ScalarType::uint32:
            return read_binary<std::uint32_t>(count, values);
        case ScalarType::int64:
            return read_binary<std::int64_t>(count, values);
        case ScalarType::uint64:
            return read_binary<std::uint64_t>(count, values);
        case ScalarType::float32:
            return read_binary<float>(count, values);
        case ScalarType::float64:
            return read_binary<double>(count, values);
    }
}

void Reader::finish(std::vector<std::string>& warnings) {
    const std::string file = stream_.file().string();
    if (layout_.ascii && !next_word().empty())
        throw InputError(file + ": goes on behind the last of the " + size_text(layout_) +
                         " voxels that its header tells of; correct the header's sizes or export "
                         "the file again");
    const std::uint64_t surplus = stream_.drain();
    if (surplus > kMostSurplusBytes && !layout_.ascii)
        throw InputError(file + ": holds " + std::to_string(surplus) + " bytes more than the " +
                         size_text(layout_) +
                         " voxels that its header tells of, so its header is wrong; correct its "
                         "sizes, type or byte skip, or export the file again");
    if (surplus > 0 && !layout_.ascii)
        warnings.push_back(file + " holds " + std::to_string(surplus) +
                           " bytes more than its header tells of; they were ignored.");
    if (stream_.garbage_follows())
        warnings.push_back(file + " has bytes behind its compressed data; they were ignored.");
    if (worst_ > kExact)
        warnings.push_back(file + ": label values are up to " +
                           number_text(std::round(worst_ * 1e4) / 1e4) +
                           " away from whole numbers and were rounded.");
}

/// The number of voxels of a volume, refused when the file cannot hold them all.
std::size_t checked_count(const ByteStream& stream, const ScalarLayout& layout) {
    const Index3& s = layout.size;
    const double count = static_cast<double>(s[0]) * s[1] * s[2],
                 bytes = count * static_cast<double>(layout.layers) *
                         (layout.ascii ? 1.0 : static_cast<double>(size_of(layout.type)));
    if (bytes > static_cast<double>(stream.at_most()))
        throw IoError(stream.file().string() + ": the header tells of " + size_text(layout) +
                      " voxels, which the file is too short to hold; it is cut short or its "
                      "header is wrong: copy or export it again");
    return static_cast<std::size_t>(count);
}

using Volumes = std::vector<std::vector<std::int32_t>>;

/// Volumes of which the file holds a voxel's values together.
Volumes read_interleaved(Reader& reader, std::size_t layers, std::size_t voxels) {
    Volumes volumes(layers);
    for (auto& volume : volumes) volume.reserve(voxels);
    std::vector<std::int32_t> run;
    for (std::size_t done = 0; done < voxels;) {
        const std::size_t piece =
            std::min(voxels - done, std::max<std::size_t>(kChunkBytes / layers, 1));
        run.clear();
        reader.read(piece * layers, run);
        for (std::size_t n = 0; n < run.size(); ++n) volumes[n % layers].push_back(run[n]);
        done += piece;
    }
    return volumes;
}

}  // namespace

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

void read_volumes(ByteStream& stream, const ScalarLayout& layout,
                  std::vector<std::string>& warnings,
                  const std::function<void(std::vector<std::int32_t>&&)>& take) {
    const std::size_t voxels = checked_count(stream, layout);
    try {
        Reader reader(stream, layout);
        const auto layers = static_cast<std::size_t>(layout.layers);
        if (layout.interleaved && layers > 1) {
            for (auto& volume : read_interleaved(reader, layers, voxels)) take(std::move(volume));
        } else {
            for (std::size_t n = 0; n < layers; ++n) {
                std::vector<std::int32_t> volume;
                volume.reserve(voxels);
                reader.read(voxels, volume);
                take(std::move(volume));
            }
        }
        reader.finish(warnings);
    } catch (const std::bad_alloc&) {
        throw ResourceError(stream.file().string() + ": " + size_text(layout) +
                            " voxels do not fit in memory; crop the volume or use a larger "
                            "machine");
    } catch (const std::length_error&) {
        throw ResourceError(stream.file().string() + ": " + size_text(layout) +
                            " voxels are more than a program can hold; crop the volume");
    }
}

std::vector<std::int32_t> read_scalars(ByteStream& stream, const ScalarLayout& layout,
                                       std::vector<std::string>& warnings) {
    std::vector<std::int32_t> values;
    read_volumes(stream, layout, warnings,
                 [&](std::vector<std::int32_t>&& volume) { values = std::move(volume); });
    return values;
}

}  // namespace myotet::segmentation
