// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <string>

#include "Console.h"
#include "LevelSetStage.h"
#include "Scan.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::app {

/// How a command tells what it came to.
struct Talk {
    bool json = false, quiet = false, verbose = false;
    [[nodiscard]] Verbosity verbosity() const {
        return quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::normal;
    }
};

/// --json, --quiet and --verbose.
void add_talk_options(CLI::App& command, Talk& talk);

/// --threads; 0: as many as the process may use.
void add_threads_option(CLI::App& command, int& threads);

/// A flag --no-... that takes away what is there without it.
void add_no_flag(CLI::App& command, const std::string& name, bool& wanted, const std::string& what);

/// --names, --orientation and --one-hot: how a label file is read.
void add_read_options(CLI::App& command, segmentation::ReadOptions& options);

/// INPUT, --labels, those of add_read_options and --input-unit.
void add_scan_options(CLI::App& command, ScanOptions& options);

/// --smooth and what else becomes of the labels before they are results.
void add_level_set_options(CLI::App& command, LevelSetChoices& choices);

/// --no-report: whether a run ends with its page.
void add_page_option(CLI::App& command, bool& wanted);

/// Accepts numbers above zero; CLI11's own check lets NaN and infinity pass.
inline const CLI::Validator kPositive(
    [](std::string& text) -> std::string {
        double number = 0;
        if (CLI::detail::lexical_cast(text, number) && number > 0 && std::isfinite(number))
            return {};
        return "'" + text + "' is not a number above 0";
    },
    "");

/// Accepts zero as well.
inline const CLI::Validator kNotNegative(
    [](std::string& text) -> std::string {
        double number = 0;
        if (CLI::detail::lexical_cast(text, number) && number >= 0 && std::isfinite(number))
            return {};
        return "'" + text + "' is not a number of at least 0";
    },
    "");

/// Accepts the names of a table and gives their values; CLI11's own prints the values too.
/// The validator's name is "{a,b}", the names.
template <class Value>
CLI::Validator one_of(const std::map<std::string, Value>& table) {
    std::string words;
    for (const auto& [name, value] : table) words += (words.empty() ? "" : ",") + name;
    return CLI::Validator(
        [table](std::string& text) -> std::string {
            if (const auto found = table.find(text); found != table.end()) {
                text = std::to_string(static_cast<int>(found->second));
                return {};
            }
            std::string names;
            for (const auto& [name, value] : table) names += (names.empty() ? "" : ", ") + name;
            return "'" + text + "' is none of " + names;
        },
        "", "{" + words + "}");
}

}  // namespace myotet::app
