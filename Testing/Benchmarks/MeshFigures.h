// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>

#include "LevelSet/FromSurface.h"
#include "MeshFiles/MeshFiles.h"
#include "Meshing/MeshLevelSet.h"
#include "Quality/Quality.h"

namespace myotet::bench {

inline double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// What one mesh of a surface is worth, and what it took.
struct MeshFigures {
    std::string name;
    std::size_t tets = 0;
    quality::ShapeSummary shapes;
    quality::Topology topology;
    double mean_of_diagonal = 0;               ///< mean distance, of the surface's diagonal
    double mean_of_edge = 0, max_of_edge = 0;  ///< distances, of the median surface edge
    double level_set_seconds = 0;
    double seconds = 0;  ///< processor time, level set included, reading not
};

/// `edge` is a part of the surface's diagonal, `samples` of phi lie along an edge.
inline MeshFigures mesh_surface(const std::filesystem::path& file, double edge, double samples,
                                meshing::Options options) {
    SilentProgress quiet;
    const TriMesh surface = meshfiles::read_surface(file);
    Box box;
    for (const Vec3& p : surface.points) box.include(p);
    options.edge_length = edge * box.diagonal();
    MeshFigures f{.name = file.stem()};
    const double start = processor_seconds();
    const auto phi =
        levelset::from_surface(surface, {.spacing = options.edge_length / samples}, quiet);
    f.level_set_seconds = processor_seconds() - start;
    const TetMesh mesh = meshing::mesh_level_set(phi, options, quiet).mesh;
    f.seconds = processor_seconds() - start;
    f.tets = mesh.tets.size();
    f.shapes = quality::measure_shapes(mesh);
    f.topology = quality::measure_topology(mesh.tets, mesh.points.size());
    const auto distance =
        quality::surface_distance(mesh, [&](const Vec3& p) { return phi.value(p); });
    const double median = quality::boundary_edge_lengths(mesh).median;
    f.mean_of_diagonal = distance.mean / box.diagonal();
    f.mean_of_edge = distance.mean / median;
    f.max_of_edge = distance.max / median;
    return f;
}

inline void print(const MeshFigures& f) {
    std::printf(
        "%s: %zu tetrahedra, dihedral angles %.1f to %.1f, aspect ratio %.2f, mean %.2f, distance "
        "mean %.4f %% of the diagonal, %.2f %% of an edge, max %.1f %%, %.2f s, %.2f of them for "
        "the level set\n",
        f.name.c_str(), f.tets, f.shapes.min_dihedral_deg, f.shapes.max_dihedral_deg,
        f.shapes.max_aspect_ratio, f.shapes.mean_aspect_ratio, 100 * f.mean_of_diagonal,
        100 * f.mean_of_edge, 100 * f.max_of_edge, f.seconds, f.level_set_seconds);
    std::fflush(stdout);
}

}  // namespace myotet::bench
