// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "Core/Progress.h"
#include "Repair/Recipe.h"
#include "Repair/Scene.h"

namespace myotet::repair {

/// What one step did to one tissue.
struct StepReport {
    int number = 0;      ///< of the step, from 1
    std::string what;    ///< its keyword
    std::string tissue;  ///< name
    double added = 0;    ///< mm^3
    double removed = 0;  ///< mm^3
    std::string note;    ///< what else there is to say; may be empty
};
/// "step 3, grow: biceps gained 512 mm^3 and lost 0 mm^3; ...".
[[nodiscard]] std::string to_sentence(const StepReport& report);

struct Summary {
    std::vector<StepReport> steps;  ///< one or more a step, in order
};

/// Works through the recipe. Each step is said to `progress` as a note. Tissues
/// that no step changes keep their regions bit for bit; those of changed ones
/// are made anew, one a connected component, their `voxels` the volume in
/// voxels of the tissue's scan (0 in new tissues).
/// All names are checked before the first step. Throws InputError with file,
/// step, value, rule and remedy when a tissue is not known, a step would empty
/// one, or a step cannot be done; the scene is then to be thrown away. Throws
/// Interrupted.
/// Cost: each step a few passes over the samples near the surfaces it meets.
Summary apply(const Recipe& recipe, Scene& scene, ProgressSink& progress);

}  // namespace myotet::repair
