// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "Core/TetMesh.h"

namespace myotet::quality {

/// The shape of one tetrahedron.
struct Shape {
    double min_dihedral_deg = 0;
    double max_dihedral_deg = 0;
    double aspect_ratio = 0;  ///< longest edge / shortest altitude; regular: sqrt(3/2)
    double volume = 0;        ///< signed, mm^3
};
[[nodiscard]] Shape measure(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The worst and the mean over a mesh.
struct ShapeSummary {
    double min_dihedral_deg = 0;
    double max_dihedral_deg = 0;
    double max_aspect_ratio = 0;
    double mean_aspect_ratio = 0;
    std::int64_t inverted_tets = 0;  ///< volume not positive
};
[[nodiscard]] ShapeSummary measure_shapes(const TetMesh& mesh);

/// What [Teran05, sec. 6] asks of a mesh's connections.
struct Topology {
    int components = 0;                      ///< connected by nodes
    bool boundary_manifold = false;          ///< no bad edge and no bad vertex
    std::int64_t non_manifold_edges = 0;     ///< boundary edges without exactly two faces
    std::int64_t non_manifold_vertices = 0;  ///< boundary nodes whose faces are not one fan
    std::int64_t tets_with_four_boundary_nodes = 0;
    std::int64_t interior_edges_joining_boundary_nodes = 0;
    std::int64_t euler_characteristic = 0;  ///< of the boundary surface, V - E + F
};
[[nodiscard]] Topology measure_topology(const std::vector<Tet>& tets, std::size_t point_count);

/// Edge lengths of the boundary surface, mm.
struct EdgeLengths {
    double min = 0, median = 0, max = 0;
};
[[nodiscard]] EdgeLengths boundary_edge_lengths(const TetMesh& mesh);

/// What a triangle surface is worth by itself.
struct SurfaceShape {
    double min_angle_deg = 0, max_angle_deg = 0;
    double area = 0;    ///< mm^2
    double volume = 0;  ///< that it encloses, mm^3; of an open surface without meaning
    EdgeLengths edges;
    int components = 0;                      ///< connected by points
    std::int64_t boundary_edges = 0;         ///< with one triangle; 0: the surface is closed
    std::int64_t boundary_loops = 0;         ///< connected parts of the boundary
    std::int64_t non_manifold_edges = 0;     ///< more than two triangles, or two that disagree
    std::int64_t non_manifold_vertices = 0;  ///< points whose triangles are not one fan
    std::int64_t euler_characteristic = 0;   ///< V - E + F, points of no triangle left out
};
[[nodiscard]] SurfaceShape measure_surface(const TriMesh& surface);

/// |distance(p)| over boundary nodes, edge midpoints and face centres, mm.
struct SurfaceDistance {
    double mean = 0, max = 0;
};
[[nodiscard]] SurfaceDistance surface_distance(const TetMesh& mesh,
                                               const std::function<double(const Vec3&)>& distance);

}  // namespace myotet::quality
