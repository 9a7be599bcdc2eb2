// SPDX-License-Identifier: Apache-2.0
// Triangle surfaces of phantoms, whole and trimmed: from voxels to files.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

#include "LevelSetJob.h"
#include "MeshFiles/MeshFiles.h"
#include "Phantoms/Phantoms.h"
#include "Quality/Quality.h"
#include "Segmentation/ReadLabels.h"
#include "Support/TemporaryFolder.h"
#include "SurfaceJob.h"

using namespace myotet;
namespace fs = std::filesystem;

namespace {

constexpr double kPi = std::numbers::pi;

// What is asked of every surface, of which the report has a note where it fails.
constexpr double kSmallestAngle = 25, kLargestAngle = 120;  // degrees
constexpr double kBoundaryOff = 0.01;                       // of an edge, from both level sets
// Voxels know a smooth body's surface to a quarter of one in the mean, but both
// ways: its area to a part of that over the radius. Chords take less than that away.
constexpr double kArea = 0.015;
// A cut takes its share with the same error, and moves with the boundary's edges.
constexpr double kCutArea = 0.03;
// Sharp edges are not followed: at most a triangle's edge of 3 mm lies across one,
// where two sides of 3 / sqrt(2) mm should be.
constexpr double kBevel = (std::numbers::sqrt2 - 1) * 3;  // mm^2 for each mm of a box's edges
// Against the surface of the same level set at its samples: chords of 4 mm cut
// off what is bent on the scale of a voxel, of the thin tendon most (2.8 %).
constexpr double kSameArea = 0.04;
// Trims by a neighbour reach this far: where walls are shared the cut has no place.
constexpr double kBeyondTheWall = 1.5;  // mm; a voxel and a half

// The sphere and the torus have radii of 20 and 20 +- 8 mm, at 1 mm.
constexpr double kBall = 4 * kPi * 20 * 20, kTorus = 4 * kPi * kPi * 20 * 8;

class Surfaces : public ::testing::Test {
protected:
    [[nodiscard]] fs::path save(std::string_view phantom, double spacing) const {
        const fs::path file = folder_.path() / (std::string(phantom) + ".nrrd");
        segmentation::write_labels(phantoms::make_phantom(phantom, Vec3::Constant(spacing)).volume,
                                   file);
        return file;
    }
    /// The surfaces of a file's tissues, each held to what all are.
    std::vector<app::SurfaceTissue> make(app::SurfaceJobOptions options) const {
        SilentProgress quiet;
        options.output = out();
        options.format = "vtp";
        fs::remove_all(out());
        std::vector<app::SurfaceTissue> tissues = app::run_surface_job(options, quiet).tissues;
        for (const app::SurfaceTissue& t : tissues) {
            SCOPED_TRACE(t.tissue.name + " trimmed by '" + options.trim + "'");
            const surface::Quality& q = t.quality;
            EXPECT_TRUE(t.broken_promises.empty()) << t.broken_promises.front();
            EXPECT_GE(q.smallest_angle_deg, kSmallestAngle);
            EXPECT_LE(q.largest_angle_deg, kLargestAngle);
            EXPECT_LE(q.boundary_off_in_edges, kBoundaryOff);
            EXPECT_EQ(q.bad_edges + q.bad_points + q.triangles_turned_over + q.crossing_triangles,
                      0);
            EXPECT_EQ(q.inner_edges_joining_boundary_points, 0);
        }
        return tissues;
    }
    /// The same of a scan's only tissue, or the one of this name.
    app::SurfaceTissue make_one(const fs::path& input, double edge_length, const std::string& trim,
                                const std::string& label = {}, double trim_offset = 0) const {
        const auto tissues = make({.scan = {.input = input, .labels = label},
                                   .output = {},
                                   .level_sets = {},
                                   .edge_length = edge_length,
                                   .trim = trim,
                                   .trim_offset = trim_offset});
        EXPECT_EQ(tissues.size(), 1u);
        return tissues.front();
    }
    [[nodiscard]] TriMesh written(const app::SurfaceTissue& tissue) const {
        return meshfiles::read_surface(out() / tissue.files.front());
    }
    [[nodiscard]] fs::path out() const { return folder_.path() / "out"; }

    myotet::testing::TemporaryFolder folder_;
};

/// Points on edges that have one triangle, and the mean length of these edges.
struct Boundary {
    std::set<std::int32_t> points;
    double edge = 0;
};
Boundary boundary_of(const TriMesh& mesh) {
    std::set<std::pair<std::int32_t, std::int32_t>> ways;
    for (const Triangle& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) ways.insert({t[i], t[(i + 1) % 3]});
    Boundary boundary;
    double length = 0;
    int count = 0;
    for (const auto& [a, b] : ways) {
        if (ways.contains({b, a})) continue;
        boundary.points.insert({a, b});
        length += (mesh.points[a] - mesh.points[b]).norm();
        ++count;
    }
    boundary.edge = length / std::max(count, 1);
    return boundary;
}

Vec3 centroid_of(const TriMesh& mesh) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : mesh.points) sum += p;
    return sum / static_cast<double>(mesh.points.size());
}

struct Expected {
    std::int64_t euler;
    int loops, pieces;
};
void expect_topology(const app::SurfaceTissue& made, const TriMesh& file, const Expected& e) {
    EXPECT_EQ(made.quality.euler_characteristic, e.euler);
    EXPECT_EQ(made.quality.boundary_loops, e.loops);
    EXPECT_EQ(made.quality.pieces, e.pieces);
    // Counted once more, from the file, by others than who made it.
    const quality::SurfaceShape shape = quality::measure_surface(file);
    EXPECT_EQ(shape.euler_characteristic, e.euler);
    EXPECT_EQ(shape.boundary_loops, e.loops);
    EXPECT_EQ(shape.components, e.pieces);
    EXPECT_EQ(shape.non_manifold_edges + shape.non_manifold_vertices, 0);
    EXPECT_GE(shape.min_angle_deg, kSmallestAngle);
    EXPECT_LE(shape.max_angle_deg, kLargestAngle);
    EXPECT_NEAR(shape.area / made.quality.area, 1, 1e-6);
}

}  // namespace

TEST_F(Surfaces, SphereWholeAndHalf) {
    const fs::path ball = save("sphere", 1);
    const app::SurfaceTissue whole = make_one(ball, 3, "");
    expect_topology(whole, written(whole), {2, 0, 1});
    EXPECT_NEAR(whole.quality.area / kBall, 1, kArea);

    const app::SurfaceTissue half = make_one(ball, 3, "0,0,0,1,2,2");
    const TriMesh mesh = written(half);
    expect_topology(half, mesh, {1, 1, 1});
    EXPECT_NEAR(half.quality.area / (kBall / 2), 1, kCutArea);
    EXPECT_NEAR(half.quality.boundary_length / (2 * kPi * 20), 1, kArea);
    const Boundary boundary = boundary_of(mesh);
    for (const std::int32_t v : boundary.points)
        EXPECT_LE(std::abs(mesh.points[v].dot(Vec3(1, 2, 2) / 3)), kBoundaryOff * boundary.edge);
}

TEST_F(Surfaces, TorusCutAcrossAndAlong) {
    const fs::path torus = save("torus", 1);
    const app::SurfaceTissue whole = make_one(torus, 3, "");
    expect_topology(whole, written(whole), {0, 0, 1});
    EXPECT_NEAR(whole.quality.area / kTorus, 1, kArea);
    const app::SurfaceTissue tube = make_one(torus, 3, "0,0,0,1,0.2,0");
    expect_topology(tube, written(tube), {0, 2, 1});
    EXPECT_NEAR(tube.quality.area / (kTorus / 2), 1, kCutArea);
    const app::SurfaceTissue ring = make_one(torus, 3, "0,0,0,0,0,1");
    expect_topology(ring, written(ring), {0, 2, 1});
    EXPECT_NEAR(ring.quality.area / (kTorus / 2), 1, kCutArea);
}

TEST_F(Surfaces, TorusTrimmedByASurface) {
    const fs::path ball = folder_.path() / "ball.vtp";
    const app::SurfaceTissue sphere = make_one(save("sphere", 1), 3, "");
    fs::rename(out() / sphere.files.front(), ball);
    // The ball of 20 mm takes the inner half: what is left lies beyond it, and of
    // the torus about its axis that is a strip of known width.
    const app::SurfaceTissue left = make_one(save("torus", 1), 3, ball);
    const TriMesh mesh = written(left);
    expect_topology(left, mesh, {0, 2, 1});
    // |p| = 20 where the tube's angle a from outward has 400 + 320 cos a + 64 = 400.
    const double a = std::acos(-0.2);
    EXPECT_NEAR(left.quality.area / (4 * kPi * 8 * (20 * a + 8 * std::sin(a))), 1, kCutArea);
    // The ball is known as well as its mesh is: to the height of its chords.
    constexpr double kChord = 3.0 * 3.0 / (8 * 20) + 0.25;
    for (const std::int32_t v : boundary_of(mesh).points)
        EXPECT_NEAR(mesh.points[v].norm(), 20, kChord);
}

TEST_F(Surfaces, BlockWholeAndWithoutWhereItTouchesAnother) {
    const fs::path blocks = save("blocks", 1);
    const auto both = make(
        {.scan = {.input = blocks}, .output = {}, .level_sets = {}, .edge_length = 3, .trim = {}});
    ASSERT_EQ(both.size(), 2u);
    for (const app::SurfaceTissue& t : both) {
        expect_topology(t, written(t), {2, 0, 1});
    }
    // Boxes of 24 x 30 x 24 and 18 x 22 x 16 mm that share a wall of 22 x 16.
    const auto expect_area = [](const app::SurfaceTissue& t, double sides, double edges) {
        EXPECT_LT(t.quality.area, sides * (1 + kArea)) << t.tissue.name;
        EXPECT_GT(t.quality.area, sides * (1 - kArea) - kBevel * edges) << t.tissue.name;
    };
    expect_area(both[0], 4032, 4 * (24 + 30 + 24));
    expect_area(both[1], 2072, 4 * (18 + 22 + 16));
    const app::SurfaceTissue open =
        make_one(blocks, 3, "large_block", "small_block", kBeyondTheWall);
    expect_topology(open, written(open), {1, 1, 1});
    const double depth = 18 - kBeyondTheWall;
    expect_area(open, 22 * 16 + 2 * (22 + 16) * depth, 2 * (22 + 16) + 4 * depth);
}

TEST_F(Surfaces, ArmWholeAndTrimmed) {
    const fs::path arm = save("arm", 1.5);
    const std::string subset = "humerus,biceps,biceps_tendon_distal";
    const auto whole = make({.scan = {.input = arm, .labels = subset},
                             .output = {},
                             .level_sets = {},
                             .edge_length = 4,
                             .trim = {}});
    ASSERT_EQ(whole.size(), 3u);
    SilentProgress quiet;
    const app::LevelSetReport level_sets =
        app::run_level_set_job({.scan = {.input = arm, .labels = subset},
                                .output = folder_.path() / "sets",
                                .level_sets = {}},
                               quiet);
    const TriMesh biceps = written(whole[1]);
    for (std::size_t t = 0; t < whole.size(); ++t) {
        expect_topology(whole[t], written(whole[t]), {2, 0, 1});
        const TriMesh zero_set =
            meshfiles::read_surface(folder_.path() / "sets" / level_sets.tissues[t].files.back());
        EXPECT_NEAR(whole[t].quality.area / quality::measure_surface(zero_set).area, 1, kSameArea)
            << whole[t].tissue.name;
    }
    // Across the belly, and where the tendon leaves it.
    const Vec3 middle = centroid_of(biceps);
    std::ostringstream plane;
    plane << middle.x() << ',' << middle.y() << ',' << middle.z() << ",0,0,1";
    const app::SurfaceTissue half = make_one(arm, 4, plane.str(), "biceps");
    expect_topology(half, written(half), {1, 1, 1});
    EXPECT_LT(half.quality.area, 0.8 * whole[1].quality.area);
    const app::SurfaceTissue tendon =
        make_one(arm, 4, "biceps", "biceps_tendon_distal", kBeyondTheWall);
    expect_topology(tendon, written(tendon), {1, 1, 1});
    EXPECT_LT(tendon.quality.area, whole[2].quality.area);
}
