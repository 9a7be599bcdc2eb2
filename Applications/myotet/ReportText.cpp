// SPDX-License-Identifier: Apache-2.0
#include "ReportText.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "Core/Text.h"

namespace myotet::app {
namespace {

using Json = nlohmann::ordered_json;  // keys in the order in which they are read

Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json count_or_null(std::int64_t count) { return count > 0 ? Json(count) : Json(nullptr); }

Json smoothing_json(const std::optional<levelset::SmoothingReport>& s) {
    if (!s) return nullptr;
    return {{"moved_mean_mm", s->moved_mean},      {"moved_95_percent_mm", s->moved_95},
            {"moved_max_mm", s->moved_max},        {"volume_before_mm3", s->volume_before},
            {"volume_after_mm3", s->volume_after}, {"voxels_lost", s->voxels_lost},
            {"voxels_gained", s->voxels_gained}};
}

Json tissue_json(const TissueReport& t) {
    return {
        {"layer", t.layer},
        {"label", t.label},
        {"name", t.name},
        {"voxels", count_or_null(t.voxels)},
        {"components_in", t.components_in},
        {"components_out", t.components_out},
        {"volume_labels_mm3", t.volume_labels},
        {"volume_mesh_mm3", t.volume_mesh},
        {"smoothing", smoothing_json(t.smoothing)},
        {"vertices", t.vertices},
        {"tets", t.tets},
        {"min_dihedral_deg", number_or_null(t.shapes.min_dihedral_deg)},
        {"max_dihedral_deg", number_or_null(t.shapes.max_dihedral_deg)},
        {"max_aspect_ratio", number_or_null(t.shapes.max_aspect_ratio)},
        {"mean_aspect_ratio", number_or_null(t.shapes.mean_aspect_ratio)},
        {"edge_length_asked_mm", t.edge_length_asked},
        {"edge_length_surface_median_mm", t.surface_edges.median},
        {"boundary_manifold", t.topology.boundary_manifold},
        {"tets_with_four_boundary_nodes", t.topology.tets_with_four_boundary_nodes},
        {"interior_edges_joining_boundary_nodes", t.topology.interior_edges_joining_boundary_nodes},
        {"inverted_tets", t.shapes.inverted_tets},
        {"surface_distance_mean_mm", number_or_null(t.distance.mean)},
        {"surface_distance_max_mm", number_or_null(t.distance.max)},
        {"seconds", t.seconds},
        {"notes", t.notes},
        {"broken_promises", t.broken_promises},
        {"files", t.files}};
}

Json options_json(const RunFacts& report) {
    Json options = Json::object();
    for (const auto& [key, value] : report.options_text)
        options[key] = value.empty() ? Json(nullptr) : Json(value);
    for (const auto& [key, value] : report.options_number) options[key] = number_or_null(value);
    options["labels"] = report.labels;
    return options;
}

Json gaps_json(const std::optional<levelset::GapReport>& g) {
    if (!g) return nullptr;
    Json gained = Json::object();
    for (const auto& [label, voxels] : g->gained) gained[std::to_string(label)] = voxels;
    return {{"closed_width_mm", g->width},
            {"pockets", g->pockets},
            {"pocket_voxels", g->pocket_voxels},
            {"pocket_volume_mm3", g->pocket_volume},
            {"cavities", g->cavities},
            {"cavity_voxels", g->cavity_voxels},
            {"cavity_volume_mm3", g->cavity_volume},
            {"closed_voxels", g->narrow_voxels},
            {"closed_volume_mm3", g->narrow_volume},
            {"gained_voxels", gained}};
}

Json healing_json(const std::optional<levelset::HealSummary>& h) {
    if (!h) return nullptr;
    return {{"open_edges", h->open_edges},
            {"holes", h->holes},
            {"doubled_triangles", h->doubled_triangles},
            {"turned_triangles", h->turned_triangles},
            {"crossing_pairs", h->crossing_pairs},
            {"guessed_area_mm2", h->guessed_area},
            {"guessed_share", h->guessed_share},
            {"doubtful_share", h->doubtful_share}};
}

Json repair_json(const std::vector<repair::StepReport>& steps) {
    Json list = Json::array();
    for (const repair::StepReport& s : steps)
        list.push_back({{"step", s.number},
                        {"what", s.what},
                        {"tissue", s.tissue},
                        {"added_mm3", s.added},
                        {"removed_mm3", s.removed},
                        {"note", s.note}});
    return list;
}

Json run_json(const RunFacts& run) {
    return {{"program", "myotet"},
            {"version", MYOTET_VERSION},
            {"input", run.input},
            {"input_sha256", run.input_sha256},
            {"output", run.output},
            {"frame", "LPS"},
            {"units", "mm"},
            {"options", options_json(run)},
            {"gaps", gaps_json(run.gaps)},
            {"healing", healing_json(run.healing)},
            {"repair", repair_json(run.repair)},
            {"threads", run.threads},
            {"peak_memory_bytes", run.peak_memory},
            {"processor_seconds", run.processor_seconds},
            {"seconds", run.seconds},
            {"warnings", run.warnings}};
}

std::string written(const Json& json) {
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// "7", or "1:7" for a layer above 0.
std::string key_text(int layer, std::int32_t label) {
    return (layer > 0 ? std::to_string(layer) + ":" : "") + std::to_string(label);
}

std::string row(const char* label, const std::string& name, const TissueReport& t) {
    const double error =
        t.volume_labels > 0 ? 100 * (t.volume_mesh - t.volume_labels) / t.volume_labels : 0;
    return formatted("%6s  %-32.32s %9zu %7.1f %7.1f %7.2f %8.2f %7d/%d\n", label, name.c_str(),
                     t.tets, t.shapes.min_dihedral_deg, t.shapes.max_dihedral_deg,
                     t.shapes.max_aspect_ratio, error, t.components_out, t.components_in);
}

}  // namespace

std::string to_json(const RunReport& report) {
    Json run = run_json(report.run);
    run["tissues"] = Json::array();
    for (const TissueReport& tissue : report.tissues) run["tissues"].push_back(tissue_json(tissue));
    return written(run);
}

std::string to_json(const LevelSetReport& report) {
    Json run = run_json(report.run);
    run["tissues"] = Json::array();
    for (const LevelSetTissue& t : report.tissues)
        run["tissues"].push_back({{"layer", t.tissue.layer},
                                  {"label", t.tissue.label},
                                  {"name", t.tissue.name},
                                  {"voxels", count_or_null(t.tissue.voxels)},
                                  {"components", t.components},
                                  {"volume_labels_mm3", t.tissue.volume},
                                  {"volume_level_set_mm3", t.volume},
                                  {"inscribed_radius_mm", t.inscribed_radius},
                                  {"smoothing", smoothing_json(t.tissue.smoothing)},
                                  {"triangles", t.triangles},
                                  {"notes", t.notes},
                                  {"files", t.files}});
    return written(run);
}

std::string to_json(const Forecast& forecast) {
    const Json json = {{"edge_length_mm", forecast.edge_length},
                       {"tets", forecast.tets},
                       {"memory_bytes", forecast.bytes},
                       {"processor_seconds", forecast.seconds}};
    return json.dump(2) + "\n";
}

std::string to_table(const RunReport& report) {
    std::string table =
        "                                                        dihedral angle  aspect   volume   "
        "pieces\n"
        " label  name                                  tets     min     max   ratio  error %   "
        "out/in\n";
    TissueReport all;
    all.shapes.min_dihedral_deg = 180;
    for (const TissueReport& t : report.tissues) {
        table += row(key_text(t.layer, t.label).c_str(), t.name, t);
        for (const std::string& sentence : t.broken_promises)
            table += "        broken promise: " + sentence + "\n";
        all.tets += t.tets;
        all.volume_labels += t.volume_labels;
        all.volume_mesh += t.volume_mesh;
        all.components_in += t.components_in;
        all.components_out += t.components_out;
        if (t.tets == 0) continue;
        all.shapes.min_dihedral_deg =
            std::min(all.shapes.min_dihedral_deg, t.shapes.min_dihedral_deg);
        all.shapes.max_dihedral_deg =
            std::max(all.shapes.max_dihedral_deg, t.shapes.max_dihedral_deg);
        all.shapes.max_aspect_ratio =
            std::max(all.shapes.max_aspect_ratio, t.shapes.max_aspect_ratio);
    }
    if (report.tissues.size() > 1) table += row("all", "", all);
    return table;
}

std::string to_table(const LevelSetReport& report) {
    std::string table =
        "                                             volume  change    moved [mm]          "
        "voxels\n"
        " label  name                                   mm^3       %    mean    95 %     max  "
        "changed  pieces\n";
    for (const LevelSetTissue& t : report.tissues) {
        const auto s = t.tissue.smoothing.value_or(levelset::SmoothingReport{});
        const double change = t.tissue.volume > 0 ? 100 * (t.volume / t.tissue.volume - 1) : 0;
        table += formatted("%6s  %-32.32s %10.6g %7.2f %7.3f %7.3f %7.3f %8lld %7d\n",
                           key_text(t.tissue.layer, t.tissue.label).c_str(), t.tissue.name.c_str(),
                           t.volume, change, s.moved_mean, s.moved_95, s.moved_max,
                           static_cast<long long>(s.voxels_lost + s.voxels_gained), t.components);
    }
    return table;
}

}  // namespace myotet::app
