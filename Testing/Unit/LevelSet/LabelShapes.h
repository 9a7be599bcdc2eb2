// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "Core/LabelVolume.h"

namespace myotet::test {

/// A volume whose voxel (i, j, k) carries label(i, j, k).
inline LabelVolume make_volume(const Index3& size, const Vec3& spacing,
                               const std::function<int(int, int, int)>& label) {
    LabelVolume volume;
    volume.size = size;
    volume.index_to_lps.linear() = spacing.asDiagonal();
    for (int k = 0; k < size[2]; ++k)
        for (int j = 0; j < size[1]; ++j)
            for (int i = 0; i < size[0]; ++i) volume.values.push_back(label(i, j, k));
    return volume;
}

/// The same with the label given by the voxel's position in mm.
inline LabelVolume sample_volume(const Index3& size, const Vec3& spacing,
                                 const std::function<int(const Vec3&)>& label) {
    return make_volume(size, spacing, [&](int i, int j, int k) {
        return label(Vec3(i, j, k).cwiseProduct(spacing));
    });
}

}  // namespace myotet::test
