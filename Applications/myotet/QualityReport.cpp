// SPDX-License-Identifier: Apache-2.0
#include "QualityReport.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "Core/Text.h"

namespace myotet::app {
namespace {

using Json = nlohmann::ordered_json;  // keys in the order in which they are read

std::vector<std::string> broken_promises(const quality::SurfaceShape& shape) {
    std::vector<std::string> broken;
    const auto promise_none = [&](std::int64_t count, const char* what) {
        if (count != 0) broken.push_back(std::to_string(count) + " " + what);
    };
    promise_none(shape.non_manifold_edges,
                 "edges with more than two triangles, or with two that are turned against each "
                 "other");
    promise_none(shape.non_manifold_vertices, "points where the surface touches itself");
    return broken;
}

FacesReport measure(const std::string& name, const TriMesh& surface) {
    FacesReport report{.name = name, .triangles = surface.triangles.size()};
    std::vector<char> used(surface.points.size(), 0);
    for (const Triangle& t : surface.triangles)
        for (const std::int32_t n : t) report.vertices += std::exchange(used[n], 1) == 0;
    report.shape = quality::measure_surface(surface);
    report.broken_promises = broken_promises(report.shape);
    return report;
}

Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json tissue_json(const TissueReport& t) {
    return {
        {"label", t.label},
        {"name", t.name},
        {"components", t.components_out},
        {"volume_mesh_mm3", t.volume_mesh},
        {"vertices", t.vertices},
        {"tets", t.tets},
        {"min_dihedral_deg", number_or_null(t.shapes.min_dihedral_deg)},
        {"max_dihedral_deg", number_or_null(t.shapes.max_dihedral_deg)},
        {"max_aspect_ratio", number_or_null(t.shapes.max_aspect_ratio)},
        {"mean_aspect_ratio", number_or_null(t.shapes.mean_aspect_ratio)},
        {"edge_length_surface_median_mm", t.surface_edges.median},
        {"boundary_manifold", t.topology.boundary_manifold},
        {"tets_with_four_boundary_nodes", t.topology.tets_with_four_boundary_nodes},
        {"interior_edges_joining_boundary_nodes", t.topology.interior_edges_joining_boundary_nodes},
        {"inverted_tets", t.shapes.inverted_tets},
        {"euler_characteristic", t.topology.euler_characteristic},
        {"broken_promises", t.broken_promises}};
}

Json faces_json(const FacesReport& f) {
    const quality::SurfaceShape& s = f.shape;
    Json json = {{"name", f.name},
                 {"components", s.components},
                 {"area_mm2", s.area},
                 {"vertices", f.vertices},
                 {"triangles", f.triangles},
                 {"min_angle_deg", number_or_null(s.min_angle_deg)},
                 {"max_angle_deg", number_or_null(s.max_angle_deg)},
                 {"edge_length_min_mm", s.edges.min},
                 {"edge_length_median_mm", s.edges.median},
                 {"edge_length_max_mm", s.edges.max},
                 {"closed", s.boundary_edges == 0},
                 {"boundary_edges", s.boundary_edges},
                 {"boundary_loops", s.boundary_loops},
                 {"manifold", s.non_manifold_edges + s.non_manifold_vertices == 0},
                 {"euler_characteristic", s.euler_characteristic},
                 {"broken_promises", f.broken_promises}};
    json["volume_mm3"] = s.boundary_edges == 0 ? Json(s.volume) : Json(nullptr);
    return json;
}

std::string promises_text(const std::vector<std::string>& broken) {
    std::string text;
    for (const std::string& sentence : broken) text += "        broken promise: " + sentence + "\n";
    return text;
}

std::string tissue_rows(const std::vector<TissueReport>& tissues) {
    std::string table =
        "                                                    dihedral angle   aspect ratio        "
        "edge      volume\n"
        " label  name                                  tets     min     max     max    mean      "
        "median         mm^3  pieces\n";
    for (const TissueReport& t : tissues) {
        table +=
            formatted("%6d  %-32.32s %9zu %7.2f %7.2f %7.3f %7.3f %11.4g %12.6g %7d\n", t.label,
                      t.name.c_str(), t.tets, t.shapes.min_dihedral_deg, t.shapes.max_dihedral_deg,
                      t.shapes.max_aspect_ratio, t.shapes.mean_aspect_ratio, t.surface_edges.median,
                      t.volume_mesh, t.components_out);
        table += promises_text(t.broken_promises);
    }
    return table;
}

std::string faces_row(const FacesReport& f) {
    const quality::SurfaceShape& s = f.shape;
    return formatted("%-32.32s %9zu %7.2f %7.2f %11.4g %12.6g %6lld %6lld %7d\n", f.name.c_str(),
                     f.triangles, s.min_angle_deg, s.max_angle_deg, s.edges.median, s.area,
                     static_cast<long long>(s.euler_characteristic),
                     static_cast<long long>(s.boundary_loops), s.components);
}

}  // namespace

QualityReport measure(const meshfiles::NamedMesh& mesh) {
    QualityReport report;
    if (!mesh.mesh.tets.empty()) {
        report.tissues = measure_tissues(mesh.mesh);
        for (TissueReport& tissue : report.tissues)
            if (const auto name = mesh.names.find(tissue.label); name != mesh.names.end())
                tissue.name = name->second;
        return report;
    }
    TriMesh surface{mesh.mesh.points, {}};
    for (const meshfiles::FaceSet& set : mesh.faces) {
        report.faces.push_back(measure(set.name, {mesh.mesh.points, set.triangles}));
        surface.triangles.insert(surface.triangles.end(), set.triangles.begin(),
                                 set.triangles.end());
    }
    report.whole = measure("all", surface);
    return report;
}

std::string to_json(const std::string& file, const QualityReport& report) {
    Json all = {{"mesh", file}, {"units", "mm"}};
    if (report.faces.empty()) {
        all["labels"] = Json::array();
        for (const TissueReport& t : report.tissues) all["labels"].push_back(tissue_json(t));
    } else {
        all["faces"] = Json::array();
        for (const FacesReport& f : report.faces) all["faces"].push_back(faces_json(f));
        all["whole"] = faces_json(report.whole);
    }
    return all.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_table(const QualityReport& report) {
    if (report.faces.empty()) return tissue_rows(report.tissues);
    std::string table =
        "                                                    angle        edge         area  Euler "
        " "
        "boundary\n"
        "name                             triangles     min     max      median         mm^2    "
        "ch. "
        " loops  pieces\n";
    for (const FacesReport& f : report.faces)
        table += faces_row(f) + promises_text(f.broken_promises);
    if (report.faces.size() > 1) table += faces_row(report.whole);
    return table;
}

}  // namespace myotet::app
