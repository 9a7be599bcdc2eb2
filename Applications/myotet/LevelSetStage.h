// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "Core/Progress.h"
#include "LevelSet/FromLabels.h"
#include "LevelSet/HealSurface.h"
#include "Repair/Apply.h"
#include "Scan.h"

namespace myotet::app {

/// How the input becomes level sets.
struct LevelSetChoices {
    double spacing = 0;  ///< of the samples, mm; 0: from the voxels; a surface needs one
    levelset::Smoothing smoothing = levelset::Smoothing::curvature;  ///< of labels
    double smooth = -1;            ///< mm; negative: from the voxel size; none for a surface
    std::filesystem::path repair;  ///< recipe; empty: none
};

/// The tissues that results are made of.
struct TissueSets {
    levelset::LabelLevelSets sets;
    std::vector<Tissue> tissues;                   ///< by layer and label
    std::optional<levelset::HealSummary> healing;  ///< of a surface that was to be healed
    std::vector<repair::StepReport> repair;        ///< what each step of a recipe did
};

[[nodiscard]] inline bool belongs(const levelset::Region& region, const Tissue& tissue) {
    return region.layer == tissue.layer && region.label == tissue.label;
}

/// One level set a component of each tissue; a surface is one region in its
/// own coordinates, which are the patient's. Tissues of one layer are a
/// partition; layers may overlap. A recipe is applied to all tissues of the
/// scan, also to those that were not asked for; tissues that it makes are added.
[[nodiscard]] TissueSets make_level_sets(const Scan& scan, const LevelSetChoices& choices,
                                         ProgressSink& progress);

}  // namespace myotet::app
