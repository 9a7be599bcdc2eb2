// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "Costs.h"
#include "HistoryText.h"
#include "PressJob.h"
#include "Text.h"

namespace myotet::app {
namespace {

using Json = nlohmann::ordered_json;

Json organ_json(const PressReport& report) {
    Json levels = Json::array();
    for (std::size_t l = 0; l < report.nodes_of_level.size(); ++l)
        levels.push_back(
            {{"nodes", report.nodes_of_level[l]}, {"springs", report.springs_of_level[l]}});
    Json json = {{"label", report.label},
                 {"name", report.name},
                 {"edge_length_mm", report.edge_length > 0 ? Json(report.edge_length) : Json()},
                 {"area_mm2", report.area},
                 {"held_points", report.held},
                 {"levels", levels},
                 {"lumen", nullptr}};
    if (report.lumen)
        json["lumen"] = {{"volume_mm3", report.lumen->volume},
                         {"wall_volume_mm3", report.lumen->wall_volume},
                         {"wall_thickness_mm", report.lumen->thickness}};
    return json;
}

Json wall_json(const PressReport& report) {
    constexpr double kTonnePerCubicMm = 1e-12;  // in a kg/m^3
    const membrane::Wall& wall = report.wall;
    return {{"material", report.material},
            {"thickness_mm", wall.thickness},
            {"thickness_measured", report.thickness_measured},
            {"young_MPa", wall.young},
            {"density_kg_m3", wall.density / kTonnePerCubicMm},
            {"damping_time_s", wall.damping_time},
            {"shape_stiffness_MPa_per_mm", wall.shape_stiffness},
            {"shape_damping_time_s", wall.shape_damping_time},
            {"drag_per_s", wall.drag},
            {"contact_stiffness_MPa_per_mm", wall.contact_stiffness}};
}

}  // namespace

std::string to_json(const PressReport& report) {
    Json json = {
        {"input", report.input},
        {"input_sha256", report.input_sha256},
        {"tool", report.tool},
        {"tool_sha256", report.tool_sha256},
        {"title", report.title},
        {"output", report.output},
        {"frame", "LPS"},
        {"units", "mm, N, MPa, s, t"},
        {"version", MYOTET_VERSION},
        {"threads", report.threads},
        {"options", {{"levels", report.levels}, {"adapt", report.adapt}, {"shape", report.shape}}},
        {"organ", organ_json(report)},
        {"wall", wall_json(report)},
        {"completed", report.status == membrane::Status::finished},
        {"message", report.message},
        {"reached_s", report.reached},
        {"end_s", report.end},
        {"frames", report.frames},
        {"steps", report.steps},
        {"rejected_steps", report.rejected},
        {"force_evaluations", report.evaluations},
        {"level_switches", report.switches},
        {"switched_energy_N_mm", report.switched_energy}};
    json["history"] = history_json(report.history);
    add_costs(json, report);
    json["notes"] = report.notes;
    json["files"] = report.files;
    return json.dump(2) + "\n";
}

std::string to_table(const PressReport& report) {
    std::string text;
    if (!report.title.empty()) text += report.title + "\n";
    text += formatted("  %s: %zu nodes, %zu refined all over; wall %.3g mm%s, %.3g MPa\n",
                      report.name.c_str(), report.nodes_of_level.front(),
                      report.nodes_of_level.back(), report.wall.thickness,
                      report.thickness_measured ? " (measured)" : "", report.wall.young);
    if (report.lumen)
        text += formatted("  lumen of %.4g mm^3 in a wall of %.4g mm^3\n", report.lumen->volume,
                          report.lumen->wall_volume);
    text += history_table(report.history);
    text += formatted("  %lld steps, %lld changes of level, %.2f s for %.4g s\n",
                      static_cast<long long>(report.steps), static_cast<long long>(report.switches),
                      report.seconds.at("press"), report.reached);
    return text;
}

}  // namespace myotet::app
