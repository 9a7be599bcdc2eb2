// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "LevelSet/LevelSet.h"

namespace myotet::levelset {

/// What a .vdb file says about its tissue.
struct VdbTissue {
    std::int32_t label = 0;
    std::string name;
    Frame frame;  ///< the level sets' local coordinates to the patient's (LPS, mm)
};

/// Writes the union of level sets that share one lattice (a tissue's
/// components) as one OpenVDB grid `name` of class level set: distances in mm
/// in a narrow band, inside and outside as tiles, a transform to LPS, mm, and
/// metadata `label`, `SPACE` and `units`. The bytes depend on the arguments
/// alone. Throws MeshError when the lattices differ, IoError.
void write_vdb(std::span<const LevelSet* const> components, const VdbTissue& tissue,
               const std::filesystem::path& file);

}  // namespace myotet::levelset
