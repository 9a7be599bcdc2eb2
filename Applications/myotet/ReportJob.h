// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "Core/Progress.h"

namespace myotet::app {

/// The page's name in a folder of results.
inline constexpr const char* kPageFile = "report.html";

/// What `myotet report` was asked for.
struct ReportJobOptions {
    std::filesystem::path folder;  ///< results of mesh, contract, press or activate
    bool png = false;              ///< pictures of tissues as files, too
};

/// Makes report.html of what a folder of results holds: one file that opens without any other.
/// The same bytes for the same folder and scan. Throws InputError or IoError, before anything
/// is written, when report.json is missing, damaged, of another version or of a run that has
/// no page, or a file that it names is; UsageError for pictures of what is no mesh.
void run_report_job(const ReportJobOptions& options, ProgressSink& progress);

/// Makes the page after a run; where that fails the run's results stay good, and a warning says
/// why there is no page. `wanted` false: takes away the page of an earlier run.
void add_page(const std::filesystem::path& folder, bool wanted, ProgressSink& progress);

}  // namespace myotet::app
