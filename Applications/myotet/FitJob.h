// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "Activation/FitExpensive.h"
#include "Activation/SplineBasis.h"
#include "Contraction/Trial.h"

namespace myotet::app {

/// What `myotet fit` was asked for.
struct FitJobOptions {
    std::filesystem::path scene, target, output;
    std::string body;      ///< whose activation is sought; empty: the only muscle
    int intervals = 0;     ///< of its spline; 0: one a fifth of a second, at most 5
    int evaluations = 40;  ///< of the scene, at most
    double goal = 0.01;    ///< ends where the misfit is this part of the target's most
    int threads = 0;       ///< 0: as many as the process may use
};

/// What a fit came to.
struct FitReport {
    std::string scene, target, output, fingerprint, body;
    std::vector<std::string> quantities;  ///< of the history, that the target names
    activation::ExpensiveFit fit;
    std::vector<double> misfit;  ///< root mean square, a quantity, in its unit
    std::vector<double> most;    ///< of the target, a quantity
    double begin = 0, end = 0;   ///< s, of the target
    activation::SplineBasis basis;
    std::map<std::string, double> seconds;  ///< by stage
    double peak_memory = 0, processor_seconds = 0;
    std::vector<std::string> warnings, files;
};

/// Seeks the activation of a body with which the scene comes nearest to a target: columns of
/// the history over time, named as in history.csv. The activation is a cubic B-spline in time,
/// its coefficients from 0 to 1, that begins with what the scene says. Writes activation.sto,
/// history.csv of the best run and report.json. Bad input throws before anything is written.
[[nodiscard]] FitReport run_fit_job(const FitJobOptions& options, ProgressSink& progress);

/// report.json's content, and a table for people.
[[nodiscard]] std::string to_json(const FitReport& report);
[[nodiscard]] std::string to_table(const FitReport& report);

}  // namespace myotet::app
