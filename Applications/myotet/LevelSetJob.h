// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "Core/Progress.h"
#include "LevelSetStage.h"
#include "RunFacts.h"
#include "Scan.h"

namespace myotet::app {

/// What `myotet levelset` was asked for.
struct LevelSetJobOptions {
    ScanOptions scan;
    std::filesystem::path output;  ///< folder
    LevelSetChoices level_sets;
    std::string surface_format = "stl";  ///< or vtp
    int threads = 0;                     ///< 0: as many as the process may use
};

/// What became of one tissue.
struct LevelSetTissue {
    Tissue tissue;
    int components = 0;
    double volume = 0;            ///< enclosed by the level sets, mm^3
    double inscribed_radius = 0;  ///< the largest, mm
    std::size_t triangles = 0;
    std::vector<std::string> notes;
    std::vector<std::string> files;
};

struct LevelSetReport {
    RunFacts run;
    std::vector<LevelSetTissue> tissues;  ///< by layer and label value
};

/// From a labelled scan, or a surface, to one level set (.vdb) and its surface
/// a tissue, repaired when a recipe is given. Errors as run_job.
[[nodiscard]] LevelSetReport run_level_set_job(const LevelSetJobOptions& options,
                                               ProgressSink& progress);

}  // namespace myotet::app
