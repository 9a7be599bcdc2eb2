// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "Core/LabelVolume.h"
#include "Segmentation/Inspect.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::app {

/// How the voxels lie in the patient.
struct GridReport {
    Index3 size{0, 0, 0};  ///< voxels along i, j, k
    Eigen::Affine3d index_to_lps = Eigen::Affine3d::Identity();
    Vec3 spacing = Vec3::Zero();  ///< mm
    std::string axes;             ///< where i, j, k grow to: three of L R, A P, S I
    double oblique_deg = 0;       ///< largest angle between an axis and the patient's
    double shear_deg = 0;         ///< by how much the axes miss right angles, at most
    bool left_handed = false;
    /// "right", "posterior" ...: where the volume's first and last layers of i, j, k lie.
    std::array<std::string, 6> sides;
};
[[nodiscard]] GridReport describe_grid(const LabelVolume& volume);

/// One label of one layer with what a person should know about it.
struct InspectedLabel {
    std::size_t layer = 0;  ///< from 0
    std::string name;
    bool named = false;  ///< else the name is made up of the value
    segmentation::LabelInspection found;
    std::vector<std::string> notes;  ///< a sentence each
};

/// A name in the file or table for a value that no voxel has.
struct UnusedName {
    std::size_t layer = 0;
    std::int32_t value = 0;
    std::string name;
};

/// What `myotet inspect` says.
struct InspectReport {
    std::string input, names_from;
    GridReport grid;
    std::vector<std::string> warnings;   ///< of the reader
    std::vector<InspectedLabel> labels;  ///< by layer, then by value
    std::vector<std::int64_t> pockets;   ///< per layer: enclosed pockets of background
    std::vector<std::int64_t> pocket_voxels;
    std::vector<segmentation::Overlap> overlaps;
    std::vector<UnusedName> unused_names;
    double edge_length = 0;          ///< that `mesh` would take by default, mm
    std::vector<std::string> notes;  ///< on the file as a whole, a sentence each
};

/// Reads and inspects a label file. Throws as segmentation::read_labels does.
[[nodiscard]] InspectReport inspect_file(const std::filesystem::path& file,
                                         const segmentation::ReadOptions& options);

/// Adds the notes: what would be lost or changed at the default settings.
void add_notes(InspectReport& report);

/// The name of a report's label.
[[nodiscard]] std::string name_in(const InspectReport& report, std::size_t layer,
                                  std::int32_t value);

[[nodiscard]] std::string to_json(const InspectReport& report);
[[nodiscard]] std::string to_text(const InspectReport& report);

}  // namespace myotet::app
