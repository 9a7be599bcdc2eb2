// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "Core/Geometry.h"

namespace myotet {

/// What a label value is called and how it is drawn.
struct LabelName {
    std::string name;                             ///< as the file or table says it
    std::optional<std::array<double, 3>> colour;  ///< red, green, blue in [0, 1]
};

/// A volume in which each voxel carries the number of a tissue; 0 is background.
struct LabelVolume {
    Index3 size{0, 0, 0};  ///< voxels along i, j, k
    /// Voxel index (i, j, k), a voxel's centre being at whole numbers, to LPS, mm.
    /// May be oblique, left-handed or sheared; never singular.
    Eigen::Affine3d index_to_lps = Eigen::Affine3d::Identity();
    std::vector<std::int32_t> values;         ///< size[0] * size[1] * size[2], i fastest
    std::map<std::int32_t, LabelName> names;  ///< by label value; a value may lack one

    [[nodiscard]] std::size_t offset(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * size[1] + j) * size[0] + i;
    }
    /// Distance between neighbouring voxel centres along each index axis, mm.
    [[nodiscard]] Vec3 spacing() const { return index_to_lps.linear().colwise().norm(); }
    [[nodiscard]] double voxel_volume() const {
        return std::abs(index_to_lps.linear().determinant());
    }
    /// The name given to a label value, or "label_<value>".
    [[nodiscard]] std::string name_of(std::int32_t value) const {
        const auto it = names.find(value);
        return it != names.end() && !it->second.name.empty() ? it->second.name
                                                             : "label_" + std::to_string(value);
    }
};

}  // namespace myotet
