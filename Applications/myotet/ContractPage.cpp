// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <string_view>

#include "Core/Errors.h"
#include "Pages.h"
#include "Report/Svg.h"
#include "ViewerScenes.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

using report::HtmlTable;
using report::number_cell;
using report::text_cell;

constexpr std::size_t kMostFrames = 60;      // of a strip; more are thinned out evenly
constexpr std::size_t kMostBytes = 9000000;  // of its pictures; beyond, it is thinned out too

// A kind of quantity by the end of its columns' names.
struct Quantity {
    std::string_view ending, title, unit;
};

constexpr std::array<Quantity, 10> kQuantities{{
    {"_activation", "Activation", "from 0 to 1"},
    {"_contact_force [N]", "Contact force", "N"},
    {"_force [N]", "Force at attachments", "N"},
    {"_length [mm]", "Length", "mm"},
    {"_fiber_stretch", "Mean fibre stretch", "length / length at rest"},
    {"_volume [mm^3]", "Volume", "mm\xC2\xB3"},
    {"_max_aspect_ratio", "Worst aspect ratio", "longest edge / shortest altitude"},
    {"_min_J", "Smallest J", "volume / volume at rest"},
    {"_contact_area [mm^2]", "Contact area", "mm\xC2\xB2"},
    {"_max_penetration [mm]", "Deepest penetration", "mm"},
}};

std::string spaced(std::string_view name) {
    std::string words(name);
    std::ranges::replace(words, '_', ' ');
    return words;
}

std::vector<double> column_of(const skeleton::Table& table, std::size_t c) {
    std::vector<double> values;
    for (const std::vector<double>& row : table.rows) values.push_back(row[c]);
    return values;
}

std::vector<std::string> frame_files(const RunJson& run) {
    std::vector<std::string> names;
    for (const std::string& file : texts_of(run, "files"))
        if (file.starts_with("pictures/frame_") && file.ends_with(".png")) names.push_back(file);
    return names;
}

// Every so many of them, so that the rest is few enough; the last stays.
std::vector<std::string> thinned(const std::vector<std::string>& names, std::size_t step) {
    std::vector<std::string> chosen;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (i % step == 0 || i + 1 == names.size()) chosen.push_back(names[i]);
    return chosen;
}

std::string strip_html(const RunJson& run, const fs::path& folder) {
    std::vector<std::string> names = frame_files(run);
    if (names.empty()) return report::paragraph("No pictures were drawn.");
    std::uintmax_t bytes = 0;
    for (const std::string& name : names) bytes += fs::file_size(file_in(folder, name));
    const std::size_t step = std::max((names.size() + kMostFrames - 1) / kMostFrames,
                                      static_cast<std::size_t>(bytes / kMostBytes) + 1);
    report::Strip strip{.name = "Frames of the contraction", .frames = {}, .plays = true};
    for (const std::string& name : thinned(names, step)) {
        const report::Picture picture = report::read_png(file_in(folder, name));
        const std::string stem = spaced(fs::path(name).stem().string());
        strip.frames.push_back(
            {stem, "<img src=\"" + report::data_uri(picture) + "\" width=\"" +
                       std::to_string(picture.width) + "\" height=\"" +
                       std::to_string(picture.height) + "\" alt=\"" +
                       report::escaped(stem + ": the bodies from the front and from the left") +
                       "\"/>"});
    }
    return report::to_html(strip) +
           report::paragraph(
               "Muscles and tendons are coloured by the stretch of their fibres, "
               "bones are ivory.");
}

std::string curves_html(const fs::path& folder) {
    std::string html = "<div class=\"charts\">\n";
    for (const report::Panel& panel :
         history_panels(skeleton::read_table(file_in(folder, "history.csv"))))
        html += report::chart_figure(panel, "time, s");
    return html + "</div>\n";
}

std::string bodies_html(const RunJson& run) {
    HtmlTable table{
        .caption = "Bodies",
        .columns = {"body", "nodes", "tetrahedra", "muscle volume, mm\xC2\xB3", "fibre length, mm",
                    "PCSA, mm\xC2\xB2", "isometric force expected, N"},
        .rows = {}};
    for (const RunJson& body : run.at("bodies")) {
        std::vector<report::Cell> row{text_cell(text_of(body, "name"))};
        for (const char* key : {"nodes", "tets"}) row.push_back(number_cell(number_of(body, key)));
        for (const char* key :
             {"muscle_volume_mm3", "fibre_length_mm", "pcsa_mm2", "isometric_force_expected_N"})
            row.push_back(body.contains(key) ? number_cell(number_of(body, key))
                                             : text_cell("no muscle"));
        table.rows.push_back(std::move(row));
    }
    return report::to_html(table);
}

std::string quantities_html(const RunJson& run) {
    HtmlTable table{.caption = "What changed, from the first moment to the last",
                    .columns = {"quantity", "unit", "first", "last", "least", "most"},
                    .rows = {}};
    for (const auto& [name, column] : run.at("history").items()) {
        if (name.starts_with("time")) continue;
        std::vector<report::Cell> row{text_cell(spaced(name)), text_cell(text_of(column, "unit"))};
        for (const char* key : {"first", "last", "least", "most"})
            row.push_back(number_cell(number_of(column, key)));
        table.rows.push_back(std::move(row));
    }
    return report::to_html(table);
}

std::string notes_html(const RunJson& run) {
    std::vector<std::string> notes;
    for (const RunJson& body : run.at("bodies"))
        for (const std::string& note : texts_of(body, "notes"))
            notes.push_back(text_of(body, "name") + ": " + note);
    return report::list_html(notes);
}

std::string lead_of(const RunJson& run) {
    return lead_html(
        run.at("completed").get<bool>(), text_of(run, "message"),
        {{"reached, s", number_cell(number_of(run, "reached_s"))},
         {"of, s", number_cell(number_of(run, "end_s"))},
         {"steps", number_cell(number_of(run, "steps"))},
         {"failed steps", number_cell(number_of(run, "failed_steps"))},
         {"iterations of Newton's method", number_cell(number_of(run, "newton_iterations"))}});
}

}  // namespace

std::vector<report::Panel> history_panels(const skeleton::Table& history) {
    std::vector<report::Panel> panels;
    std::vector<char> shown(history.columns.size(), 0);
    for (const Quantity& quantity : kQuantities) {
        report::Panel panel{.title = std::string(quantity.title),
                            .y_label = std::string(quantity.unit),
                            .lines = {}};
        for (std::size_t c = 0; c < history.columns.size(); ++c) {
            const std::string& name = history.columns[c];
            if (shown[c] || !name.ends_with(quantity.ending)) continue;
            shown[c] = 1;
            panel.lines.push_back({.name = spaced(std::string_view(name).substr(
                                       0, name.size() - quantity.ending.size())),
                                   .x = history.times,
                                   .y = column_of(history, c)});
        }
        if (!panel.lines.empty()) panels.push_back(std::move(panel));
    }
    return panels;
}

report::Page contract_page(const RunJson& run, const fs::path& folder) {
    const std::string title = text_of(run, "title");
    const fs::path scene = text_of(run, "scene");
    report::Page page{
        .title = title.empty() ? "Contraction of " + scene.filename().string() : title,
        .lead = lead_of(run),
        .sections = {
            {"view", "3D view", report::viewer_html(contraction_scene(run, folder))},
            {"pictures", "Pictures", strip_html(run, folder)},
            {"curves", "Curves", curves_html(folder)},
            {"bodies", "Bodies", bodies_html(run)},
            {"numbers", "Numbers", quantities_html(run)},
            notes_section(run, notes_html(run)),
            run_section(run, {"scene", "scene_sha256", "output", "step_s", "end_s",
                              "factorisations", "linear_iterations", "largest_residual"})}};
    return page;
}

}  // namespace myotet::app
