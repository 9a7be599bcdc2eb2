// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "Core/Geometry.h"

namespace myotet::levelset {

/// A grid of a .vdb file as it stands there.
struct VdbGrid {
    static constexpr int kLeafSide = 8;
    static constexpr int kLeafSize = kLeafSide * kLeafSide * kLeafSide;

    std::string type;                           ///< of the tree: Tree_float_5_4_3, or another
    std::map<std::string, std::string> text;    ///< metadata of type string: name, class ...
    std::map<std::string, std::int32_t> whole;  ///< and of type int32

    bool linear = true;          ///< whether index_to_world is all there is to say
    std::string map_type;        ///< OpenVDB's name of the transform
    std::array<Vec3, 3> axes{};  ///< a step along i, j, k in world units
    Vec3 origin = Vec3::Zero();  ///< of voxel (0, 0, 0)
    bool has_samples = false;    ///< whether the rest was read: trees of 32-bit floats alone
    float background = 0;        ///< beyond the narrow band, outside
    std::vector<Index3> leaves;  ///< their lowest voxels, multiples of 8
    std::vector<float> values;   ///< kLeafSize a leaf, k fastest; inactive ones, too
};

/// Reads the bytes of a .vdb file, of format 222 to 224 (OpenVDB 2 and later).
/// OpenVDB's own reader trusts a file: in a damaged one, a negative size of a
/// chunk makes it write past its buffers, and counts make it run on past the
/// file's end. Here every count and size is held against what is left.
/// Source: the format as openvdb/io and openvdb/tree (RootNode.h, InternalNode.h,
/// LeafNode.h, Compression.h) read and write it, release 10.0.
/// Throws InputError that says what is damaged, without the file's name.
/// Memory: 2 kB a leaf, at most 16 times the file.
[[nodiscard]] std::vector<VdbGrid> parse_vdb(std::string_view bytes);

}  // namespace myotet::levelset
