// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "Pages.h"
#include "Report/Svg.h"
#include "Text.h"
#include "ViewerScenes.h"

namespace myotet::app {
namespace {

using report::Cell;
using report::HtmlTable;
using report::number_cell;
using report::text_cell;

constexpr int kWholeSide = 640;    // pixels
constexpr int kLargestCard = 360;  // pixels of a tissue's picture, when there are few
constexpr double kFewTissues = 16;
constexpr int kSmallestCard = 140;

std::string label_of(const RunJson& tissue) {
    const int layer = tissue.at("layer").get<int>();
    const std::string label = std::to_string(tissue.at("label").get<std::int32_t>());
    return layer > 0 ? std::to_string(layer) + ":" + label : label;
}

std::string swatch(const report::Colour& colour) {
    return "<span class=\"swatch\" style=\"background:" + report::css_colour(colour) + "\"></span>";
}

// The first cell of a tissue's row: its colour, value and name.
Cell tissue_cell(const RunJson& tissue, const TissueView& view) {
    return {swatch(view.colour) +
            report::escaped(label_of(tissue) + " " + text_of(tissue, "name"))};
}

bool is_good(const RunJson& tissue) { return texts_of(tissue, "broken_promises").empty(); }

std::string lead_of(const RunJson& run) {
    double tets = 0, smallest = 180, largest = 0, aspect = 0;
    std::size_t broken = 0;
    for (const RunJson& tissue : run.at("tissues")) {
        broken += !is_good(tissue);
        if (number_of(tissue, "tets") == 0) continue;
        tets += number_of(tissue, "tets");
        smallest = std::fmin(smallest, number_of(tissue, "min_dihedral_deg"));
        largest = std::fmax(largest, number_of(tissue, "max_dihedral_deg"));
        aspect = std::fmax(aspect, number_of(tissue, "max_aspect_ratio"));
    }
    const std::size_t count = run.at("tissues").size();
    const std::string verdict =
        broken == 0 ? "Each mesh keeps all promises."
                    : counted(static_cast<std::int64_t>(broken), "mesh") +
                          (broken > 1 ? "es break" : " breaks") + " a promise and " +
                          (broken > 1 ? "were" : "was") + " not written; see Quality.";
    return lead_html(broken == 0, verdict,
                     {{"tissues", number_cell(static_cast<double>(count))},
                      {"tetrahedra", number_cell(tets)},
                      {"dihedral angles, degrees",
                       {report::number_html(smallest) + " to " + report::number_html(largest)}},
                      {"worst aspect ratio", number_cell(aspect)}});
}

std::string pictures_html(const MeshViews& views) {
    std::string html = "<div class=\"grid\">\n";
    for (const NamedPicture& one : whole_pictures(views, kWholeSide))
        html += report::figure(one.picture, "all tissues " + one.caption, one.caption);
    html += "</div>\n";
    if (views.box.empty()) return report::paragraph("No mesh was written.");
    return html + report::paragraph(
                      "L and R are the patient's left and right, A and P front and back, S and I "
                      "above and below.");
}

std::string cards_html(const RunJson& run, const MeshViews& views) {
    const double shrink = std::sqrt(kFewTissues / static_cast<double>(views.tissues.size()));
    const int side =
        std::max(kSmallestCard, static_cast<int>(kLargestCard * std::min(1.0, shrink)));
    std::string html = "<div class=\"grid tissues\">\n";
    for (std::size_t t = 0; t < views.tissues.size(); ++t) {
        const TissueView& view = views.tissues[t];
        const RunJson& tissue = run.at("tissues")[t];
        html += "<figure>";
        if (view.surface.triangles.empty()) {
            html += "<p>no mesh</p>";
        } else {
            const report::Picture picture = tissue_picture(view, side, Opened::no);
            html += "<img src=\"" + report::data_uri(picture) + "\" width=\"" +
                    std::to_string(picture.width) + "\" height=\"" +
                    std::to_string(picture.height) + "\" alt=\"" +
                    report::escaped(view.name + " from the front") + "\"/>";
        }
        html += "<figcaption>" + tissue_cell(tissue, view).html + "<br/>" +
                report::number_html(number_of(tissue, "tets")) +
                " tetrahedra</figcaption></figure>\n";
    }
    return html + "</div>\n";
}

HtmlTable census_table(const RunJson& run, const MeshViews& views) {
    HtmlTable table{
        .caption = "What went in and what came out, by tissue",
        .columns = {"tissue", "voxels", "pieces in", "pieces out", "volume in, mm\xC2\xB3",
                    "volume out, mm\xC2\xB3", "change, %", "surface moved, 95 %, mm",
                    "moved at most, mm", "voxels lost", "voxels gained"},
        .rows = {}};
    for (std::size_t t = 0; t < views.tissues.size(); ++t) {
        const RunJson& tissue = run.at("tissues")[t];
        const double before = number_of(tissue, "volume_labels_mm3"),
                     after = number_of(tissue, "volume_mesh_mm3");
        const double hundredths = 1e4 * (after - before) / before;  // as to_table rounds it
        std::vector<Cell> row{tissue_cell(tissue, views.tissues[t])};
        for (const char* key : {"voxels", "components_in", "components_out"})
            row.push_back(number_cell(number_of(tissue, key)));
        row.push_back(number_cell(before));
        row.push_back(number_cell(after));
        row.push_back(number_cell(std::round(hundredths) / 100 + 0.0));
        const RunJson& smoothing = tissue.at("smoothing");
        for (const char* key :
             {"moved_95_percent_mm", "moved_max_mm", "voxels_lost", "voxels_gained"})
            row.push_back(number_cell(smoothing.is_null() ? NAN : number_of(smoothing, key)));
        table.rows.push_back(std::move(row));
    }
    return table;
}

HtmlTable quality_table(const RunJson& run, const MeshViews& views) {
    HtmlTable table{.caption = "Shapes and distances, by tissue",
                    .columns = {"tissue", "points", "tetrahedra",
                                "smallest dihedral angle, degrees", "largest", "mean aspect ratio",
                                "worst", "edge asked, mm", "edge on the surface, median, mm",
                                "distance from the surface, mean, mm", "at most, mm"},
                    .rows = {}};
    for (std::size_t t = 0; t < views.tissues.size(); ++t) {
        const RunJson& tissue = run.at("tissues")[t];
        std::vector<Cell> row{tissue_cell(tissue, views.tissues[t])};
        for (const char* key :
             {"vertices", "tets", "min_dihedral_deg", "max_dihedral_deg", "mean_aspect_ratio",
              "max_aspect_ratio", "edge_length_asked_mm", "edge_length_surface_median_mm",
              "surface_distance_mean_mm", "surface_distance_max_mm"})
            row.push_back(number_cell(number_of(tissue, key)));
        table.rows.push_back(std::move(row));
    }
    return table;
}

HtmlTable promises_table(const RunJson& run, const MeshViews& views) {
    HtmlTable table{.caption = "Promises, by tissue",
                    .columns = {"tissue", "no inverted tetrahedron", "the boundary is a manifold",
                                "no tetrahedron has four boundary nodes",
                                "no inner edge joins two boundary nodes"},
                    .rows = {}};
    for (std::size_t t = 0; t < views.tissues.size(); ++t) {
        const RunJson& tissue = run.at("tissues")[t];
        const auto none = [&](const char* key) {
            return report::kept_cell(number_of(tissue, key) == 0);
        };
        table.rows.push_back({tissue_cell(tissue, views.tissues[t]), none("inverted_tets"),
                              report::kept_cell(tissue.at("boundary_manifold").get<bool>()),
                              none("tets_with_four_boundary_nodes"),
                              none("interior_edges_joining_boundary_nodes")});
    }
    return table;
}

std::string quality_html(const RunJson& run, const MeshViews& views) {
    std::string broken;
    for (const RunJson& tissue : run.at("tissues"))
        if (!is_good(tissue))
            broken += "<h3>" + report::escaped(label_of(tissue) + " " + text_of(tissue, "name")) +
                      ": not written</h3>\n" +
                      report::list_html(texts_of(tissue, "broken_promises"));
    return broken + report::to_html(promises_table(run, views)) +
           report::to_html(quality_table(run, views));
}

std::string shapes_html(const MeshViews& views) {
    const bool any = std::ranges::any_of(
        views.tissues, [](const TissueView& view) { return !view.mesh.tets.empty(); });
    if (!any) return "";
    const ShapeHistograms shapes = shape_histograms(views);
    return "<div class=\"charts\">\n" +
           report::histogram_figure(shapes.smallest, "Smallest dihedral angle of each tetrahedron",
                                    "degrees") +
           report::histogram_figure(shapes.largest, "Largest dihedral angle of each tetrahedron",
                                    "degrees") +
           report::histogram_figure(shapes.aspect, "Aspect ratio of each tetrahedron",
                                    "longest edge / shortest altitude") +
           "</div>\n" +
           report::paragraph(
               "A regular tetrahedron has 70.5 degrees and the ratio 1.22. What lies "
               "beyond an axis is counted at its end.");
}

// What the run says of gaps between tissues.
std::vector<std::string> gap_sentences(const RunJson& run) {
    const RunJson& gaps = run.at("gaps");
    if (gaps.is_null()) return {};
    std::vector<std::string> told;
    const auto tell = [&](const char* count, const char* volume, const std::string& what) {
        if (number_of(gaps, count) > 0)
            told.push_back(counted(gaps.at(count).get<std::int64_t>(), what) +
                           " without a label between tissues, " +
                           readable(number_of(gaps, volume)) + " mm\xC2\xB3 in all.");
    };
    tell("pockets", "pocket_volume_mm3", "pocket");
    tell("cavities", "cavity_volume_mm3", "cavity within a tissue, place");
    if (number_of(gaps, "closed_voxels") > 0)
        told.push_back(counted(gaps.at("closed_voxels").get<std::int64_t>(), "voxel") +
                       " of gaps were given to neighbours.");
    return told;
}

std::string repair_html(const RunJson& run) {
    if (run.at("repair").empty()) return "";
    HtmlTable table{
        .caption = "What each step of the repair did",
        .columns = {"step", "what", "tissue", "added, mm\xC2\xB3", "removed, mm\xC2\xB3", "note"},
        .rows = {}};
    for (const RunJson& step : run.at("repair"))
        table.rows.push_back(
            {number_cell(number_of(step, "step")), text_cell(text_of(step, "what")),
             text_cell(text_of(step, "tissue")), number_cell(number_of(step, "added_mm3")),
             number_cell(number_of(step, "removed_mm3")), text_cell(text_of(step, "note"))});
    return report::to_html(table);
}

std::string notes_html(const RunJson& run) {
    std::vector<std::string> notes = gap_sentences(run);
    for (const RunJson& tissue : run.at("tissues"))
        for (const std::string& note : texts_of(tissue, "notes"))
            notes.push_back(label_of(tissue) + " " + text_of(tissue, "name") + ": " + note);
    return report::list_html(notes) + repair_html(run);
}

std::string census_html(const RunJson& run, const MeshViews& views) {
    std::vector<std::string> lost;
    for (const RunJson& tissue : run.at("tissues")) {
        const auto in = tissue.at("components_in").get<int>(),
                   out = tissue.at("components_out").get<int>();
        if (out < in)
            lost.push_back(label_of(tissue) + " " + text_of(tissue, "name") + ": " +
                           counted(in, "piece") + " in the input, " + counted(out, "piece") +
                           " in the mesh; the notes below say why.");
    }
    return report::to_html(census_table(run, views)) +
           (lost.empty() ? report::paragraph("Each piece of each tissue is in its mesh.")
                         : report::list_html(lost));
}

// What the slices show, and what of the run they do not.
std::string slices_caption(const RunJson& run) {
    std::string text =
        "The scan's labels in pale colours, other labels grey, with the outlines of the meshes.";
    const bool mended = !run.at("repair").empty();
    const bool closed =
        run.at("gaps").is_object() && number_of(run.at("gaps"), "closed_voxels") > 0;
    if (mended || closed)
        text += std::string(" The labels are as the file has them: where ") +
                (mended ? "the recipe mended them" : "gaps were closed") +
                ", outlines and labels differ.";
    return text;
}

}  // namespace

report::Page mesh_page(const RunJson& run, const MeshViews& views) {
    const std::filesystem::path input = text_of(run, "input");
    report::Page page{
        .title = "Meshes of " + input.filename().string(),
        .lead = lead_of(run),
        .sections = {{"view", "3D view", report::viewer_html(mesh_scene(views))},
                     {"pictures", "Pictures", pictures_html(views)},
                     {"tissues", "Tissues", cards_html(run, views)},
                     {"census", "In and out", census_html(run, views)},
                     {"quality", "Quality", quality_html(run, views) + shapes_html(views)}}};
    const std::string slices = slices_html(views);
    page.sections.push_back(
        {"slices", "Slices",
         slices.empty()
             ? report::paragraph(views.no_scan.empty() ? "No mesh was written." : views.no_scan)
             : report::paragraph(slices_caption(run)) + slices});
    page.sections.push_back(notes_section(run, notes_html(run)));
    page.sections.push_back(run_section(run, {"input", "input_sha256", "output"}));
    return page;
}

}  // namespace myotet::app
