// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "Core/Geometry.h"
#include "Segmentation/ByteStream.h"

namespace myotet::segmentation {

/// Types in which files store label values.
enum class ScalarType {
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64,
    float32,
    float64
};

/// How the values of one or several volumes lie in a file.
struct ScalarLayout {
    ScalarType type = ScalarType::uint8;
    bool swap_bytes = false;   ///< stored in the other byte order than this machine's
    bool ascii = false;        ///< stored as text, values apart by white space
    Index3 size{0, 0, 0};      ///< voxels along i, j, k, i fastest
    std::int64_t layers = 1;   ///< volumes in the file, all of that size
    bool interleaved = false;  ///< a voxel's values lie together, else volume after volume
};

/// Bytes of one value.
[[nodiscard]] std::size_t size_of(ScalarType type);

/// Reads label values of all layers, hands each volume to `take` in their order
/// and makes sure that the stream holds them all to its end. Real numbers are
/// rounded when each lies within 0.05 of a whole number, with a warning from
/// 0.001 on.
/// Throws IoError when the stream is cut short or damaged, InputError for
/// negative values, values past 2^31 - 1, values that are not whole numbers and
/// a stream that goes on behind the last, ResourceError when they do not fit in
/// memory.
/// Memory: 4 bytes a voxel, of one volume unless interleaved, committed only as
/// the data arrive.
void read_volumes(ByteStream& stream, const ScalarLayout& layout,
                  std::vector<std::string>& warnings,
                  const std::function<void(std::vector<std::int32_t>&&)>& take);

/// The same for a sole volume.
[[nodiscard]] std::vector<std::int32_t> read_scalars(ByteStream& stream, const ScalarLayout& layout,
                                                     std::vector<std::string>& warnings);

}  // namespace myotet::segmentation
