// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "Core/LabelVolume.h"
#include "Core/Progress.h"
#include "LevelSet/LevelSet.h"

namespace myotet::levelset {

/// What smoothing may do to a segmentation.
enum class Smoothing {
    /// Motion by mean curvature [Teran05, sec. 5], as far as LabelOptions::smooth allows.
    curvature,
    /// The same, but every voxel's centre stays in the region that its label
    /// names (Whitaker 2000). Needs samples no farther apart than voxels.
    constrained,
    /// The voxels' walls as they are, staircase and all.
    none,
};

/// How labels become level sets.
struct LabelOptions {
    /// Sample distance of the isotropic grid, mm; 0 chooses it: the smallest
    /// voxel side where the work for that is modest (30 s, 0.8 GB by forecast),
    /// else wider, up to the geometric mean of the sides.
    double spacing = 0;
    Smoothing smoothing = Smoothing::curvature;
    /// How far motion by mean curvature may move a sharp voxel corner, mm; 0 is no
    /// smoothing; negative chooses half the largest voxel side: the staircase of a
    /// smooth surface strays that far from it, and no more needs undoing. Up to one
    /// side it is a bound, shorter across a voxel's shorter sides in proportion;
    /// beyond, it sets the duration of the flow alone.
    double smooth = -1;
    /// Whether the background is given too: one level set of what the regions leave.
    bool background = false;
    /// Bytes the work may hold at its peak, the result included.
    double max_memory = 8e9;
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// One connected component of one label.
struct Region {
    int layer = 0;  ///< of the file whose label it is; the caller sets it
    std::int32_t label = 0;
    int component = 0;  ///< 0 is the label's largest
    std::int64_t voxels = 0;
    double volume_labels = 0;     ///< voxels * volume of a voxel, mm^3
    double volume_level_set = 0;  ///< enclosed by phi = 0 after smoothing and partition, mm^3
    double inscribed_radius = 0;  ///< largest -phi, mm
    bool smoothed_less = false;   ///< smoothing was held back to keep a thin part
    LevelSet phi;
};

/// What smoothing and volume restoration did to a label, all its components
/// together, measured on the finished level sets.
struct SmoothingReport {
    std::int32_t label = 0;
    /// Distance of the finished surface from the walls of the label's voxels,
    /// over its area, mm.
    double moved_mean = 0, moved_95 = 0, moved_max = 0;
    double volume_before = 0;        ///< of the voxels, mm^3
    double volume_after = 0;         ///< enclosed by phi = 0, mm^3
    std::int64_t voxels_lost = 0;    ///< of the label, whose centre is now outside
    std::int64_t voxels_gained = 0;  ///< not of the label, whose centre is now inside
};

/// All regions in one local frame, whose axes follow the scan's.
struct LabelLevelSets {
    Frame frame;                             ///< local coordinates to the patient's
    double spacing = 0;                      ///< as chosen, mm
    double smooth = 0;                       ///< as chosen, mm
    std::vector<Region> regions;             ///< by label value, then by component
    std::vector<SmoothingReport> smoothing;  ///< by label value
    std::optional<LevelSet> background;      ///< where LabelOptions::background asks for it
};

/// Turns the components of `labels` (6-connected voxels) into signed distances
/// that share walls: distances to the voxels' walls, motion by mean curvature
/// with reinitialisation, volume given back, and a partition in which the
/// background, with every label not asked for and all that lies outside the
/// volume, is one region more. Sheets, tubes and specks keep their place.
/// Sources: [Teran05, sec. 5]; partition: Losasso, Shinar, Selle, Fedkiw (2006),
/// Multiple interacting liquids, ACM Trans. Graph. 25(3).
/// Throws InputError when a label is not in the volume, ResourceError when the
/// grid would not fit, Interrupted.
/// Cost: a pass or two over the voxels, then O(wall area / spacing^2).
[[nodiscard]] LabelLevelSets from_labels(const LabelVolume& volume,
                                         std::span<const std::int32_t> labels,
                                         const LabelOptions& options, ProgressSink& progress);

}  // namespace myotet::levelset
