// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "Activation/SharedCurves.h"

namespace myotet::app {

/// What `myotet activate` was asked for.
struct ActivateJobOptions {
    std::filesystem::path model, motion, output;
    activation::Criterion criterion = activation::Criterion::activation;
    double exponent = 2;
    activation::Tendons tendons = activation::Tendons::as_modelled;
    bool passive = true;                ///< whether relaxed muscles resist stretch
    bool still = false;                 ///< static: no speeds, no inertia
    std::filesystem::path bounds, emg;  ///< tables; empty: none
    double tracking = 1;                ///< of what `emg` says
    std::filesystem::path synergies;    ///< a table; empty: each muscle on its own
    double curves = 0;  ///< s between knots of activation curves; 0: each time on its own
    std::vector<std::string> reserves;  ///< "NAME=STRENGTH", or "STRENGTH" for all, N mm or N
    std::vector<std::string> held;      ///< coordinates whose torque is left to what holds them
    double cutoff_hz = 0;               ///< of the motion; 0: as it is
    double from = 0, to = 0;            ///< s; to <= from: the whole motion
    double step = 0;                    ///< s; 0: the motion's own times, of key frames 10 ms
    int threads = 0;                    ///< 0: as many as the process may use
    bool pictures = true;               ///< activation.png
};

/// A muscle or coordinate as the report tells it.
struct ActivateMuscle {
    std::string name;
    double highest_activation = 0, highest_force = 0;  ///< N
    int at_bounds = 0;                                 ///< times
};
struct ActivateCoordinate {
    std::string name;
    bool rotational = true, held = false;
    double largest_torque = 0;   ///< N mm or N
    double largest_reserve = 0;  ///< N mm or N
    double reserve_rms = 0;
    double missing = 0;  ///< most that nothing carries, N mm or N
};

/// What a run came to.
struct ActivateReport {
    std::string model, motion, output;
    std::string model_sha256, motion_sha256;
    activation::Status status = activation::Status::not_converged;
    std::string message;
    std::vector<ActivateMuscle> muscles;
    std::vector<ActivateCoordinate> coordinates;
    std::size_t times = 0;
    double begin = 0, end = 0;  ///< s
    double largest_residual = 0, largest_torque_residual = 0;
    int iterations = 0;
    std::optional<activation::FitSummary> curves;  ///< instead of each time on its own
    std::map<std::string, double> seconds;         ///< by stage
    double peak_memory = 0, processor_seconds = 0;
    std::vector<std::pair<std::string, std::string>> options;  ///< as resolved
    std::vector<std::string> warnings, notes, files;
};

/// Inverse dynamics, moment arms and muscle force distribution of a motion; writes
/// path_length.sto, moment_arms.sto, moments.sto and report.json and, when all times
/// converged, activation.sto, force.sto, reserves.sto where there are any, and
/// activation.png. Bad input throws before anything is written.
[[nodiscard]] ActivateReport run_activate_job(const ActivateJobOptions& options,
                                              ProgressSink& progress);

/// report.json's content, and a table for people.
[[nodiscard]] std::string to_json(const ActivateReport& report);
[[nodiscard]] std::string to_table(const ActivateReport& report);

}  // namespace myotet::app
