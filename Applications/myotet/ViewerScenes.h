// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MeshViews.h"
#include "Report/Viewer.h"

namespace myotet::app {

/// All tissues in tetrahedra, up to 1.5 million of them; beyond that the largest tissues become
/// surfaces, and surfaces of more than 300 000 triangles in all are decimated, which the notes
/// say. Coloured by distance to the labels where the scan is at hand.
[[nodiscard]] report::ViewedScene mesh_scene(const MeshViews& views);

/// The bodies of a contraction over time with activation, fibre stretch and stress, their fibres,
/// and the bones; at most 60 moments, fewer of large meshes. Throws InputError, IoError.
[[nodiscard]] report::ViewedScene contraction_scene(const RunJson& run,
                                                    const std::filesystem::path& folder);

}  // namespace myotet::app
