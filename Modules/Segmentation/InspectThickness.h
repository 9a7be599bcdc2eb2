// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "Segmentation/InspectRuns.h"

namespace myotet::segmentation {

/// A voxel in the middle of its label, that is, on the label's medial set.
struct MedialVoxel {
    std::int32_t component = 0;  ///< among RunMap::components
    float radius = 0;            ///< of the ball around it inside the label, mm
};

/// How thick the labels are.
struct Thickness {
    std::vector<MedialVoxel> medial;  ///< in the order of their voxels
    /// Per component: voxels with another value on both sides along some axis.
    std::vector<std::int64_t> one_voxel_thick;
};

/// Distances from every labelled voxel to the nearest voxel centre of another
/// value or beyond the volume, exact for axes at right angles (lower envelopes
/// of parabolas, axis by axis: Felzenszwalb, Huttenlocher 2012, Theory of
/// Computing 8), and the voxels in the middle of each label with their
/// inscribed radius. In the middle: none of the 26 neighbours in the label (nor,
/// along short sides, a voxel as far away as the longest side) is farther from
/// the rim by half of the way to it or more. The radius is interpolated across
/// the middle and ends half a voxel before the other voxel's centre: exact for
/// sheets along an axis, too small by up to a voxel for other shapes.
/// Cost: three passes; 4 bytes a voxel of the box around all labels.
[[nodiscard]] Thickness measure_thickness(const LabelVolume& volume, const RunMap& map);

/// Lower envelope of the parabolas height[q] + step^2 (x - q)^2 at x = 0, 1 ...
/// together with those of height 0 at -1 and behind the last. In place.
void squared_distances(std::span<float> height, double step);

}  // namespace myotet::segmentation
