// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "Segmentation/ByteStream.h"
#include "Segmentation/Scalars.h"

namespace myotet::segmentation {

/// A number as messages show it: the shortest text that reads back the same.
[[nodiscard]] std::string number_text(double value);
/// "2 x 3 x 4", and " x 5" where there are so many layers.
[[nodiscard]] std::string size_text(const ScalarLayout& layout);

/// Values of a stream as they are stored, one piece after another, whatever they mean, and
/// the checks that there are neither fewer nor more than the header tells of.
class ValueStream {
public:
    /// Throws IoError when the stream cannot hold them all. The stream must outlive it.
    ValueStream(ByteStream& stream, const ScalarLayout& layout);

    /// Voxels of one layer.
    [[nodiscard]] std::size_t voxels() const { return voxels_; }
    /// The layout's values, of all layers.
    [[nodiscard]] std::size_t count() const {
        return voxels_ * static_cast<std::size_t>(layout_.layers);
    }
    /// Calls take(bytes, n) with pieces of values of binary type T in this machine's byte
    /// order, `count` in all. Throws IoError.
    template <class T, class Take>
    void read_binary(std::size_t count, Take&& take);
    /// The next value of a text. Throws IoError, InputError.
    [[nodiscard]] double next_number();
    /// Passes over what is left and warns of it, or refuses: IoError, InputError.
    void finish(std::vector<std::string>& warnings);

    /// Where a value is, for messages: "voxel (1, 2, 3) of layer 4".
    [[nodiscard]] std::string voxel_text(std::size_t index) const;
    [[nodiscard]] std::string file() const { return stream_.file().string(); }
    [[nodiscard]] const ScalarLayout& layout() const { return layout_; }

private:
    static constexpr std::size_t kPieceBytes = std::size_t{1} << 20;
    [[nodiscard]] std::string next_word();

    ByteStream& stream_;
    ScalarLayout layout_;
    std::size_t voxels_ = 0;
    std::vector<unsigned char> piece_ = std::vector<unsigned char>(kPieceBytes);
    std::size_t at_ = 0, filled_ = 0;  // what of the piece is text not yet taken
};

template <class T, class Take>
void ValueStream::read_binary(std::size_t count, Take&& take) {
    while (count > 0) {
        const std::size_t n = std::min(count, kPieceBytes / sizeof(T));
        stream_.read_exactly(piece_.data(), n * sizeof(T), "voxel data");
        if (sizeof(T) > 1 && layout_.swap_bytes)
            for (std::size_t i = 0; i < n; ++i)
                std::reverse(piece_.data() + i * sizeof(T), piece_.data() + (i + 1) * sizeof(T));
        take(static_cast<const unsigned char*>(piece_.data()), n);
        count -= n;
    }
}

/// Calls use(T{}) with the type's own T.
template <class Use>
void with_type(ScalarType type, Use&& use) {
    switch (type) {
        case ScalarType::int8:
            return use(std::int8_t{});
        case ScalarType::uint8:
            return use(std::uint8_t{});
        case ScalarType::int16:
            return use(std::int16_t{});
        case ScalarType::uint16:
            return use(std::uint16_t{});
        case ScalarType::int32:
            return use(std::int32_t{});
        case ScalarType::uint32:
            return use(std::uint32_t{});
        case ScalarType::int64:
            return use(std::int64_t{});
        case ScalarType::uint64:
            return use(std::uint64_t{});
        case ScalarType::float32:
            return use(float{});
        case ScalarType::float64:
            return use(double{});
    }
}

/// The value that lies at these bytes.
template <class T>
[[nodiscard]] T value_at(const unsigned char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
}

}  // namespace myotet::segmentation
