// SPDX-License-Identifier: Apache-2.0
#pragma once

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

/// How a volume's values lie in a file.
struct ScalarLayout {
    ScalarType type = ScalarType::uint8;
    bool swap_bytes = false;  ///< stored in the other byte order than this machine's
    bool ascii = false;       ///< stored as text, values apart by white space
    Index3 size{0, 0, 0};     ///< voxels along i, j, k, i fastest
};

/// Reads size[0] * size[1] * size[2] label values and makes sure that the
/// stream holds them all to its end. Real numbers are rounded when each lies
/// within 0.05 of a whole number, with a warning from 0.001 on.
/// Throws IoError when the stream is cut short or damaged, InputError for
/// negative values, values past 2^31 - 1 and values that are not whole
/// numbers, ResourceError when they do not fit in memory.
/// Memory: 4 bytes a voxel, committed only as the data arrive.
[[nodiscard]] std::vector<std::int32_t> read_scalars(ByteStream& stream, const ScalarLayout& layout,
                                                     std::vector<std::string>& warnings);

}  // namespace myotet::segmentation
