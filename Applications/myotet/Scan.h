// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "Core/LabelVolume.h"
#include "Core/TetMesh.h"

namespace myotet::app {

struct JobOptions;

/// One tissue as the input has it.
struct Tissue {
    std::int32_t label = 0;
    std::string name;
    std::int64_t voxels = 0;  ///< 0 for a surface
    double volume = 0;        ///< mm^3
    double area = 0;          ///< of its surface, mm^2; from voxel faces for labels
};

/// The input, read and checked: labels or a surface.
struct Scan {
    std::optional<LabelVolume> volume;
    std::optional<TriMesh> surface;
    std::vector<Tissue> tissues;       ///< those asked for, by label value
    Vec3 spacing = Vec3::Zero();       ///< of the voxels, mm; zero for a surface
    int shells = 0;                    ///< outward closed pieces of a surface
    std::filesystem::path names_from;  ///< where the names come from; empty: none
    std::string sha256;                ///< of the input file
    std::vector<std::string> warnings;
};

/// Throws UsageError when an option does not fit the kind of input, IoError,
/// InputError.
[[nodiscard]] Scan read_scan(const JobOptions& options);

}  // namespace myotet::app
