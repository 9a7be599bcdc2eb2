// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MeshViews.h"
#include "Report/Viewer.h"

namespace myotet::app {

/// What a page's 3D view shows, and sentences on what it leaves out or simplifies.
struct ViewerScene {
    report::ViewedScene scene;
    std::vector<std::string> notes;
};

/// All tissues in tetrahedra, as many as 1.5 million in all; beyond that the largest tissues
/// become surfaces, and surfaces of more than 300 000 triangles in all are decimated. Coloured by
/// distance to the labels where the scan is at hand.
[[nodiscard]] ViewerScene mesh_scene(const MeshViews& views);

/// The bodies of a contraction over time with activation, fibre stretch and stress, their fibres,
/// and the bones; at most 60 moments, fewer of large meshes. Throws InputError, IoError.
[[nodiscard]] ViewerScene contraction_scene(const RunJson& run,
                                            const std::filesystem::path& folder);

/// The part of a page that holds the view, or says why there is none.
[[nodiscard]] report::Section view_section(const ViewerScene& viewer);

}  // namespace myotet::app
