// SPDX-License-Identifier: Apache-2.0
#include "Meshing/Physics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Meshing/MeshLevelSet.h"
#include "Meshing/Refine.h"
#include "Meshing/Select.h"
#include "Quality/Quality.h"
#include "Support/AnalyticLevelSet.h"

namespace myotet::meshing {
namespace {

const levelset::LevelSet kTorus = support::sample_level_set(
    support::cube(16), 0.5,
    [](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 8, p.z()) - 4; });

TetMesh candidate(const levelset::LevelSet& phi, double edge) {
    SilentProgress quiet;
    const Options options{.edge_length = edge};
    auto lattice = build_lattice(phi, options, plan_levels(options), quiet);
    return select_candidate(lattice, {}, quiet).mesh;
}

double worst_distance(const TetMesh& mesh, const levelset::LevelSet& phi) {
    double worst = 0;
    for (const Triangle& f : boundary_faces(mesh.tets))
        for (const std::int32_t n : f) worst = std::max(worst, std::abs(phi.value(mesh.points[n])));
    return worst;
}

class ByMaterial : public ::testing::TestWithParam<Material> {};

TEST_P(ByMaterial, BringsTheBoundaryOntoTheSurfaceAndKeepsShapes) {
    SilentProgress quiet;
    TetMesh mesh = candidate(kTorus, 2);
    const auto tets = mesh.tets;
    const double before = worst_distance(mesh, kTorus);
    const PhysicsSummary summary =
        compress_by_physics(mesh, kTorus, {.material = GetParam()}, quiet);
    EXPECT_EQ(mesh.tets, tets) << "only positions change";
    EXPECT_GT(summary.force_steps, 0);
    EXPECT_LT(summary.mean_distance, 0.02);
    EXPECT_LT(worst_distance(mesh, kTorus), 0.25 * before);
    const quality::ShapeSummary shapes = quality::measure_shapes(mesh);
    EXPECT_EQ(shapes.inverted_tets, 0);
    // The paper's own results by physics: 13 to 17 and 147 to 156 degrees.
    EXPECT_GT(shapes.min_dihedral_deg, 17);
    EXPECT_LT(shapes.max_dihedral_deg, 147);
    EXPECT_LT(shapes.max_aspect_ratio, 6.5);
}

// A surface so deep inside the candidate that its elements cannot all go there.
TEST_P(ByMaterial, CrushesNoElement) {
    SilentProgress quiet;
    TetMesh mesh = candidate(kTorus, 2);
    const TetMesh rest = mesh;
    (void)compress_by_physics(mesh, kTorus, {.material = GetParam(), .isovalue = -3.2}, quiet);
    EXPECT_LT(volume(mesh), 0.5 * volume(rest));
    double least = 1;
    for (const Tet& t : rest.tets) {
        const auto volume_in = [&](const TetMesh& m) {
            return signed_volume(m.points[t[0]], m.points[t[1]], m.points[t[2]], m.points[t[3]]);
        };
        least = std::min(least, volume_in(mesh) / volume_in(rest));
    }
    EXPECT_GE(least, 0.15);  // as Physics.cpp says
}

TEST_P(ByMaterial, SameBytesOnOneThreadOrMany) {
    const auto points = [](int threads) {
        const ThreadLimit limit(threads);
        SilentProgress quiet;
        TetMesh mesh = candidate(kTorus, 3);
        compress_by_physics(mesh, kTorus,
                            {.material = GetParam(), .force_steps = 8, .velocity_steps = 4}, quiet);
        return mesh.points;
    };
    EXPECT_EQ(points(1), points(3));
}

INSTANTIATE_TEST_SUITE_P(Physics, ByMaterial,
                         ::testing::Values(Material::springs, Material::elements));

TEST(Physics, SaysThatTheSurfaceFitsAndStopsThere) {
    SilentProgress quiet;
    TetMesh mesh = candidate(kTorus, 3);
    const PhysicsSummary summary = compress_by_physics(mesh, kTorus, {.tolerance = 10}, quiet);
    EXPECT_EQ(summary.status, "surface fits");
    EXPECT_EQ(summary.force_steps + summary.velocity_steps, 0);
}

TEST(Physics, SaysThatItRanOutOfSteps) {
    SilentProgress quiet;
    TetMesh mesh = candidate(kTorus, 3);
    const PhysicsSummary summary =
        compress_by_physics(mesh, kTorus, {.force_steps = 2, .velocity_steps = 2}, quiet);
    EXPECT_EQ(summary.status, "out of steps");
    EXPECT_EQ(summary.velocity_steps, 2);
}

TEST(MeshLevelSet, PhysicsThenOptimisationIsNoWorseThanPhysics) {
    SilentProgress quiet;
    Options options{.edge_length = 2.5, .compression = {Compression::fem}};
    const auto worst = [&] {
        return quality::measure_shapes(mesh_level_set(kTorus, options, quiet).mesh)
            .max_aspect_ratio;
    };
    const double physics = worst();
    options.compression = {Compression::fem, Compression::optimization};
    EXPECT_LT(worst(), physics);
    options.compression = {Compression::optimization, Compression::fem};
    EXPECT_THROW((void)mesh_level_set(kTorus, options, quiet), InputError);
    options.compression = {};
    EXPECT_THROW((void)mesh_level_set(kTorus, options, quiet), InputError);
}

}  // namespace
}  // namespace myotet::meshing
