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

std::string voxel_text(const Index3& size, std::size_t index) {
    const std::size_t i = index % size[0], j = index / size[0] % size[1],
                      k = index / size[0] / size[1];
    return "voxel (" + std::to_string(i) + ", " + std::to_string(j) + ", " + std::to_string(k) +
           ")";
}

std::string number_text(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value).ptr;
    return {text, end};
}

template <class T>
void swap_all(unsigned char* bytes, std::size_t count) {
    if constexpr (sizeof(T) > 1)
        for (std::size_t n = 0; n < count; ++n)
            std::reverse(bytes + n * sizeof(T), bytes + (n + 1) * sizeof(T));
}

/// Where values go, and what was seen of them on the way.
struct Sink {
    const std::filesystem::path& file;
    const Index3& size;
    std::vector<std::int32_t> values;
    double worst = 0;  // largest distance from a whole number

    [[noreturn]] void refuse(std::size_t index, double value) const {
        const std::string where =
            file.string() + ": " + voxel_text(size, index) + " has the value " + number_text(value);
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

    void push(double value) {
        const double whole = std::nearbyint(value), off = std::abs(value - whole);
        if (!(off <= kNearlyWhole && whole >= 0 && whole <= kMostValue))
            refuse(values.size(), value);
        worst = std::max(worst, off);
        values.push_back(static_cast<std::int32_t>(whole));
    }

    template <class T>
    void push_all(const unsigned char* bytes, std::size_t count) {
        const std::size_t first = values.size();
        values.resize(first + count);
        std::int32_t* out = values.data() + first;
        bool bad = false;
        for (std::size_t n = 0; n < count; ++n) {
            T v;
            std::memcpy(&v, bytes + n * sizeof(T), sizeof(T));
            if constexpr (std::is_floating_point_v<T>) {
                const T whole = std::nearbyint(v), off = std::abs(v - whole);
                const bool good = off <= T(kNearlyWhole) && whole >= 0 && whole <= kMost<T>;
                bad |= !good;
                worst = std::max(worst, good ? static_cast<double>(off) : 0.0);
                out[n] = good ? static_cast<std::int32_t>(whole) : 0;
            } else {
                if constexpr (std::is_signed_v<T>) bad |= v < 0;
                if constexpr (sizeof(T) >= 4 && !std::is_same_v<T, std::int32_t>)
                    bad |= v > kMost<T>;
                out[n] = static_cast<std::int32_t>(v);
            }
        }
        if (bad) refuse_first<T>(bytes, count, first);
    }

    /// The slow way, to name the first voxel that breaks a rule.
    template <class T>
    [[noreturn]] void refuse_first(const unsigned char* bytes, std::size_t count,
                                   std::size_t first) {
        values.resize(first);
        for (std::size_t n = 0; n < count; ++n) {
            T v;
            std::memcpy(&v, bytes + n * sizeof(T), sizeof(T));
            push(static_cast<double>(v));
        }
        throw LogicError("a label value was refused without a reason");
    }
};

template <class T>
void read_binary(ByteStream& stream, bool swap_bytes, std::size_t count, Sink& sink) {
    std::vector<unsigned char> chunk(kChunkBytes);
    for (std::size_t done = 0; done < count;) {
        const std::size_t piece = std::min(count - done, kChunkBytes / sizeof(T));
        stream.read_exactly(chunk.data(), piece * sizeof(T), "voxel data");
        if (swap_bytes) swap_all<T>(chunk.data(), piece);
        sink.push_all<T>(chunk.data(), piece);
        done += piece;
    }
}

void read_ascii(ByteStream& stream, std::size_t count, Sink& sink) {
    std::vector<char> chunk(kChunkBytes);
    std::string word;
    const auto finish_word = [&] {
        if (word.empty()) return;
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (word.size() > kLongestWord || error != std::errc() || end != word.data() + word.size())
            throw InputError(sink.file.string() + ": '" + word.substr(0, 40) +
                             "' stands where a label value should; export the file again");
        word.clear();
        if (sink.values.size() < count) sink.push(value);
    };
    while (sink.values.size() < count) {
        const std::size_t got = stream.read(chunk.data(), chunk.size());
        for (std::size_t n = 0; n < got; ++n) {
            const char c = chunk[n];
            const bool space = c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == ',';
            if (space)
                finish_word();
            else if (word.size() <= kLongestWord)
                word += c;
        }
        if (got == 0) {
            finish_word();
            if (sink.values.size() < count) stream.read_exactly(chunk.data(), 1, "voxel data");
        }
    }
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

/// The number of voxels, refused when the file cannot hold them or memory would not.
std::size_t checked_count(const ByteStream& stream, const ScalarLayout& layout) {
    const Index3& s = layout.size;
    const double count = static_cast<double>(s[0]) * s[1] * s[2];
    const double bytes = count * (layout.ascii ? 1.0 : static_cast<double>(size_of(layout.type)));
    if (bytes > static_cast<double>(stream.at_most()))
        throw IoError(stream.file().string() + ": the header tells of " + std::to_string(s[0]) +
                      " x " + std::to_string(s[1]) + " x " + std::to_string(s[2]) +
                      " voxels, which the file is too short to hold; it is cut short or its "
                      "header is wrong: copy or export it again");
    return static_cast<std::size_t>(count);
}

void read_into(Sink& sink, ByteStream& stream, const ScalarLayout& layout, std::size_t count) {
    const bool swap = layout.swap_bytes;
    if (layout.ascii) return read_ascii(stream, count, sink);
    switch (layout.type) {
        case ScalarType::int8:
            return read_binary<std::int8_t>(stream, swap, count, sink);
        case ScalarType::uint8:
            return read_binary<std::uint8_t>(stream, swap, count, sink);
        case ScalarType::int16:
            return read_binary<std::int16_t>(stream, swap, count, sink);
        case ScalarType::uint16:
            return read_binary<std::uint16_t>(stream, swap, count, sink);
        case ScalarType::int32:
            return read_binary<std::int32_t>(stream, swap, count, sink);
        case ScalarType::uint32:
            return read_binary<std::uint32_t>(stream, swap, count, sink);
        case ScalarType::int64:
            return read_binary<std::int64_t>(stream, swap, count, sink);
        case ScalarType::uint64:
            return read_binary<std::uint64_t>(stream, swap, count, sink);
        case ScalarType::float32:
            return read_binary<float>(stream, swap, count, sink);
        case ScalarType::float64:
            return read_binary<double>(stream, swap, count, sink);
    }
}

}  // namespace

std::vector<std::int32_t> read_scalars(ByteStream& stream, const ScalarLayout& layout,
                                       std::vector<std::string>& warnings) {
    const std::size_t count = checked_count(stream, layout);
    Sink sink{stream.file(), layout.size, {}, 0};
    try {
        sink.values.reserve(count);
        read_into(sink, stream, layout, count);
    } catch (const std::bad_alloc&) {
        throw ResourceError(
            stream.file().string() + ": " + std::to_string(count) +
            " voxels do not fit in memory; crop the volume or use a larger machine");
    } catch (const std::length_error&) {
        throw ResourceError(stream.file().string() + ": " + std::to_string(count) +
                            " voxels are more than a program can hold; crop the volume");
    }
    const std::uint64_t surplus = stream.drain();
    if (surplus > 0 && !layout.ascii)
        warnings.push_back(stream.file().string() + " holds " + std::to_string(surplus) +
                           " bytes more than its header tells of; they were ignored.");
    if (stream.garbage_follows())
        warnings.push_back(stream.file().string() +
                           " has bytes behind its compressed data; they were ignored.");
    if (sink.worst > kExact)
        warnings.push_back(stream.file().string() + ": label values are up to " +
                           number_text(std::round(sink.worst * 1e4) / 1e4) +
                           " away from whole numbers and were rounded.");
    return std::move(sink.values);
}

}  // namespace myotet::segmentation
