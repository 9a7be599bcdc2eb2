// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "Contraction/TimeSeries.h"

namespace myotet::app {

/// What report.json tells of a history: of each column its unit, where it begins and ends, and
/// how far it goes; an empty object where there are no rows.
[[nodiscard]] nlohmann::ordered_json history_json(const contraction::History& history);

/// The same as a table for people, without the time and the parts of vectors; empty where there
/// are no rows.
[[nodiscard]] std::string history_table(const contraction::History& history);

}  // namespace myotet::app
