// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "Pages.h"
#include "Report/Svg.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

using report::HtmlTable;
using report::number_cell;
using report::text_cell;

bool has_file(const RunJson& run, const std::string& name) {
    const std::vector<std::string> files = texts_of(run, "files");
    return std::ranges::find(files, name) != files.end();
}

// Coordinates whose moments or forces something else bears.
std::vector<std::string> held_columns(const RunJson& run) {
    std::vector<std::string> held;
    for (const RunJson& coordinate : run.at("coordinates"))
        if (coordinate.at("left_to_what_holds_it").get<bool>())
            for (const char* ending : {"_moment", "_force"})
                held.push_back(text_of(coordinate, "name") + ending);
    return held;
}

std::string chart_html(const fs::path& file, const std::string& title, const std::string& unit,
                       const std::vector<std::string>& left_out = {}) {
    const skeleton::Table table = skeleton::read_table(file);
    report::Panel panel{.title = title, .y_label = unit, .lines = {}};
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        if (std::ranges::find(left_out, table.columns[c]) != left_out.end()) continue;
        report::Line line{.name = table.columns[c], .x = table.times, .y = {}};
        for (const std::vector<double>& row : table.rows) line.y.push_back(row[c]);
        panel.lines.push_back(std::move(line));
    }
    return panel.lines.empty() ? "" : report::chart_figure(panel, "time, s");
}

std::string curves_html(const RunJson& run, const fs::path& folder) {
    std::string html = "<div class=\"charts\">\n";
    const auto add = [&](const char* name, const char* title, const char* unit,
                         const std::vector<std::string>& left_out = {}) {
        if (has_file(run, name)) html += chart_html(file_in(folder, name), title, unit, left_out);
    };
    const std::vector<std::string> held = held_columns(run);
    add("activation.sto", "Activations", "from 0 to 1");
    add("force.sto", "Forces of muscles", "N");
    add("moments.sto", "Moments of joints, without those that are held", "N mm", held);
    add("reserves.sto", "Reserves", "N mm", held);
    add("moments_left.sto", "Moments that the curves leave", "N mm", held);
    add("synergies.sto", "Synergies", "amount");
    add("path_length.sto", "Lengths of muscles with their tendons", "mm");
    return html + "</div>\n";
}

std::string muscles_html(const RunJson& run) {
    HtmlTable table{
        .caption = "Muscles",
        .columns = {"muscle", "highest activation", "highest force, N", "times at a bound"},
        .rows = {}};
    for (const RunJson& muscle : run.at("muscles"))
        table.rows.push_back({text_cell(text_of(muscle, "name")),
                              number_cell(number_of(muscle, "highest_activation")),
                              number_cell(number_of(muscle, "highest_force_N")),
                              number_cell(number_of(muscle, "times_at_a_bound"))});
    return report::to_html(table);
}

std::string coordinates_html(const RunJson& run) {
    HtmlTable table{.caption = "Coordinates",
                    .columns = {"coordinate", "unit", "largest torque", "largest reserve or hold",
                                "root mean square of it", "most that nothing carries", "held"},
                    .rows = {}};
    for (const RunJson& coordinate : run.at("coordinates")) {
        const bool turns = coordinate.contains("largest_torque_N_mm");
        const std::string unit = turns ? "_N_mm" : "_N";
        const bool held = coordinate.at("left_to_what_holds_it").get<bool>();
        std::vector<report::Cell> row{text_cell(text_of(coordinate, "name")),
                                      text_cell(turns ? "N mm" : "N")};
        for (const char* key : {"largest_torque", "largest_reserve", "reserve_rms", "most_missing"})
            row.push_back(number_cell(number_of(coordinate, (key + unit).c_str())));
        row.push_back(text_cell(held ? "left to what holds it" : "no"));
        table.rows.push_back(std::move(row));
    }
    return report::to_html(table);
}

}  // namespace

report::Page activate_page(const RunJson& run, const fs::path& folder) {
    const fs::path motion = text_of(run, "motion");
    const bool good = has_file(run, "activation.sto");
    const std::string message = text_of(run, "message");
    return {
        .title = "Activations for " + motion.filename().string(),
        .lead = lead_html(
            good, good && message.empty() ? "All times converged." : message,
            {{"muscles", number_cell(static_cast<double>(run.at("muscles").size()))},
             {"times", number_cell(number_of(run, "times"))},
             {"from, s", number_cell(number_of(run, "begin_s"))},
             {"to, s", number_cell(number_of(run, "end_s"))},
             {"largest torque residual", number_cell(number_of(run, "largest_torque_residual"))}}),
        .sections = {{"curves", "Curves", curves_html(run, folder)},
                     {"muscles", "Muscles", muscles_html(run)},
                     {"coordinates", "Coordinates", coordinates_html(run)},
                     notes_section(run, report::list_html(texts_of(run, "notes"))),
                     run_section(run, {"model", "model_sha256", "motion", "motion_sha256", "output",
                                       "iterations", "largest_kkt_residual"})}};
}

}  // namespace myotet::app
