// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "Core/Progress.h"
#include "LevelSetStage.h"
#include "MeshOutput.h"
#include "MeshReport.h"
#include "Scan.h"
#include "Sizing.h"

namespace myotet::app {

/// What `myotet mesh` was asked for.
struct JobOptions {
    ScanOptions scan;
    std::filesystem::path output;  ///< folder
    SizeOptions sizes;
    LevelSetChoices level_sets;
    std::vector<meshing::Compression> compression = {meshing::Compression::optimization};
    MeshFormats formats;
    int threads = 0;  ///< 0: as many as the process may use
};

/// What a run would make and take.
[[nodiscard]] Forecast forecast_job(const JobOptions& options, ProgressSink& progress);

/// From a labelled scan, or a surface, to one mesh a tissue: reads, makes level
/// sets, meshes, checks every promise, writes. A tissue whose mesh breaks a
/// promise is not written; the report says so and is written all the same.
/// Throws InputError, IoError (bad input: nothing is written), ResourceError,
/// Interrupted (what was written is removed).
[[nodiscard]] RunReport run_job(const JobOptions& options, ProgressSink& progress);

}  // namespace myotet::app
