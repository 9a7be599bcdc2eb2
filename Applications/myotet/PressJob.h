// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "Contraction/TimeSeries.h"
#include "PressOrgan.h"
#include "PressPlan.h"

namespace myotet::app {

/// What `myotet press` was asked for.
struct PressJobOptions {
    OrganOptions organ;  ///< what it is held to comes from the tool's file
    std::filesystem::path tool, output;
    int levels = 2;        ///< of refinement
    bool adapt = true;     ///< else refined everywhere, always
    bool shape = true;     ///< shape-preserving springs
    bool pictures = true;  ///< drawn of each frame, and a sheet of them
    int threads = 0;       ///< 0: as many as the process may use
};

/// What a run came to.
struct PressReport {
    std::string input, input_sha256, tool, tool_sha256, output, title;
    std::string name;
    std::int32_t label = 0;
    bool adapt = true, shape = true, thickness_measured = false;
    int levels = 0, threads = 0;
    double edge_length = 0;  ///< asked of level 0, mm; 0: the surface as given
    double area = 0;         ///< of level 0, mm^2
    double end = 0;          ///< s
    std::size_t held = 0;    ///< points of level 0
    std::vector<std::size_t> nodes_of_level, springs_of_level;
    membrane::Wall wall;
    std::string material;
    std::optional<Lumen> lumen;
    membrane::Status status = membrane::Status::finished;
    std::string message;
    double reached = 0;  ///< s
    std::int64_t steps = 0, evaluations = 0, rejected = 0, switches = 0;
    double switched_energy = 0;  ///< N mm
    contraction::History history;
    std::size_t frames = 0;
    std::map<std::string, double> seconds;  ///< by stage
    double peak_memory = 0;                 ///< bytes
    double processor_seconds = 0;
    std::vector<std::string> warnings, notes, files;
};

/// Presses a hollow organ: frames (.vtu, tools as .vtp, a .pvd of all), history.csv,
/// pictures, report.json. When the run ends early, as unstable or sunk, what was reached
/// is kept. Throws before anything is written for bad input.
[[nodiscard]] PressReport run_press_job(const PressJobOptions& options, ProgressSink& progress);

/// report.json's content, and a table for people.
[[nodiscard]] std::string to_json(const PressReport& report);
[[nodiscard]] std::string to_table(const PressReport& report);

}  // namespace myotet::app
