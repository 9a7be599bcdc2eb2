// SPDX-License-Identifier: Apache-2.0
// quality, through the built program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "MeshFiles/MeshFiles.h"
#include "Support/RunProgram.h"

namespace myotet {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;
using Json = nlohmann::json;
using testing::run_program;
using testing::TemporaryFolder;

// .bdf holds ten digits of a coordinate, .stl 24 bits; of lengths near 1 mm.
constexpr double kCoordinates = 1e-6;

/// One tetrahedron each, which breaks one promise: all its nodes lie outside.
meshfiles::NamedMesh two_tissues() {
    return meshfiles::with_named_boundary({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}},
                                           {{0, 1, 2, 3}, {0, 2, 1, 4}},
                                           {3, 9}},
                                          {{3, "biceps"}, {9, "humerus"}});
}

Json measured(const std::string& file, int code) {
    const testing::Ran ran = run_program(MYOTET_PROGRAM, {"quality", file, "--json"});
    EXPECT_EQ(ran.code, code) << file << ran.err;
    return Json::parse(ran.out, nullptr, false);
}

TEST(Quality, SameOfEveryMeshFormatByTissue) {
    const TemporaryFolder folder;
    for (const meshfiles::Format& format : meshfiles::formats()) {
        if (format.holds != meshfiles::Holds::tetrahedra) continue;
        const std::string file = folder / ("a" + std::string(format.extension));
        write_mesh(two_tissues(), file);
        const Json json = measured(file, 4);
        ASSERT_THAT(json["labels"], SizeIs(2)) << file;
        EXPECT_EQ(json["labels"][0]["label"], 3);
        EXPECT_EQ(json["labels"][0]["name"], "biceps");
        EXPECT_EQ(json["labels"][1]["name"], "humerus");
        EXPECT_EQ(json["labels"][1]["tets"], 1);
        EXPECT_NEAR(json["labels"][1]["volume_mesh_mm3"].get<double>(), 1.0 / 6, kCoordinates);
        EXPECT_NEAR(json["labels"][0]["max_dihedral_deg"].get<double>(), 90, 1e-3);
        EXPECT_EQ(json["labels"][0]["euler_characteristic"], 2);
        EXPECT_THAT(json["labels"][0]["broken_promises"], SizeIs(1));
    }
}

TEST(Quality, SurfacesOfEveryFormatByFaceSet) {
    const TemporaryFolder folder;
    for (const meshfiles::Format& format : meshfiles::formats()) {
        if (format.holds != meshfiles::Holds::surface) continue;
        const std::string file = folder / ("a" + std::string(format.extension));
        meshfiles::NamedMesh mesh = two_tissues();
        write_mesh(mesh, file);
        // .ply and .obj keep sets: two exteriors and the interface between them.
        const bool sets = format.extension == ".ply" || format.extension == ".obj";
        const Json json = measured(file, 0);
        ASSERT_THAT(json["faces"], SizeIs(sets ? 3 : 1)) << file;
        EXPECT_EQ(json["faces"][0]["triangles"], sets ? 3 : 6);
        EXPECT_EQ(json["faces"][0]["closed"], !sets);
        EXPECT_EQ(json["faces"][0]["euler_characteristic"], sets ? 1 : 2);
        EXPECT_EQ(json["whole"]["triangles"], sets ? 7 : 6);
        EXPECT_EQ(json["whole"]["manifold"], !sets);
        EXPECT_NEAR(json["faces"][0]["max_angle_deg"].get<double>(), 90, 1e-3);
    }
}

TEST(Quality, ABrokenSurfaceIsABrokenPromise) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "fin.off",
                         "OFF\n5 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 -1\n"
                         "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n3 0 1 4\n");
    const testing::Ran ran = run_program(MYOTET_PROGRAM, {"quality", folder / "fin.off"});
    EXPECT_EQ(ran.code, 4);
    EXPECT_THAT(ran.out, HasSubstr("broken promise: 1 edges with more than two triangles"));
    EXPECT_THAT(ran.err, HasSubstr("fin: 1 edges"));
}

TEST(Quality, TableNamesTissues) {
    const TemporaryFolder folder;
    write_mesh(two_tissues(), folder / "a.msh");
    const testing::Ran ran = run_program(MYOTET_PROGRAM, {"quality", folder / "a.msh"});
    EXPECT_EQ(ran.code, 4);
    EXPECT_THAT(ran.out, HasSubstr("     9  humerus"));
    EXPECT_THAT(ran.err, HasSubstr("label 9: 1 tetrahedra with four boundary nodes"));
}

TEST(Quality, WhatIsNoMeshIsBadInput) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "a.vtu", "<VTKFile/>");
    testing::write_bytes(folder / "a.step", "x");
    for (const char* name : {"a.vtu", "a.step", "absent.msh"})
        EXPECT_EQ(run_program(MYOTET_PROGRAM, {"quality", folder / name}).code, 3) << name;
}

}  // namespace
}  // namespace myotet
