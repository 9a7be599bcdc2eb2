// SPDX-License-Identifier: Apache-2.0
#include "PageFacts.h"

#include <array>
#include <cmath>

#include "Core/Errors.h"

namespace myotet::app {
namespace fs = std::filesystem;
using report::Cell;
using report::HtmlTable;

namespace {

// A value as a table shows it.
Cell cell_of(const RunJson& value) {
    if (value.is_null() || (value.is_string() && value.get<std::string>().empty()))
        return report::text_cell("not given");
    if (value.is_number()) return {report::number_html(value.get<double>()), false};
    if (value.is_boolean()) return report::text_cell(value.get<bool>() ? "yes" : "no");
    if (value.is_string()) return report::text_cell(value.get<std::string>());
    std::string list;
    for (const RunJson& one : value)
        list +=
            (list.empty() ? "" : ", ") + (one.is_string() ? report::escaped(one.get<std::string>())
                                                          : report::escaped(one.dump()));
    return {list.empty() ? "none" : list, false};
}

HtmlTable seconds_table(const RunJson& run) {
    HtmlTable table{.caption = "Times of the stages", .columns = {"stage", "s"}, .rows = {}};
    for (const auto& [stage, seconds] : run.at("seconds").items())
        table.rows.push_back(
            {report::text_cell(words_of(stage)), report::number_cell(seconds.get<double>())});
    return table;
}

}  // namespace

std::string text_of(const RunJson& object, const char* key) {
    const RunJson& value = object.at(key);
    return value.is_null() ? "" : value.get<std::string>();
}

double number_of(const RunJson& object, const char* key) {
    const RunJson& value = object.at(key);
    return value.is_null() ? std::nan("") : value.get<double>();
}

std::vector<std::string> texts_of(const RunJson& object, const char* key) {
    const RunJson& value = object.at(key);
    return value.is_null() ? std::vector<std::string>{} : value.get<std::vector<std::string>>();
}

fs::path file_in(const fs::path& folder, const std::string& name) {
    const fs::path path(name);
    bool within = !name.empty() && path.is_relative();
    for (const fs::path& part : path) within = within && part != "..";
    if (!within)
        throw InputError((folder / "report.json").string() + ": the file '" + name +
                         "' is not in the folder of results; make them again");
    if (std::error_code failed; !fs::is_regular_file(folder / path, failed))
        throw InputError((folder / path).string() +
                         ": report.json names this file, but it is not there; make the results "
                         "again");
    return folder / path;
}

std::string lead_html(bool good, const std::string& verdict, const std::vector<Fact>& facts) {
    std::string html = "<p class=\"verdict" + std::string(good ? "" : " bad") + "\">" +
                       (good ? "\xE2\x9C\x93 " : "\xE2\x9C\x97 ") + report::escaped(verdict) +
                       "</p>\n<dl class=\"facts\">\n";
    for (const Fact& fact : facts)
        html += "<div><dt>" + report::escaped(fact.name) + "</dt><dd>" + fact.value.html +
                "</dd></div>\n";
    return html + "</dl>\n";
}

std::string words_of(const std::string& key) {
    static const std::array<std::pair<std::string, std::string>, 8> kUnits{{
        {"_N_mm", ", N mm"},
        {"_mm3", ", mm\xC2\xB3"},
        {"_mm2", ", mm\xC2\xB2"},
        {"_mm", ", mm"},
        {"_deg", ", degrees"},
        {"_Hz", ", Hz"},
        {"_N", ", N"},
        {"_s", ", s"},
    }};
    std::string words = key, unit;
    for (const auto& [ending, written] : kUnits)
        if (words.size() > ending.size() && words.ends_with(ending)) {
            words.resize(words.size() - ending.size());
            unit = written;
            break;
        }
    for (char& c : words)
        if (c == '_') c = ' ';
    return words + unit;
}

report::Section notes_section(const RunJson& run, std::string notes) {
    const std::vector<std::string> warnings = texts_of(run, "warnings");
    std::string html;
    if (!warnings.empty()) html += "<h3>Warnings</h3>\n" + report::list_html(warnings);
    if (!notes.empty()) html += "<h3>Notes</h3>\n" + std::move(notes);
    if (html.empty()) html = report::paragraph("There is nothing to warn of.");
    return {"notes", "Notes and warnings", html};
}

report::Section run_section(const RunJson& run, const std::vector<std::string>& inputs) {
    constexpr double kMegabyte = 1e6;
    HtmlTable facts{.caption = "What was run", .columns = {"what", "value"}, .rows = {}};
    for (const std::string& key : inputs)
        facts.rows.push_back({report::text_cell(words_of(key)), cell_of(run.at(key))});
    for (const char* key : {"version", "frame", "units", "threads", "processor_seconds"})
        if (run.contains(key))
            facts.rows.push_back({report::text_cell(words_of(key)), cell_of(run.at(key))});
    facts.rows.push_back(
        {report::text_cell("peak memory, MB"),
         {report::number_html(std::round(number_of(run, "peak_memory_bytes") / kMegabyte)),
          false}});
    std::string html = report::to_html(facts);
    if (run.contains("options")) {
        HtmlTable options{
            .caption = "Options, as resolved", .columns = {"option", "value"}, .rows = {}};
        for (const auto& [key, value] : run.at("options").items())
            options.rows.push_back({report::text_cell(words_of(key)), cell_of(value)});
        html += report::to_html(options);
    }
    return {"run", "The run", html + report::to_html(seconds_table(run))};
}

}  // namespace myotet::app
