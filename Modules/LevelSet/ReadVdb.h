// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "LevelSet/LevelSet.h"

namespace myotet::levelset {

/// One tissue of a .vdb file.
struct VdbLevelSet {
    std::int32_t label = 0;
    std::string name;
    Frame frame;   ///< its local coordinates to the patient's (LPS, mm)
    LevelSet phi;  ///< in its local coordinates
};

/// What a .vdb file holds.
struct VdbFile {
    std::vector<VdbLevelSet> level_sets;  ///< in the file's order; at least one
    std::string unit;                     ///< of the first: mm, cm or m
    std::vector<std::string> warnings;    ///< a sentence for each grid that was left out
};

/// Reads all OpenVDB grids of 32-bit numbers that are of class level set: those
/// that write_vdb writes, and those of other programs whose voxels are cubes,
/// whose values are distances, negative inside, and whose narrow band is at
/// least one voxel wide on either side. Samples within four voxels of the surface
/// are kept as they are; where the band is narrower than three, and everywhere
/// beyond it, distances are made anew. A grid of another kind is left out with a
/// warning.
///
/// Metadata of a grid: `label`, else the grids without one are 1, 2, ... as far
/// as these are free; its name, else the file's; `SPACE`, RAS turned to LPS,
/// any other taken as LPS; `units` mm, cm or m, else `unit`, which is mm when
/// empty.
///
/// Throws IoError when the file cannot be read or is damaged, InputError when no
/// grid is a level set or one breaks a rule above, ResourceError where its box
/// would take more than `max_memory` bytes.
/// Cost: one pass over the samples, then as assemble().
[[nodiscard]] VdbFile read_vdb(const std::filesystem::path& file, const std::string& unit = {},
                               double max_memory = 8e9);

}  // namespace myotet::levelset
