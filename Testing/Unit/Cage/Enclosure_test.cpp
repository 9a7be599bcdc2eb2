// SPDX-License-Identifier: Apache-2.0
#include "Cage/Enclosure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Cage/Cage.h"
#include "Cage/Parts.h"
#include "Core/Errors.h"
#include "Support/CageShapes.h"

namespace myotet::cage {
namespace {

using namespace myotet::testing;
using ::testing::HasSubstr;

// A block of six tetrahedra.
TetMesh box_mesh(const Vec3& low, const Vec3& high) {
    const TriMesh corners = block(low, high);
    TetMesh mesh{corners.points, {}, {}};
    for (const auto& [a, b] : {std::array{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}})
        mesh.tets.push_back({0, a, b, 7});
    return mesh;
}

Enclosure prove(const TetMesh& mesh, const TriMesh& surface) {
    return prove_enclosure(mesh, surface, SurfaceTree(surface));
}

TEST(Enclosure, ABlockInABlock) {
    const TetMesh cage = box_mesh(Vec3::Constant(-2), Vec3::Constant(2));
    EXPECT_TRUE(prove(cage, block(Vec3::Constant(-1), Vec3::Constant(1))).enclosed());
    const double nearly = 2 - 0x1p-51;
    EXPECT_TRUE(prove(cage, block(Vec3::Constant(-1), Vec3::Constant(nearly))).enclosed());
    const Enclosure touching = prove(cage, block(Vec3::Constant(-1), Vec3::Constant(2)));
    EXPECT_FALSE(touching.enclosed());
    EXPECT_EQ(touching.faces_that_meet, 6) << "two a side";
    EXPECT_EQ(touching.parts_outside, 0) << "its points are in closed tetrahedra";
}

TEST(Enclosure, APartOutsideIsFoundThoughNothingMeets) {
    const TriMesh two = together(block(Vec3::Constant(-1), Vec3::Constant(1)),
                                 block(Vec3::Constant(5), Vec3::Constant(6)));
    const Enclosure e = prove(box_mesh(Vec3::Constant(-2), Vec3::Constant(2)), two);
    EXPECT_EQ(e.faces_that_meet, 0);
    EXPECT_EQ(e.parts_outside, 1);
    EXPECT_FALSE(e.enclosed());
    EXPECT_THAT(e.where, HasSubstr("(5, 5, 5)"));
}

TEST(Enclosure, AroundIsNotInside) {
    // The surface encloses the mesh.
    const Enclosure e = prove(box_mesh(Vec3::Constant(-2), Vec3::Constant(2)),
                              block(Vec3::Constant(-3), Vec3::Constant(3)));
    EXPECT_EQ(e.parts_outside, 1);
}

TEST(Enclosure, AnInvertedTetrahedronAndACrossingBoundaryAreNamed) {
    const TriMesh inner = block(Vec3::Constant(-1), Vec3::Constant(1));
    TetMesh cage = box_mesh(Vec3::Constant(-2), Vec3::Constant(2));
    std::swap(cage.tets[3][0], cage.tets[3][1]);
    EXPECT_THAT(prove(cage, inner).where, HasSubstr("tetrahedron 3"));

    cage = box_mesh(Vec3::Constant(-2), Vec3::Constant(2));
    append(cage, box_mesh(Vec3(1.5, 1.5, 1.5), Vec3(4, 4, 4)));
    const Enclosure crossed = prove(cage, inner);
    EXPECT_FALSE(crossed.enclosed());
    EXPECT_GT(crossed.faces_that_cross, 0);
}

// The cage of a real try, moved until it touches its surface: it encloses up to there, and not
// a micron further.
TEST(Enclosure, ACageMovedByAMicronThroughTheSurfaceFails) {
    const TriMesh surface = banana();
    SilentProgress silent;
    const Cage cage = make_cage(surface, {.cell = 8, .offset_ratio = 0.2}, silent);
    ASSERT_TRUE(cage.enclosure.enclosed());
    constexpr double kMicron = 1e-3;
    const Vec3 way = Vec3(0.3, 0.5, 1).normalized();
    const auto at = [&](double far) {
        TetMesh mesh = cage.mesh;
        for (Vec3& p : mesh.points) p += far * way;
        return prove(mesh, surface);
    };
    ASSERT_FALSE(at(2 * 8).enclosed());
    // A move that just encloses and one that does not, a millionth of a micron apart.
    double in = 0, out = 2 * 8;
    while (out - in > 1e-6 * kMicron)
        (at(0.5 * (in + out)).enclosed() ? in : out) = 0.5 * (in + out);
    EXPECT_TRUE(at(in).enclosed());
    const Enclosure beyond = at(in + kMicron);
    EXPECT_FALSE(beyond.enclosed());
    EXPECT_GT(beyond.faces_that_meet, 0);
}

TEST(RequireClosed, SaysWhereASurfaceIsOpenOrMeetsItself) {
    TriMesh open = block(Vec3::Zero(), Vec3::Constant(2));
    EXPECT_NO_THROW(require_closed(open));
    open.triangles.erase(open.triangles.begin());
    try {
        require_closed(open);
        FAIL();
    } catch (const InputError& e) {
        EXPECT_THAT(e.what(), HasSubstr("open: 3 edges"));
        EXPECT_THAT(e.what(), HasSubstr("the first at (0, 1, 0) mm"));
    }
    const TriMesh crossed = together(block(Vec3::Zero(), Vec3::Constant(2)),
                                     block(Vec3::Constant(1.5), Vec3::Constant(3)));
    try {
        require_closed(crossed);
        FAIL();
    } catch (const InputError& e) {
        EXPECT_THAT(e.what(), HasSubstr("meets itself"));
        EXPECT_THAT(e.what(), HasSubstr("near ("));
    }
    EXPECT_NO_THROW(require_closed(crossed, Crossings::allowed));
    TriMesh turned = block(Vec3::Zero(), Vec3::Constant(2));
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    EXPECT_THROW(require_closed(turned), InputError);
    turned.points[0][1] = std::nan("");
    EXPECT_THROW(require_closed(turned), InputError);
    EXPECT_THROW(require_closed({}), InputError);
}

}  // namespace
}  // namespace myotet::cage
