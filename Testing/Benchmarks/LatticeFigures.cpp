// SPDX-License-Identifier: Apache-2.0
// Shapes of the elements on uniform lattices, in drafts and where the surface is graded,
// against what other meshers reach on the same surfaces.
#include <gtest/gtest.h>

#include <cstdio>
#include <ctime>
#include <filesystem>

#include "LevelSet/FromSurface.h"
#include "MeshFiles/MeshFiles.h"
#include "Meshing/MeshLevelSet.h"
#include "Quality/Quality.h"

using namespace myotet;
namespace fs = std::filesystem;

namespace {

const fs::path kData = fs::path(MYOTET_SHARED_DIR) / "data";
const fs::path kBunny = kData / "bench_surfaces/bunny.off",
               kDragon = kData / "bench_surfaces/dragon.off",
               kSphere = kData / "bench_surfaces/sphere.off",
               kArmadillo = kData / "surfaces_classic/odedstein/armadillo/armadillo.obj";

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Figures {
    std::size_t tets = 0;
    quality::ShapeSummary shapes;
    double mean_distance = 0;  // of the surface's diagonal
    double seconds = 0;        // level set included, reading not
};

// `edge` is a part of the surface's diagonal, `samples` of phi lie along an edge.
Figures make(const fs::path& file, double edge, double samples, meshing::Options options) {
    SilentProgress quiet;
    const TriMesh surface = meshfiles::read_surface(file);
    Box box;
    for (const Vec3& p : surface.points) box.include(p);
    options.edge_length = edge * box.diagonal();
    const double start = processor_seconds();
    const auto phi =
        levelset::from_surface(surface, {.spacing = options.edge_length / samples}, quiet);
    const TetMesh mesh = meshing::mesh_level_set(phi, options, quiet).mesh;
    Figures f{.tets = mesh.tets.size(), .shapes = quality::measure_shapes(mesh)};
    f.seconds = processor_seconds() - start;
    const auto distance =
        quality::surface_distance(mesh, [&](const Vec3& p) { return phi.value(p); });
    f.mean_distance = distance.mean / box.diagonal();
    const double median = quality::boundary_edge_lengths(mesh).median;
    std::printf(
        "%s: %zu tetrahedra, dihedral angles %.1f to %.1f, aspect ratio %.2f, mean %.2f, distance "
        "mean %.4f %% of the diagonal, %.2f %% of an edge, max %.1f %%, %.2f s\n",
        file.filename().c_str(), f.tets, f.shapes.min_dihedral_deg, f.shapes.max_dihedral_deg,
        f.shapes.max_aspect_ratio, f.shapes.mean_aspect_ratio, 100 * f.mean_distance,
        100 * distance.mean / median, 100 * distance.max / median, f.seconds);
    const quality::Topology t = quality::measure_topology(mesh.tets, mesh.points.size());
    EXPECT_TRUE(t.boundary_manifold);
    EXPECT_EQ(t.tets_with_four_boundary_nodes, 0);
    EXPECT_EQ(t.interior_edges_joining_boundary_nodes, 0);
    EXPECT_EQ(f.shapes.inverted_tets, 0);
    return f;
}

// Uniform, at about 100 000 and 20 000 tetrahedra.
void expect_uniform(const fs::path& file, double fine, double coarse) {
    if (!fs::exists(file)) GTEST_SKIP() << file << " is not here";
    for (const double edge : {fine, coarse}) {
        const Figures f = make(file, edge, 4, {.uniform = true});
        EXPECT_NEAR(static_cast<double>(f.tets), edge == fine ? 1e5 : 2e4,
                    edge == fine ? 1e4 : 2e3);
        EXPECT_GE(f.shapes.min_dihedral_deg, 26);
        EXPECT_LE(f.shapes.max_dihedral_deg, 122);
        EXPECT_LE(f.shapes.max_aspect_ratio, 3.6);
        // Half of what an optimising mesher of the same kind takes: 9300 a second.
        EXPECT_GE(static_cast<double>(f.tets) / f.seconds, edge == fine ? 18600 : 0);
    }
}

}  // namespace

TEST(LatticeFigures, UniformBunny) { expect_uniform(kBunny, 0.0152, 0.0262); }
TEST(LatticeFigures, UniformDragon) { expect_uniform(kDragon, 0.0120, 0.0210); }
TEST(LatticeFigures, UniformArmadillo) { expect_uniform(kArmadillo, 0.0114, 0.0198); }
TEST(LatticeFigures, UniformSphere) { expect_uniform(kSphere, 0.0192, 0.0332); }

TEST(LatticeFigures, DraftOfTheBunny) {
    if (!fs::exists(kBunny)) GTEST_SKIP() << kBunny << " is not here";
    const Figures f = make(kBunny, 0.0152, 3, {.uniform = true, .draft = true});
    EXPECT_GE(f.tets, 97000u);
    EXPECT_GE(f.shapes.min_dihedral_deg, 14.6);
    EXPECT_LE(f.seconds, 1.7);
}

TEST(LatticeFigures, GradedBunny) {
    if (!fs::exists(kBunny)) GTEST_SKIP() << kBunny << " is not here";
    const Figures f = make(kBunny, 0.0145, 4, {.thickness_factor = 0.8});
    EXPECT_LT(f.tets, 151000u);
    EXPECT_LE(f.mean_distance, 0.018e-2);
    EXPECT_LT(f.shapes.mean_aspect_ratio, 2.2);
}
