// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "LevelSetStage.h"

namespace myotet::app {

/// What every report says about its run.
struct RunFacts {
    std::string input, input_sha256, output;
    std::vector<std::pair<std::string, std::string>> options_text;  ///< as resolved
    std::vector<std::pair<std::string, double>> options_number;
    std::vector<std::int32_t> labels;
    std::optional<levelset::GapReport> gaps;
    std::optional<levelset::HealSummary> healing;
    std::vector<repair::StepReport> repair;
    int threads = 0;
    double peak_memory = 0;  ///< bytes
    double processor_seconds = 0;
    std::map<std::string, double> seconds;  ///< by stage
    std::vector<std::string> warnings;
};

/// What input, level sets and their options say; without times.
[[nodiscard]] RunFacts describe_level_sets(const ScanOptions& options,
                                           const LevelSetChoices& choices, const Scan& scan,
                                           const TissueSets& sets);

}  // namespace myotet::app
