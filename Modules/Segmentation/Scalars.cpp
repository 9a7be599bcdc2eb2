// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/Scalars.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <type_traits>

#include "Core/Errors.h"
#include "Segmentation/ValueStream.h"

namespace myotet::segmentation {
namespace {

// Labels written through floating-point tools come back this exact.
constexpr double kExact = 1e-3;
// The Colin27 atlas of 2008 is off by 0.024; interpolated labels are off by far more.
constexpr double kNearlyWhole = 0.05;
constexpr std::size_t kRunValues = std::size_t{1} << 20;
constexpr double kMostValue = std::numeric_limits<std::int32_t>::max();
// The largest value of a type that an int32 holds: a float skips 2^31 - 1.
template <class T>
constexpr T kMost = std::is_same_v<T, float> ? T(2147483520) : T(kMostValue);

/// Takes label values from a stream, one run after another, and checks each.
class Reader {
public:
    Reader(ByteStream& stream, const ScalarLayout& layout) : values_(stream, layout) {}

    [[nodiscard]] std::size_t voxels() const { return values_.voxels(); }
    /// Appends the next `count` values to `values`.
    void read(std::size_t count, std::vector<std::int32_t>& values);
    /// Passes over what is left and warns of it, or refuses.
    void finish(std::vector<std::string>& warnings);

private:
    template <class T>
    void take_all(const unsigned char* bytes, std::size_t count, std::int32_t* out);
    [[nodiscard]] std::int32_t checked(double value, std::size_t index);
    [[noreturn]] void refuse(std::size_t index, double value) const;

    ValueStream values_;
    std::size_t done_ = 0;  // values taken
    double worst_ = 0;      // largest distance from a whole number
};

void Reader::refuse(std::size_t index, double value) const {
    const std::string where =
        values_.file() + ": " + values_.voxel_text(index) + " has the value " + number_text(value);
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
        const T v = value_at<T>(bytes + n * sizeof(T));
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
        const T v = value_at<T>(bytes + n * sizeof(T));
        out[n] = checked(static_cast<double>(v), done_ + n);
    }
}

void Reader::read(std::size_t count, std::vector<std::int32_t>& values) {
    if (values_.layout().ascii) {
        for (; count > 0; --count) values.push_back(checked(values_.next_number(), done_++));
        return;
    }
    with_type(values_.layout().type, [&]<class T>(T) {
        values_.read_binary<T>(count, [&](const unsigned char* bytes, std::size_t piece) {
            values.resize(values.size() + piece);
            take_all<T>(bytes, piece, values.data() + values.size() - piece);
            done_ += piece;
        });
    });
}

void Reader::finish(std::vector<std::string>& warnings) {
    values_.finish(warnings);
    if (worst_ > kExact)
        warnings.push_back(values_.file() + ": label values are up to " +
                           number_text(std::round(worst_ * 1e4) / 1e4) +
                           " away from whole numbers and were rounded.");
}

using Volumes = std::vector<std::vector<std::int32_t>>;

/// Volumes of which the file holds a voxel's values together.
Volumes read_interleaved(Reader& reader, std::size_t layers, std::size_t voxels) {
    Volumes volumes(layers);
    for (auto& volume : volumes) volume.reserve(voxels);
    std::vector<std::int32_t> run;
    for (std::size_t done = 0; done < voxels;) {
        const std::size_t piece =
            std::min(voxels - done, std::max<std::size_t>(kRunValues / layers, 1));
        run.clear();
        reader.read(piece * layers, run);
        for (std::size_t n = 0; n < run.size(); ++n) volumes[n % layers].push_back(run[n]);
        done += piece;
    }
    return volumes;
}

}  // namespace

void read_volumes(ByteStream& stream, const ScalarLayout& layout,
                  std::vector<std::string>& warnings,
                  const std::function<void(std::vector<std::int32_t>&&)>& take) {
    try {
        Reader reader(stream, layout);
        const std::size_t voxels = reader.voxels();
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
