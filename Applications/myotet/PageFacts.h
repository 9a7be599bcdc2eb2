// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "Report/Html.h"
#include "Report/Page.h"

namespace myotet::app {

/// A run's report.json, its keys in their order.
using RunJson = nlohmann::ordered_json;

/// A text, number or list of texts of an object; null is empty, no number, none. A key that is
/// not there, or of another kind, throws what nlohmann throws.
[[nodiscard]] std::string text_of(const RunJson& object, const char* key);
[[nodiscard]] double number_of(const RunJson& object, const char* key);
[[nodiscard]] std::vector<std::string> texts_of(const RunJson& object, const char* key);

/// A file that a report names, in its folder. Throws InputError when the name leads out of it
/// or the file is not there.
[[nodiscard]] std::filesystem::path file_in(const std::filesystem::path& folder,
                                            const std::string& name);

/// A number with what it is called.
struct Fact {
    std::string name;
    report::Cell value;
};

/// A sentence that says how a run ended, and its main numbers.
[[nodiscard]] std::string lead_html(bool good, const std::string& verdict,
                                    const std::vector<Fact>& facts);

/// "edge_length_mm" as "edge length, mm".
[[nodiscard]] std::string words_of(const std::string& key);

/// Warnings, and what else a run has to say; nothing to say is said, too.
[[nodiscard]] report::Section notes_section(const RunJson& run, std::string notes);

/// Input, options, version, threads, memory, times and files; `inputs` names the keys of what
/// was read.
[[nodiscard]] report::Section run_section(const RunJson& run,
                                          const std::vector<std::string>& inputs);

}  // namespace myotet::app
