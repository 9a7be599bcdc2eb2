// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "Core/Text.h"
#include "ReportText.h"
#include "SurfaceJob.h"

namespace myotet::app {
namespace {

using Json = nlohmann::ordered_json;

const char* word_for(surface::Cut cut) {
    return cut == surface::Cut::none   ? "nothing"
           : cut == surface::Cut::some ? "some"
                                       : "everything";
}

Json quality_json(const surface::Quality& q) {
    return {{"vertices", q.points},
            {"triangles", q.triangles},
            {"area_mm2", q.area},
            {"smallest_angle_deg", q.smallest_angle_deg},
            {"largest_angle_deg", q.largest_angle_deg},
            {"edge_length_min_mm", q.shortest_edge},
            {"edge_length_median_mm", q.median_edge},
            {"edge_length_max_mm", q.longest_edge},
            {"components_out", q.pieces},
            {"euler_characteristic", q.euler_characteristic},
            {"boundary_loops", q.boundary_loops},
            {"boundary_length_mm", q.boundary_length},
            {"boundary_vertices", q.boundary_points},
            {"boundary_off_in_edges", q.boundary_off_in_edges},
            {"crossing_triangle_pairs", q.crossing_triangles},
            {"triangles_turned_over", q.triangles_turned_over},
            {"manifold", q.bad_edges + q.bad_points == 0},
            {"interior_edges_joining_boundary_nodes", q.inner_edges_joining_boundary_points},
            {"vertex_distance_max_mm", q.points_off},
            {"surface_distance_mean_mm", q.mean_distance},
            {"surface_distance_max_mm", q.max_distance}};
}

Json tissue_json(const SurfaceTissue& t) {
    Json json = {{"layer", t.tissue.layer},
                 {"label", t.tissue.label},
                 {"name", t.tissue.name},
                 {"components_in", t.components},
                 {"discarded", word_for(t.cut)}};
    json.update(quality_json(t.quality));
    json["softened_places"] = t.softened_places;
    json["softened_by_mm"] = t.softened_by;
    json["notes"] = t.notes;
    json["broken_promises"] = t.broken_promises;
    json["files"] = t.files;
    return json;
}

}  // namespace

std::string to_json(const SurfaceReport& report) {
    // The run's part is the same as that of level sets.
    Json json = Json::parse(to_json(LevelSetReport{.run = report.run}));
    json["tissues"] = Json::array();
    for (const SurfaceTissue& tissue : report.tissues)
        json["tissues"].push_back(tissue_json(tissue));
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_table(const SurfaceReport& report) {
    std::string table =
        "                                                     angle          edge   Euler  "
        "boundary\n"
        " label  name                             triangles     min     max  median     ch.  "
        "loops        mm\n";
    for (const SurfaceTissue& t : report.tissues) {
        const surface::Quality& q = t.quality;
        table +=
            formatted("%6d  %-32.32s %9zu %7.1f %7.1f %7.3g %7lld %6d %9.4g\n", t.tissue.label,
                      t.tissue.name.c_str(), q.triangles, q.smallest_angle_deg, q.largest_angle_deg,
                      q.median_edge, static_cast<long long>(q.euler_characteristic),
                      q.boundary_loops, q.boundary_length);
        for (const std::string& sentence : t.broken_promises)
            table += "        broken promise: " + sentence + "\n";
    }
    return table;
}

}  // namespace myotet::app
