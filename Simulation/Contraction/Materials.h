// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "Contraction/Scene.h"
#include "Muscle/TissueMaterial.h"

namespace myotet::contraction {

/// Reads a set of constants, as those in Data/materials: `myotet_material: 1`, the choices
/// `fibres`, `fibre_stretch`, `volume`, and the map `constants`. Throws IoError, InputError
/// with the line.
[[nodiscard]] muscle::TissueMaterial read_material(const std::filesystem::path& file);

/// The set of constants that a material's model names: in `folder` or, where the name ends
/// in .yaml, beside the scene.
[[nodiscard]] std::filesystem::path set_of(const Scene& scene, const Material& material,
                                           const std::filesystem::path& folder);

/// A material of a scene: its set, with the scene's own constants. Throws InputError at the
/// scene's line.
[[nodiscard]] muscle::TissueMaterial material_of(const Scene& scene, const Material& material,
                                                 const std::filesystem::path& folder);

}  // namespace myotet::contraction
