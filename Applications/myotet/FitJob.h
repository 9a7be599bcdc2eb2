// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "Contraction/FitActivation.h"

namespace myotet::app {

/// What `myotet fit` was asked for.
struct FitJobOptions {
    std::filesystem::path scene, target, output;
    std::string body;  ///< whose activation is sought; empty: the only muscle
    contraction::ActivationFitOptions fitting;
    int threads = 0;  ///< 0: as many as the process may use
};

/// What a fit came to.
struct FitReport {
    std::string scene, target, output, fingerprint, body;
    contraction::ActivationFit fitted;
    double begin = 0, end = 0;              ///< s, of the target
    std::map<std::string, double> seconds;  ///< by stage
    double peak_memory = 0, processor_seconds = 0;
    std::vector<std::string> warnings, files;
};

/// Seeks the activation with which a scene comes nearest to a target, see
/// contraction::fit_activation. Writes activation.sto, history.csv of the best run and
/// report.json. Bad input throws before anything is written.
[[nodiscard]] FitReport run_fit_job(const FitJobOptions& options, ProgressSink& progress);

/// report.json's content, and a table for people.
[[nodiscard]] std::string to_json(const FitReport& report);
[[nodiscard]] std::string to_table(const FitReport& report);

}  // namespace myotet::app
