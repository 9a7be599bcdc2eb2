// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/NamedMesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "NamedMeshes.h"

namespace myotet::meshfiles {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> names_of(const std::vector<FaceSet>& sets) {
    std::vector<std::string> names;
    for (const FaceSet& set : sets) names.push_back(set.name);
    return names;
}

TEST(FacesByNeighbour, ExteriorsThenInterfacesWithTheirTags) {
    const NamedMesh mesh = three_tets();
    EXPECT_THAT(names_of(mesh.faces),
                ElementsAre("biceps|exterior", "M. triceps, caput <longum> & more|exterior",
                            "biceps|M. triceps, caput <longum> & more"));
    EXPECT_EQ(mesh.faces[0].tag, 1007);
    EXPECT_EQ(mesh.faces[1].tag, 1012);
    EXPECT_EQ(mesh.faces[2].tag, 1013);
    EXPECT_EQ(mesh.faces[0].triangles.size(), 2u);
    EXPECT_EQ(mesh.faces[1].triangles.size(), 6u);
    EXPECT_EQ(mesh.faces[2].triangles.size(), 2u);
}

/// Law: the exterior and interface faces of one label close its volume.
TEST(FacesByNeighbour, FacesOfALabelEncloseItsVolume) {
    constexpr double kRounding = 1e-12;  // a few dozen operations on numbers of order 100
    const NamedMesh mesh = three_tets();
    const auto volume_of = [&](std::initializer_list<int> sets) {
        TriMesh surface{mesh.mesh.points, {}};
        for (const int s : sets)
            surface.triangles.insert(surface.triangles.end(), mesh.faces[s].triangles.begin(),
                                     mesh.faces[s].triangles.end());
        return volume(surface);
    };
    const auto& p = mesh.mesh.points;
    EXPECT_NEAR(volume_of({0, 2}), signed_volume(p[0], p[2], p[1], p[4]), kRounding);
    EXPECT_NEAR(volume_of({0, 1}), volume(mesh.mesh), kRounding * 100);
}

TEST(FacesByNeighbour, LabelsBeyondTheTagsAreRefused) {
    TetMesh mesh = three_tets().mesh;
    mesh.labels[1] = std::numeric_limits<std::int32_t>::max() - 1000;
    EXPECT_THROW((void)faces_by_neighbour(mesh, {}), MeshError);
    mesh.labels[1] -= 1;  // one interface
    EXPECT_NO_THROW((void)faces_by_neighbour(mesh, {}));
}

TEST(NodesOfFaces, EachOnceAscending) {
    const NamedMesh mesh = three_tets();
    EXPECT_EQ(mesh.nodes[2].name, mesh.faces[2].name);
    EXPECT_THAT(mesh.nodes[2].nodes, ElementsAre(0, 1, 2, 4));
}

TEST(SidesOf, TetrahedraOnBothSides) {
    const NamedMesh mesh = three_tets();
    for (std::size_t s = 0; s < mesh.faces.size(); ++s) {
        const auto sides = sides_of(mesh)[s];
        for (const FaceSides& side : sides) {
            const std::int32_t inside = mesh.mesh.labels[side.inside / 4];
            EXPECT_EQ(inside, s == 1 ? 12 : 7);
            EXPECT_EQ(side.behind >= 0, s == 2);
        }
    }
}

TEST(SidesOf, TrianglesThatAreNoFacesAreRefused) {
    NamedMesh mesh = three_tets();
    mesh.faces[0].triangles[0] = {3, 4, 5};
    EXPECT_THROW((void)sides_of(mesh), MeshError);
}

TEST(Append, ShiftsNodesAndJoinsSetsOfOneName) {
    NamedMesh whole = three_tets();
    append(whole, three_tets());
    EXPECT_EQ(whole.mesh.points.size(), 12u);
    EXPECT_EQ(whole.faces.size(), 3u);
    EXPECT_EQ(whole.faces[2].triangles.size(), 4u);
    EXPECT_THAT(whole.nodes[2].nodes, ElementsAre(0, 1, 2, 4, 6, 7, 8, 10));
    EXPECT_NO_THROW((void)sides_of(whole));
}

TEST(PartNames, NoneEmptyNoneTwice) {
    NamedMesh mesh = three_tets();
    mesh.names = {{7, "m"}, {12, "m"}};
    EXPECT_EQ(part_names(mesh).at(12), "m_12");
    mesh.names.clear();
    EXPECT_EQ(part_names(mesh).at(7), "label_7");
}

}  // namespace
}  // namespace myotet::meshfiles
