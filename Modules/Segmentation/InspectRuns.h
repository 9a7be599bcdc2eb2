// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "Core/LabelVolume.h"

namespace myotet::segmentation {

/// Voxels of one value, background included, that follow one another along i.
struct Run {
    std::int32_t first = 0, last = 0;  ///< along i, both ends inclusive
    std::int32_t component = 0;        ///< among RunMap::components
};

/// A 6-connected set of voxels of one value.
struct RunComponent {
    std::int32_t value = 0;
    std::int64_t voxels = 0;
    Index3 min{0, 0, 0}, max{0, 0, 0};  ///< index box, both ends inclusive
};

/// Two components that share voxel faces.
struct RunContact {
    std::int32_t a = 0, b = 0;                   ///< components, a < b
    std::array<std::int64_t, 3> faces{0, 0, 0};  ///< across i, j and k
};

/// A whole label volume as runs, with its components and what touches what.
struct RunMap {
    Index3 size{0, 0, 0};
    std::vector<Run> runs;
    /// Row j, k holds runs [row_start[r], row_start[r + 1]) with r = k * size[1] + j.
    std::vector<std::int32_t> row_start;
    std::vector<RunComponent> components;  ///< by their first voxel
    std::vector<RunContact> contacts;      ///< by a, then b

    [[nodiscard]] std::size_t row(int j, int k) const {
        return static_cast<std::size_t>(k) * size[1] + j;
    }
};

/// Throws ResourceError when there are more than 2^31 - 1 runs.
/// Cost: one pass over the voxels; 12 bytes a run.
[[nodiscard]] RunMap map_runs(const LabelVolume& volume);

}  // namespace myotet::segmentation
