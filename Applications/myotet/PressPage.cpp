// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string_view>

#include "Core/Errors.h"
#include "Pages.h"
#include "Report/Svg.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

using report::HtmlTable;
using report::number_cell;
using report::text_cell;

constexpr std::size_t kMostFrames = 60;  // of a strip; more are thinned out evenly

std::string strip_html(const RunJson& run, const fs::path& folder) {
    std::vector<std::string> names;
    for (const std::string& file : texts_of(run, "files"))
        if (file.starts_with("pictures/frame_")) names.push_back(file);
    if (names.empty()) return report::paragraph("No pictures were drawn.");
    const std::size_t step = (names.size() + kMostFrames - 1) / kMostFrames;
    report::Strip strip{.name = "The organ as it is pressed", .frames = {}, .plays = true};
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i % step != 0 && i + 1 != names.size()) continue;
        const report::Picture picture = report::read_png(file_in(folder, names[i]));
        std::string stem = fs::path(names[i]).stem().string();
        std::ranges::replace(stem, '_', ' ');
        strip.frames.push_back(
            {stem, "<img src=\"" + report::data_uri(picture) + "\" width=\"" +
                       std::to_string(picture.width) + "\" height=\"" +
                       std::to_string(picture.height) + "\" alt=\"" +
                       report::escaped(stem + ": the organ from the side and as it is pressed") +
                       "\"/>"});
    }
    return report::to_html(strip) + report::paragraph(
                                        "Coloured by displacement where it is worth mention; tools "
                                        "are grey, and left out at "
                                        "the right. Triangles "
                                        "are small where the surface is refined.");
}

// A kind of quantity by the end of its columns' names.
struct Quantity {
    std::string_view ending, title, unit;
};
constexpr std::array<Quantity, 9> kQuantities{{
    {"_force [N]", "Force", "N"},
    {"largest_displacement [mm]", "Largest displacement", "mm"},
    {"_displacement [mm]", "Displacement where it is pressed", "mm"},
    {"nodes", "Nodes in use", "nodes"},
    {"springs", "Springs in use", "springs"},
    {"lumen_volume [mm^3]", "Volume of the lumen", "mm\xC2\xB3"},
    {"volume [mm^3]", "Volume enclosed", "mm\xC2\xB3"},
    {"pressure [MPa]", "Pressure of the cavity", "MPa"},
    {"energy [N mm]", "Energy", "N mm"},
}};

std::string curves_html(const fs::path& folder) {
    const skeleton::Table history = skeleton::read_table(file_in(folder, "history.csv"));
    std::vector<char> shown(history.columns.size(), 0);
    std::string html = "<div class=\"charts\">\n";
    for (const Quantity& quantity : kQuantities) {
        report::Panel panel{.title = std::string(quantity.title),
                            .y_label = std::string(quantity.unit),
                            .lines = {}};
        for (std::size_t c = 0; c < history.columns.size(); ++c) {
            const std::string& name = history.columns[c];
            if (shown[c] || !name.ends_with(quantity.ending)) continue;
            shown[c] = 1;
            report::Line line{.name = name.substr(0, name.size() - quantity.ending.size()),
                              .x = history.times};
            if (line.name.empty()) line.name = "the organ";
            for (const auto& row : history.rows) line.y.push_back(row[c]);
            panel.lines.push_back(std::move(line));
        }
        if (!panel.lines.empty()) html += report::chart_figure(panel, "time, s");
    }
    return html + "</div>\n";
}

std::string levels_html(const RunJson& run) {
    HtmlTable table{.caption = "Levels, each of the whole surface",
                    .columns = {"level", "nodes", "springs"},
                    .rows = {}};
    int level = 0;
    for (const RunJson& row : run.at("organ").at("levels"))
        table.rows.push_back({number_cell(level++), number_cell(number_of(row, "nodes")),
                              number_cell(number_of(row, "springs"))});
    return report::to_html(table);
}

std::string facts_html(const RunJson& facts, const std::string& caption) {
    HtmlTable table{.caption = caption, .columns = {"what", "value"}, .rows = {}};
    for (const auto& [key, value] : facts.items()) {
        if (value.is_number())
            table.rows.push_back({text_cell(words_of(key)), number_cell(value.get<double>())});
        else if (value.is_string() && !value.get<std::string>().empty())
            table.rows.push_back({text_cell(words_of(key)), text_cell(value.get<std::string>())});
    }
    return report::to_html(table);
}

std::string organ_html(const RunJson& run) {
    const RunJson& organ = run.at("organ");
    std::string html = facts_html(organ, "The organ") + levels_html(run);
    if (!organ.at("lumen").is_null()) html += facts_html(organ.at("lumen"), "Its lumen");
    return html + facts_html(run.at("wall"), "Its wall");
}

std::string quantities_html(const RunJson& run) {
    HtmlTable table{.caption = "What changed, from the first moment to the last",
                    .columns = {"quantity", "unit", "first", "last", "least", "most"},
                    .rows = {}};
    for (const auto& [name, column] : run.at("history").items()) {
        if (name == "time") continue;
        std::string words = name;
        std::ranges::replace(words, '_', ' ');
        std::vector<report::Cell> row{text_cell(words), text_cell(text_of(column, "unit"))};
        for (const char* key : {"first", "last", "least", "most"})
            row.push_back(number_cell(number_of(column, key)));
        table.rows.push_back(std::move(row));
    }
    return report::to_html(table);
}

std::string lead_of(const RunJson& run) {
    const RunJson& history = run.at("history");
    const bool good = run.at("completed").get<bool>();
    return lead_html(good, good ? "Computed to the end" : text_of(run, "message"),
                     {{"reached, s", number_cell(number_of(run, "reached_s"))},
                      {"largest displacement, mm",
                       number_cell(number_of(history.at("largest_displacement"), "most"))},
                      {"largest displacement at the end, mm",
                       number_cell(number_of(history.at("largest_displacement"), "last"))},
                      {"nodes in use at most", number_cell(number_of(history.at("nodes"), "most"))},
                      {"steps", number_cell(number_of(run, "steps"))}});
}

}  // namespace

report::Page press_page(const RunJson& run, const fs::path& folder) {
    const std::string title = text_of(run, "title");
    return {.title = title.empty() ? "Pressing " + text_of(run.at("organ"), "name") : title,
            .lead = lead_of(run),
            .sections = {{"pictures", "Pictures", strip_html(run, folder)},
                         {"curves", "Curves", curves_html(folder)},
                         {"organ", "Organ", organ_html(run)},
                         {"numbers", "Numbers", quantities_html(run)},
                         notes_section(run, report::list_html(texts_of(run, "notes"))),
                         run_section(run, {"input", "input_sha256", "tool", "tool_sha256", "output",
                                           "end_s", "steps", "rejected_steps", "force_evaluations",
                                           "level_switches", "switched_energy_N_mm"})}};
}

}  // namespace myotet::app
