// SPDX-License-Identifier: Apache-2.0
#include "HistoryText.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "Text.h"

namespace myotet::app {
namespace {

struct Range {
    double first = 0, last = 0, least = 0, most = 0;
};

Range range_of(const contraction::History& history, std::size_t c) {
    Range range{history.rows.front()[c], history.rows.back()[c], history.rows.front()[c],
                history.rows.front()[c]};
    for (const auto& row : history.rows) {
        range.least = std::min(range.least, row[c]);
        range.most = std::max(range.most, row[c]);
    }
    return range;
}

}  // namespace

nlohmann::ordered_json history_json(const contraction::History& history) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    if (history.rows.empty()) return json;
    for (std::size_t c = 0; c < history.columns.size(); ++c) {
        const Range range = range_of(history, c);
        json[history.columns[c].name] = {{"unit", history.columns[c].unit},
                                         {"first", range.first},
                                         {"last", range.last},
                                         {"least", range.least},
                                         {"most", range.most}};
    }
    return json;
}

std::string history_table(const contraction::History& history) {
    if (history.rows.empty()) return "";
    std::string text =
        "  quantity                                first       last      least       most\n";
    for (std::size_t c = 1; c < history.columns.size(); ++c) {
        const std::string& name = history.columns[c].name;
        if (name.ends_with("_x") || name.ends_with("_y") || name.ends_with("_z")) continue;
        const Range range = range_of(history, c);
        text += formatted("  %-30s %-5s %9.4g  %9.4g  %9.4g  %9.4g\n", name.c_str(),
                          history.columns[c].unit.c_str(), range.first, range.last, range.least,
                          range.most);
    }
    return text;
}

}  // namespace myotet::app
