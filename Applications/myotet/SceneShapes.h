// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Contraction/Model.h"
#include "Core/Progress.h"

namespace myotet::app {

/// What a scene names, found: from its label volume, meshed, or from files.
struct LoadedShapes {
    contraction::SceneShapes shapes;
    std::vector<std::string> notes;
};

/// Throws InputError at the scene's lines, IoError, MeshError where a body cannot be meshed,
/// ResourceError, Interrupted.
[[nodiscard]] LoadedShapes load_shapes(const contraction::Scene& scene, ProgressSink& progress);

}  // namespace myotet::app
