// SPDX-License-Identifier: Apache-2.0
#include "MeshReport.h"

#include <algorithm>
#include <map>

namespace myotet::app {

void measure(const TetMesh& mesh, TissueReport& report) {
    report.vertices = mesh.points.size();
    report.tets = mesh.tets.size();
    if (mesh.tets.empty()) {
        report.broken_promises.push_back(
            "the tissue has no mesh at this edge length; use a shorter --edge-length");
        return;
    }
    report.volume_mesh = volume(mesh);
    report.surface_edges = quality::boundary_edge_lengths(mesh);
    report.shapes = quality::measure_shapes(mesh);
    report.topology = quality::measure_topology(mesh.tets, mesh.points.size());
    report.components_out = report.topology.components;
    for (std::string& sentence : broken_promises(report.shapes, report.topology))
        report.broken_promises.push_back(std::move(sentence));
}

std::vector<std::string> broken_promises(const quality::ShapeSummary& shapes,
                                         const quality::Topology& topology) {
    std::vector<std::string> broken;
    const auto promise_none = [&](std::int64_t count, const char* what) {
        if (count != 0) broken.push_back(std::to_string(count) + " " + what);
    };
    promise_none(shapes.inverted_tets, "inverted tetrahedra");
    promise_none(topology.non_manifold_edges, "boundary edges without exactly two faces");
    promise_none(topology.non_manifold_vertices, "boundary nodes where the surface touches itself");
    promise_none(topology.tets_with_four_boundary_nodes, "tetrahedra with four boundary nodes");
    promise_none(topology.interior_edges_joining_boundary_nodes,
                 "interior edges joining two boundary nodes");
    return broken;
}

std::vector<TissueReport> measure_tissues(const TetMesh& mesh) {
    std::map<std::int32_t, TetMesh> parts;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        parts[mesh.labels.empty() ? 0 : mesh.labels[t]].tets.push_back(mesh.tets[t]);
    std::vector<TissueReport> reports;
    std::vector<std::int32_t> number(mesh.points.size());
    for (auto& [label, part] : parts) {
        std::ranges::fill(number, -1);
        for (Tet& tet : part.tets)
            for (std::int32_t& node : tet) {
                if (number[node] < 0) {
                    number[node] = static_cast<std::int32_t>(part.points.size());
                    part.points.push_back(mesh.points[node]);
                }
                node = number[node];
            }
        TissueReport report;
        report.label = label;
        measure(part, report);
        reports.push_back(std::move(report));
    }
    return reports;
}

}  // namespace myotet::app
