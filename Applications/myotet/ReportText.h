// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LevelSetJob.h"
#include "MeshReport.h"
#include "Sizing.h"

namespace myotet::app {

/// report.json's content.
[[nodiscard]] std::string to_json(const RunReport& report);

[[nodiscard]] std::string to_json(const LevelSetReport& report);

/// A forecast for programs.
[[nodiscard]] std::string to_json(const Forecast& forecast);

/// The tissues as a table for people.
[[nodiscard]] std::string to_table(const RunReport& report);

[[nodiscard]] std::string to_table(const LevelSetReport& report);

}  // namespace myotet::app
