// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "MeshViews.h"
#include "PageFacts.h"
#include "Report/Chart.h"
#include "Report/Page.h"
#include "Skeleton/Table.h"

namespace myotet::app {

/// The page of each kind of run, from its report.json and what else its folder holds.
/// Throw InputError, IoError, and what nlohmann throws for a report that is damaged.
[[nodiscard]] report::Page mesh_page(const RunJson& run, const MeshViews& views);
[[nodiscard]] report::Page contract_page(const RunJson& run, const std::filesystem::path& folder);
[[nodiscard]] report::Page press_page(const RunJson& run, const std::filesystem::path& folder);
[[nodiscard]] report::Page activate_page(const RunJson& run, const std::filesystem::path& folder);

/// A chart of each kind of quantity that a contraction's history tells, with the lines of all
/// bodies. Columns are called "biceps_length [mm]".
[[nodiscard]] std::vector<report::Panel> history_panels(const skeleton::Table& history);

}  // namespace myotet::app
