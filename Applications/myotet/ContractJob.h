// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "Contraction/Run.h"

namespace myotet::app {

/// What `myotet contract` was asked for.
struct ContractJobOptions {
    std::filesystem::path scene, output;
    bool resume = false;
    int checkpoint_every = 10;  ///< steps
    int threads = 0;            ///< 0: as many as the process may use
    contraction::Series series = contraction::Series::by_count;
    bool pictures = true;  ///< drawn of each frame, and a sheet of them
};

/// A body as the report tells it.
struct ContractBody {
    std::string name;
    std::size_t nodes = 0, tets = 0;
    contraction::Architecture architecture;
    std::vector<std::string> notes;
};

/// What a run came to, or would take.
struct ContractReport {
    std::string scene, title, output, fingerprint;
    ContractJobOptions options;
    std::vector<ContractBody> bodies;
    contraction::RunSummary run;
    double end = 0, step = 0;  ///< s, of the scene
    int threads = 0;
    std::map<std::string, double> seconds;  ///< by stage
    double peak_memory = 0;                 ///< bytes
    double processor_seconds = 0;
    std::vector<std::string> warnings;
};

/// Reads, meshes and checks a scene and says what it holds; writes nothing.
[[nodiscard]] ContractReport check_scene(const ContractJobOptions& options, ProgressSink& progress);

/// Runs a scene; see contraction::run_scene for what is written, besides report.json and pictures/.
/// A bad scene throws before anything is written.
[[nodiscard]] ContractReport run_contract_job(const ContractJobOptions& options,
                                              ProgressSink& progress);

/// report.json's content, and a table for people.
[[nodiscard]] std::string to_json(const ContractReport& report);
[[nodiscard]] std::string to_table(const ContractReport& report);

}  // namespace myotet::app
