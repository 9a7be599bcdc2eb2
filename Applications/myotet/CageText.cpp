// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "CageJob.h"
#include "Core/Text.h"
#include "ReportText.h"

namespace myotet::app {
namespace {

using Json = nlohmann::ordered_json;

Json try_json(const cage::Try& t) {
    return {{"number", t.number},
            {"tetrahedra", t.tets},
            {"bombs_found", t.bombs.bombs},
            {"pinched_places", t.bombs.pinched},
            {"bomb_groups", t.bombs.groups},
            {"bomb_groups_not_searched_through", t.bombs.greedy},
            {"tetrahedra_added", t.bombs.added_tets},
            {"nodes_split", t.split_nodes},
            {"adjustment_steps", t.adjust_steps},
            {"nodes_moved_elsewhere", t.jumps},
            {"nodes_taken_out", t.collapsed},
            {"edges_bisected", t.refined},
            {"relaxation_rounds", t.relax_rounds},
            {"offset_reached", t.reached},
            {"enclosed", t.enclosed},
            {"score_deg", t.score_deg}};
}

Json tissue_json(const CageTissue& t) {
    const cage::Cage& c = t.cage;
    const cage::Measures& m = c.measures;
    const cage::Try& best = c.tries[static_cast<std::size_t>(c.best)];
    Json json = {{"layer", t.tissue.layer},
                 {"label", t.tissue.label},
                 {"name", t.tissue.name},
                 {"surface_points", t.surface_points},
                 {"surface_triangles", t.surface_triangles},
                 {"surface_area_mm2", t.surface_area},
                 {"surface_volume_mm3", t.surface_volume},
                 {"cell_mm", c.cell},
                 {"offset_mm", c.offset},
                 {"offset_reached", best.reached},
                 {"enclosed", c.enclosure.enclosed()},
                 {"tetrahedra", m.tets},
                 {"nodes", m.nodes},
                 {"boundary_faces", m.boundary_faces},
                 {"min_dihedral_deg", m.min_dihedral_deg},
                 {"max_dihedral_deg", m.max_dihedral_deg},
                 {"aspect_ratio_max", m.max_aspect_ratio},
                 {"aspect_ratio_mean", m.mean_aspect_ratio},
                 {"boundary_distance_min_mm", m.distance_min},
                 {"boundary_distance_max_mm", m.distance_max},
                 {"boundary_distance_mean_mm", m.distance_mean},
                 {"volume_ratio", m.volume_ratio},
                 {"euler_characteristic", m.euler_characteristic},
                 {"boundary_manifold", m.boundary_manifold},
                 {"components", m.components},
                 {"bombs_found", best.bombs.bombs},
                 {"bombs_defused", best.bombs.bombs},
                 {"tries_asked", c.tries_asked},
                 {"best_try", best.number}};
    json["tries"] = Json::array();
    for (const cage::Try& one : c.tries) json["tries"].push_back(try_json(one));
    json["notes"] = t.notes;
    json["broken_promises"] = t.broken_promises;
    json["files"] = t.files;
    return json;
}

}  // namespace

std::string to_json(const CageReport& report) {
    // The run's part is the same as that of level sets.
    Json json = Json::parse(to_json(LevelSetReport{.run = report.run}));
    json["tissues"] = Json::array();
    for (const CageTissue& tissue : report.tissues) json["tissues"].push_back(tissue_json(tissue));
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_table(const CageReport& report) {
    std::string table =
        "                                              dihedral  aspect   distance [mm]  volume\n"
        " label  name                     tetrahedra   min   max   ratio    mean     max   ratio  "
        "enclosed  tries\n";
    for (const CageTissue& t : report.tissues) {
        const cage::Measures& m = t.cage.measures;
        table += formatted("%6d  %-24.24s %10lld %5.1f %5.1f %7.2f %7.3g %7.3g %7.3f  %-8s %6zu\n",
                           t.tissue.label, t.tissue.name.c_str(), static_cast<long long>(m.tets),
                           m.min_dihedral_deg, m.max_dihedral_deg, m.max_aspect_ratio,
                           m.distance_mean, m.distance_max, m.volume_ratio,
                           t.cage.enclosure.enclosed() ? "yes" : "no", t.cage.tries.size());
        for (const std::string& sentence : t.notes) table += "        " + sentence + "\n";
        for (const std::string& sentence : t.broken_promises)
            table += "        broken promise: " + sentence + "\n";
    }
    return table;
}

}  // namespace myotet::app
