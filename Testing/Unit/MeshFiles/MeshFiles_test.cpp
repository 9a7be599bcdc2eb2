// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/MeshFiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>

#include "Core/Errors.h"
#include "Support/TemporaryFolder.h"

namespace myotet::meshfiles {
namespace {

using myotet::testing::read_bytes;
using myotet::testing::TemporaryFolder;
using myotet::testing::write_bytes;
using ::testing::HasSubstr;

// Coordinates that .stl holds as 32-bit numbers: 2^-24 relative, at most 10 mm.
constexpr double kFloatTolerance = 1e-6;

/// The corner tetrahedron with legs of 2, 3 and 4 mm: 4 mm^3.
TriMesh corner() {
    return {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}},
            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

TetMesh two_tets() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.2, -1}},
            {{0, 1, 2, 3}, {0, 2, 1, 4}},
            {7, 12}};
}

const char* const kObj =
    "# SPACE=LPS\nv 0 0 0\nv 2 0 0 1\nv 0 3 0\nv 0 0 4e0\nvn 0 0 1\n"
    "f 1/1/1 3//1 2\nf 1 2 4\nf -4 -1 -2\nf 2 3 4\n";
const char* const kOff =
    "OFF # a comment\n4 4 0\n\n0 0 0\n2 0 0\n0 3 0\n0 0 4\n"
    "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3 255 0 0\n";
const char* const kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n2 0 0\n0 3 0\n0 0 4\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
const char* const kVtp =
    R"(<?xml version="1.0"?><VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
<PolyData><Piece NumberOfPoints="4" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="4">
<Points><DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 2 0 0 0 3 0 0 0 4</DataArray></Points>
<Polys><DataArray type="Int32" Name="connectivity" format="ascii">0 2 1 0 1 3 0 3 2 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">3 6 9 12</DataArray></Polys>
</Piece></PolyData></VTKFile>
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(ReadSurface, SameShapeFromEveryFormat) {
    const TemporaryFolder folder;
    write_bytes(folder / "a.obj", kObj);
    write_bytes(folder / "a.off", kOff);
    write_bytes(folder / "a.PLY", kPly);
    write_bytes(folder / "a.vtp", kVtp);
    write_stl(corner(), folder / "a.stl");
    for (const char* name : {"a.obj", "a.off", "a.PLY", "a.vtp", "a.stl"}) {
        const TriMesh mesh = read_surface(folder / name);
        EXPECT_EQ(mesh.points.size(), 4u) << name;
        EXPECT_EQ(mesh.triangles.size(), 4u) << name;
        EXPECT_NEAR(volume(mesh), 4, kFloatTolerance) << name;
    }
}

TEST(ReadSurface, ScaleTurnsUnitsIntoMillimetres) {
    const TemporaryFolder folder;
    write_bytes(folder / "a.off", kOff);
    EXPECT_DOUBLE_EQ(volume(read_surface(folder / "a.off", 10)), 4000);
    EXPECT_THROW((void)read_surface(folder / "a.off", 0), InputError);
    EXPECT_THROW((void)read_surface(folder / "a.off", std::nan("")), InputError);
}

TEST(ReadSurface, RasIsTurnedToLps) {
    const TemporaryFolder folder;
    write_bytes(folder / "a.obj", replaced(kObj, "SPACE=LPS", "SPACE=RAS"));
    const TriMesh mesh = read_surface(folder / "a.obj");
    EXPECT_DOUBLE_EQ(volume(mesh), 4);  // a rotation, no mirror
    double least = 0;
    for (const Vec3& p : mesh.points) least = std::min(least, p[0]);
    EXPECT_DOUBLE_EQ(least, -2);
}

TEST(ReadSurface, TriangleSoupIsSewnAndDegenerateTrianglesGo) {
    const TemporaryFolder folder;
    std::string soup = "OFF\n15 5 0\n";
    const TriMesh shape = corner();
    for (const Triangle& t : shape.triangles)
        for (const int i : t) {
            const Vec3& p = shape.points[i];
            soup += (p[0] == 0 ? "-0 " : std::to_string(p[0]) + " ") + std::to_string(p[1]) + " " +
                    std::to_string(p[2]) + "\n";
        }
    soup += "0 0 0\n0 0 0\n2 0 0\n";  // a triangle with two corners at one place
    for (int f = 0; f < 5; ++f)
        soup += "3 " + std::to_string(3 * f) + " " + std::to_string(3 * f + 1) + " " +
                std::to_string(3 * f + 2) + "\n";
    write_bytes(folder / "soup.off", soup);
    const TriMesh mesh = read_surface(folder / "soup.off");
    EXPECT_EQ(mesh.points.size(), 4u);
    EXPECT_EQ(mesh.triangles.size(), 4u);
    EXPECT_DOUBLE_EQ(volume(mesh), 4);
}

TEST(ReadSurface, PolygonsAndUnusedPoints) {
    const TemporaryFolder folder;
    write_bytes(folder / "cube.obj",
                "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                "v 99 99 99\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    const TriMesh mesh = read_surface(folder / "cube.obj");
    EXPECT_EQ(mesh.points.size(), 8u);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_DOUBLE_EQ(volume(mesh), 1);
}

TEST(ReadSurface, TextStl) {
    const TemporaryFolder folder;
    std::string text = "solid corner\n";
    const TriMesh shape = corner();
    for (const Triangle& t : shape.triangles) {
        text += "facet normal 0 0 0\n outer loop\n";
        for (const int i : t)
            text += "  vertex " + std::to_string(shape.points[i][0]) + " " +
                    std::to_string(shape.points[i][1]) + " " + std::to_string(shape.points[i][2]) +
                    "\n";
        text += " endloop\nendfacet\n";
    }
    write_bytes(folder / "a.stl", text + "endsolid corner\n\n");
    EXPECT_DOUBLE_EQ(volume(read_surface(folder / "a.stl")), 4);
    write_bytes(folder / "cut.stl", text);
    EXPECT_THROW((void)read_surface(folder / "cut.stl"), IoError);
}

/// What read_surface says about a broken file, and that nothing is printed.
std::string complaint(const std::string& name, const std::string& content) {
    const TemporaryFolder folder;
    write_bytes(folder / name, content);
    ::testing::internal::CaptureStderr();
    ::testing::internal::CaptureStdout();
    std::string said = "no complaint";
    try {
        (void)read_surface(folder / name);
    } catch (const Error& error) {
        said = error.what();
        EXPECT_THAT(said, HasSubstr((folder / name).string()));
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << name;
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "") << name;
    return said;
}

TEST(ReadSurface, BrokenTextFilesAreRefusedWithTheDefect) {
    EXPECT_THAT(complaint("a.obj", replaced(kObj, "v 0 3 0", "v 0 nan 0")), HasSubstr("point 2"));
    EXPECT_THAT(complaint("a.obj", replaced(kObj, "v 0 3 0", "v 0 three 0")),
                HasSubstr("line 4 holds 'three'"));
    EXPECT_THAT(complaint("a.obj", replaced(kObj, "f 2 3 4", "f 2 3 9")), HasSubstr("point 8"));
    EXPECT_THAT(complaint("a.obj", replaced(kObj, "f -4", "f -5")), HasSubstr("point -1"));
    EXPECT_THAT(complaint("a.obj", replaced(kObj, "f 2 3 4", "f 0 3 4")), HasSubstr("vertex 0"));
    EXPECT_THAT(complaint("a.obj", "v 0 0 0\n"), HasSubstr("holds no triangles"));
    EXPECT_THAT(complaint("a.obj", ""), HasSubstr("is empty"));
    EXPECT_THAT(complaint("a.off", std::string(kOff).substr(0, 55)), HasSubstr("cut short"));
    EXPECT_THAT(complaint("a.off", "PFF\n"), HasSubstr("does not begin with OFF"));
    EXPECT_THAT(complaint("a.step", kObj), HasSubstr("no surface format"));
}

TEST(ReadSurface, BrokenStlIsRefused) {
    const TemporaryFolder folder;
    write_stl(corner(), folder / "whole.stl");
    std::string bytes = read_bytes(folder / "whole.stl");
    EXPECT_THAT(complaint("a.stl", bytes.substr(0, bytes.size() - 7)), HasSubstr("cut short"));
    EXPECT_THAT(complaint("a.stl", bytes.substr(0, 20)), HasSubstr("cut short"));
    const float nan = std::nanf("");
    std::memcpy(bytes.data() + 84 + 12, &nan, sizeof nan);
    EXPECT_THAT(complaint("a.stl", bytes), HasSubstr("not a finite number"));
}

TEST(ReadSurface, BrokenPlyIsRefused) {
    EXPECT_THAT(complaint("a.ply", replaced(kPly, "3 1 2 3", "3 1 2 4")), HasSubstr("point 4"));
    EXPECT_THAT(complaint("a.ply", replaced(kPly, "0 3 0", "0 nan 0")), HasSubstr("point 2"));
    const std::string whole = kPly;  // without its last line break a text is still whole
    for (std::size_t length = 0; length + 8 < whole.size(); length += 5)
        EXPECT_NE(complaint("a.ply", whole.substr(0, length)), "no complaint") << length;
}

template <class Number>
std::string bytes_of(Number value, bool big_endian) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

TEST(ReadSurface, BinaryPlyOfBothByteOrders) {
    const TemporaryFolder folder;
    const TriMesh shape = corner();
    for (const bool big : {false, true}) {
        std::string ply = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                          "_endian 1.0\ncomment one\nelement vertex 4\nproperty uchar red\n"
                          "property double x\nproperty float y\nproperty float z\n"
                          "element face 4\nproperty list uchar float texcoord\n"
                          "property list uchar uint vertex_index\nend_header\n";
        for (const Vec3& p : shape.points)
            ply += '\xff' + bytes_of(p[0], big) + bytes_of(static_cast<float>(p[1]), big) +
                   bytes_of(static_cast<float>(p[2]), big);
        for (const Triangle& t : shape.triangles)
            ply += '\1' + bytes_of(9.f, big) + '\3' + bytes_of(t[0], big) + bytes_of(t[1], big) +
                   bytes_of(t[2], big);
        write_bytes(folder / "a.ply", ply);
        EXPECT_DOUBLE_EQ(volume(read_surface(folder / "a.ply")), 4);
        EXPECT_THAT(complaint("a.ply", ply.substr(0, ply.size() - 1)), HasSubstr("cut short"));
    }
}

TEST(ReadSurface, PlyElementsWithoutPropertiesAreNotCounted) {
    EXPECT_THAT(complaint("a.ply",
                          "ply\nformat binary_little_endian 1.0\n"
                          "element vertex 1000000000000000000\nend_header\n"),
                HasSubstr("holds no triangles"));
}

TEST(ReadSurface, BrokenVtpIsRefused) {
    EXPECT_THAT(complaint("a.vtp", replaced(kVtp, "1 2 3</", "1 2 4</")), HasSubstr("point 4"));
    EXPECT_NE(complaint("a.vtp", replaced(kVtp, "3 6 9 12", "3 6 9 99")), "no complaint");
    EXPECT_NE(complaint("a.vtp", replaced(kVtp, "3 6 9 12", "3 6 1 12")), "no complaint");
    const std::string whole = kVtp;
    for (std::size_t length = 0; length + 8 < whole.size(); length += 25)
        EXPECT_NE(complaint("a.vtp", whole.substr(0, length)), "no complaint") << length;
}

TEST(ReadSurface, AbsentFileAndFolder) {
    const TemporaryFolder folder;
    EXPECT_THROW((void)read_surface(folder / "absent.stl"), IoError);
    std::filesystem::create_directory(folder / "folder.ply");
    EXPECT_THROW((void)read_surface(folder / "folder.ply"), IoError);
}

TEST(Stl, HeaderSaysFrameAndUnitAndIsNotTakenForText) {
    const TemporaryFolder folder;
    write_stl(corner(), folder / "a.stl");
    const std::string bytes = read_bytes(folder / "a.stl");
    EXPECT_EQ(bytes.size(), 84u + 4 * 50);
    EXPECT_THAT(bytes.substr(0, 80), HasSubstr("SPACE=LPS"));
    EXPECT_THAT(bytes.substr(0, 80), HasSubstr("UNIT=mm"));
    EXPECT_FALSE(bytes.starts_with("solid"));
}

TEST(Vtu, RoundTripIsExact) {
    const TemporaryFolder folder;
    const TetMesh mesh = two_tets();
    write_vtu(mesh, {{7, "biceps"}, {12, "M. triceps, caput longum"}}, folder / "a.vtu");
    const TetMesh back = read_vtu(folder / "a.vtu");
    EXPECT_EQ(back.points, mesh.points);
    EXPECT_EQ(back.tets, mesh.tets);
    EXPECT_EQ(back.labels, mesh.labels);
}

TEST(Vtu, SaysFrameUnitsAndLayout) {
    const TemporaryFolder folder;
    write_vtu(two_tets(), {{7, "biceps"}}, folder / "a.vtu");
    const std::string text = read_bytes(folder / "a.vtu");
    for (const char* said :
         {R"(header_type="UInt64")", "vtkZLibDataCompressor", R"(<AppendedData encoding="raw">)",
          R"(Name="SPACE")", R"(Name="units")", R"(Name="label_names")",
          R"(type="Int32" Name="label")"})
        EXPECT_THAT(text, HasSubstr(said));
}

TEST(Vtu, SameMeshSameBytesWhateverTheName) {
    const TemporaryFolder folder;
    write_vtu(two_tets(), {{7, "biceps"}}, folder / "a.vtu");
    write_vtu(two_tets(), {{7, "biceps"}}, folder / "another.vtu");
    EXPECT_EQ(read_bytes(folder / "a.vtu"), read_bytes(folder / "another.vtu"));
}

TEST(Vtu, BrokenFilesAreRefusedInSilence) {
    const TemporaryFolder folder;
    write_vtu(two_tets(), {}, folder / "whole.vtu");
    const std::string bytes = read_bytes(folder / "whole.vtu");
    ::testing::internal::CaptureStderr();
    for (const std::size_t length : {std::size_t{0}, bytes.size() / 3, bytes.size() - 60}) {
        write_bytes(folder / "cut.vtu", bytes.substr(0, length));
        EXPECT_THROW((void)read_vtu(folder / "cut.vtu"), Error) << length;
    }
    EXPECT_THROW((void)read_vtu(folder / "absent.vtu"), IoError);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Vtu, UnwritableFolderIsAnErrorAndLeavesNothing) {
    const TemporaryFolder folder;
    ::testing::internal::CaptureStderr();
    EXPECT_THROW(write_vtu(two_tets(), {}, folder / "no/such/a.vtu"), IoError);
    EXPECT_THROW(write_stl(corner(), folder / "no/such/a.stl"), IoError);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Vtu, LabelsMustBeOneATetrahedron) {
    const TemporaryFolder folder;
    TetMesh mesh = two_tets();
    mesh.labels.pop_back();
    EXPECT_THROW(write_vtu(mesh, {}, folder / "a.vtu"), MeshError);
}

}  // namespace
}  // namespace myotet::meshfiles
