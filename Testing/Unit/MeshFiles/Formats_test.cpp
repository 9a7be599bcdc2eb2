// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "NamedMeshes.h"
#include "Support/TemporaryFolder.h"

namespace myotet::meshfiles {
namespace {

using myotet::testing::read_bytes;
using myotet::testing::TemporaryFolder;
using myotet::testing::write_bytes;
using ::testing::HasSubstr;

struct Case {
    const char* extension;
    bool faces = true, nodes = true;
    double tolerance = 0;  ///< of coordinates, relative
    Encoding encoding = Encoding::text;
};

// A Nastran field has 16 characters: ten digits beside sign, point and exponent.
constexpr double kNastranTolerance = 1e-9;

const Case kCases[] = {{".vtu", false, false},
                       {".msh", true, false},
                       {".msh", true, false, 0, Encoding::binary},
                       {".feb"},
                       {".inp"},
                       {".bdf", true, true, kNastranTolerance},
                       {".nas", true, true, kNastranTolerance},
                       {".xdmf"},
                       {".mesh", true, false}};

class TetFormat : public ::testing::TestWithParam<Case> {};

void expect_same_sets(const NamedMesh& back, const NamedMesh& mesh, const Case& c) {
    ASSERT_EQ(back.faces.size(), c.faces ? mesh.faces.size() : 0u);
    for (std::size_t s = 0; s < back.faces.size(); ++s) {
        EXPECT_EQ(back.faces[s].name, mesh.faces[s].name);
        EXPECT_EQ(back.faces[s].tag, mesh.faces[s].tag);
        ASSERT_EQ(back.faces[s].triangles.size(), mesh.faces[s].triangles.size());
        for (std::size_t t = 0; t < back.faces[s].triangles.size(); ++t) {
            Triangle a = back.faces[s].triangles[t], b = mesh.faces[s].triangles[t];
            std::ranges::rotate(a, std::ranges::min_element(a));  // the turn counts, not the start
            std::ranges::rotate(b, std::ranges::min_element(b));
            EXPECT_EQ(a, b);
        }
    }
    ASSERT_EQ(back.nodes.size(), c.nodes ? mesh.nodes.size() : 0u);
    for (std::size_t s = 0; s < back.nodes.size(); ++s) {
        EXPECT_EQ(back.nodes[s].name, mesh.nodes[s].name);
        EXPECT_EQ(back.nodes[s].nodes, mesh.nodes[s].nodes);
    }
}

TEST_P(TetFormat, RoundTripKeepsMeshNamesFacesAndNodes) {
    const TemporaryFolder folder;
    const Case& c = GetParam();
    const NamedMesh mesh = three_tets();
    const auto file = folder / (std::string("a & b") + c.extension);
    write_mesh(mesh, file, c.encoding);
    const NamedMesh back = read_mesh(file);
    ASSERT_EQ(back.mesh.points.size(), mesh.mesh.points.size());
    for (std::size_t p = 0; p < back.mesh.points.size(); ++p)
        for (int a = 0; a < 3; ++a)
            EXPECT_NEAR(back.mesh.points[p][a], mesh.mesh.points[p][a],
                        c.tolerance * std::abs(mesh.mesh.points[p][a]));
    EXPECT_EQ(back.mesh.tets, mesh.mesh.tets);
    EXPECT_EQ(back.mesh.labels, mesh.mesh.labels);
    EXPECT_EQ(back.names, mesh.names);
    expect_same_sets(back, mesh, c);
}

TEST_P(TetFormat, SameMeshSameBytesAndNoFileLeftOver) {
    const TemporaryFolder one, two;
    const Case& c = GetParam();
    for (const TemporaryFolder* folder : {&one, &two})
        write_mesh(three_tets(), *folder / (std::string("a") + c.extension), c.encoding);
    const auto files = files_of(one / (std::string("a") + c.extension));
    for (const auto& file : files)
        EXPECT_EQ(read_bytes(file), read_bytes(two / file.filename().string()));
    const auto entries = std::filesystem::directory_iterator(one.path());
    EXPECT_EQ(static_cast<std::size_t>(std::distance(begin(entries), end(entries))), files.size());
}

TEST_P(TetFormat, UnwritableFolderIsAnErrorInSilence) {
    const TemporaryFolder folder;
    ::testing::internal::CaptureStderr();
    EXPECT_THROW(write_mesh(three_tets(), folder / (std::string("no/a") + GetParam().extension),
                            GetParam().encoding),
                 IoError);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

/// Law: a file cut short anywhere before its last line break is refused.
TEST_P(TetFormat, CutFilesAreRefused) {
    const TemporaryFolder folder;
    const Case& c = GetParam();
    const auto file = folder / (std::string("a") + c.extension);
    write_mesh(three_tets(), file, c.encoding);
    const auto heavy = files_of(file).front();
    const std::string whole = read_bytes(heavy);
    ::testing::internal::CaptureStderr();
    for (std::size_t length = 0; length + 1 < whole.size(); length += 1 + whole.size() / 150) {
        write_bytes(heavy, whole.substr(0, length));
        EXPECT_THROW((void)read_mesh(file), Error) << length;
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_P(TetFormat, ChangedBytesNeverCrash) {
    const TemporaryFolder folder;
    const Case& c = GetParam();
    const auto file = folder / (std::string("a") + c.extension);
    write_mesh(three_tets(), file, c.encoding);
    const auto heavy = files_of(file).front();
    const std::string whole = read_bytes(heavy);
    ::testing::internal::CaptureStderr();
    for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 200) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x15);
        write_bytes(heavy, damaged);
        try {
            const NamedMesh back = read_mesh(file);
            for (const Tet& t : back.mesh.tets)
                for (const std::int32_t n : t)
                    ASSERT_LT(static_cast<std::size_t>(n), back.mesh.points.size());
        } catch (const Error&) {
        }
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

INSTANTIATE_TEST_SUITE_P(Formats, TetFormat, ::testing::ValuesIn(kCases), [](const auto& test) {
    return std::string(test.param.extension + 1) +
           (test.param.encoding == Encoding::binary ? "_binary" : "");
});

TEST(SurfaceFormat, PlyAndObjKeepNamedFaces) {
    const TemporaryFolder folder;
    const NamedMesh mesh = three_tets();
    for (const char* name : {"a.ply", "a.obj"}) {
        write_mesh(mesh, folder / name);
        const NamedMesh back = read_mesh(folder / name);
        ASSERT_EQ(back.faces.size(), 3u) << name;
        EXPECT_TRUE(back.mesh.tets.empty());
        for (std::size_t s = 0; s < 3; ++s) {
            EXPECT_EQ(back.faces[s].name, mesh.faces[s].name);
            EXPECT_EQ(back.faces[s].tag, mesh.faces[s].tag);
            ASSERT_EQ(back.faces[s].triangles.size(), mesh.faces[s].triangles.size());
            for (std::size_t t = 0; t < mesh.faces[s].triangles.size(); ++t)
                for (int i = 0; i < 3; ++i)
                    EXPECT_EQ(back.mesh.points[back.faces[s].triangles[t][i]],
                              mesh.mesh.points[mesh.faces[s].triangles[t][i]]);
        }
    }
}

/// Readers that know no property beside a face's corners are many.
TEST(SurfaceFormat, PlyOfOneFaceSetHasNoPropertyButKeepsItsNameAndTag) {
    const TemporaryFolder folder;
    NamedMesh mesh = three_tets();
    mesh.faces.resize(1);
    write_mesh(mesh, folder / "a.ply");
    EXPECT_THAT(read_bytes(folder / "a.ply"), ::testing::Not(HasSubstr("tag")));
    const NamedMesh back = read_mesh(folder / "a.ply");
    ASSERT_EQ(back.faces.size(), 1u);
    EXPECT_EQ(back.faces[0].name, mesh.faces[0].name);
    EXPECT_EQ(back.faces[0].tag, mesh.faces[0].tag);
    EXPECT_EQ(back.faces[0].triangles.size(), mesh.faces[0].triangles.size());
}

TEST(SurfaceFormat, StlAndVtpHoldTheBoundary) {
    constexpr double kFloat = 1e-4;  // 32-bit coordinates of 123 mm, areas of order 100 mm^2
    const TemporaryFolder folder;
    const NamedMesh mesh = three_tets();
    for (const char* name : {"a.stl", "a.vtp"}) {
        write_mesh(mesh, folder / name);
        const TriMesh back = read_surface(folder / name);
        EXPECT_EQ(back.triangles.size(), 8u) << name;
        EXPECT_NEAR(volume(back), volume(mesh.mesh), kFloat * 100);
    }
}

TEST(SurfaceFormat, SurfacesConvertAmongThemselvesButNotToTetrahedra) {
    const TemporaryFolder folder;
    write_mesh(three_tets(), folder / "a.stl");
    const NamedMesh surface = read_mesh(folder / "a.stl");
    for (const char* name : {"b.ply", "b.obj", "b.stl", "b.vtp"}) {
        write_mesh(surface, folder / name);
        EXPECT_EQ(read_surface(folder / name).triangles.size(), 8u) << name;
    }
    EXPECT_THROW(write_mesh(surface, folder / "b.msh"), InputError);
}

/// What read_mesh says about a file of this content.
std::string complaint(const std::string& name, const std::string& content) {
    const TemporaryFolder folder;
    write_bytes(folder / name, content);
    try {
        (void)read_mesh(folder / name);
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr((folder / name).string()));
        return error.what();
    }
    return "no complaint";
}

std::string written(const char* extension) {
    const TemporaryFolder folder;
    const auto file = folder / (std::string("a") + extension);
    write_mesh(three_tets(), file);
    return read_bytes(file);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(BrokenMesh, IsRefusedWithLineAndReason) {
    EXPECT_THAT(complaint("a.msh", replaced(written(".msh"), "4.1 0 8", "2.2 0 8")),
                HasSubstr("save it as msh41"));
    EXPECT_THAT(complaint("a.msh", replaced(written(".msh"), "\n1 0 0", "\n1 zero 0")),
                HasSubstr("holds 'zero'"));
    EXPECT_THAT(complaint("a.msh", "$Nodes\n"), HasSubstr("line 1 is not $MeshFormat"));
    EXPECT_THAT(complaint("a.feb", replaced(written(".feb"), ">1,2,3,4<", ">1,2,3,9<")),
                HasSubstr("tetrahedron 1 names node 9"));
    EXPECT_THAT(complaint("a.feb", replaced(written(".feb"), "\"tet4\"", "\"hex8\"")),
                HasSubstr("only tet4"));
    EXPECT_THAT(complaint("a.feb", replaced(written(".feb"), "</Nodes>", "</Node>")),
                HasSubstr("line 28 is not valid XML"));
    EXPECT_THAT(complaint("a.inp", replaced(written(".inp"), "4, 0.1, ", "4, nan, ")),
                HasSubstr("not a finite number"));
    EXPECT_THAT(complaint("a.inp", replaced(written(".inp"), "2, 1, 0, 0", "1, 1, 0, 0")),
                HasSubstr("node number 1 is given twice"));
    EXPECT_THAT(complaint("a.inp", replaced(written(".inp"), ", S1", ", S5")),
                HasSubstr("no face S1 to S4"));
    EXPECT_THAT(complaint("a.inp", "*NODE\n1, 0, x, 0\n"), HasSubstr("line 2 holds 'x'"));
    EXPECT_THAT(complaint("a.bdf", replaced(written(".bdf"), "CTETRA", "CHEXA ")),
                HasSubstr("only CTETRA is read"));
    EXPECT_THAT(complaint("a.mesh", replaced(written(".mesh"), "Tetrahedra", "Hexahedra ")),
                HasSubstr("'Hexahedra', which is not read"));
    EXPECT_THAT(complaint("a.mesh", replaced(written(".mesh"), "Vertices\n6", "Vertices\n999999")),
                HasSubstr("cut short"));
    EXPECT_THAT(complaint("a.mesh", replaced(written(".mesh"), "Dimension 3", "Dimension 2")),
                HasSubstr("three dimensions"));
    EXPECT_THAT(complaint("a.med", "x"), HasSubstr("no mesh format"));
    EXPECT_THAT(complaint("a.feb", ""), HasSubstr("is empty"));
}

TEST(BrokenMesh, XdmfWithoutItsNumbersIsRefused) {
    const TemporaryFolder folder;
    write_mesh(three_tets(), folder / "a.xdmf");
    std::filesystem::remove(folder / "a.h5");
    EXPECT_THROW((void)read_mesh(folder / "a.xdmf"), IoError);
}

TEST(WriteMesh, RefusesWhatAFormatCannotHold) {
    const TemporaryFolder folder;
    NamedMesh mesh = three_tets();
    EXPECT_THROW(write_mesh(mesh, folder / "a.step"), InputError);
    mesh.names[7] = "two\nlines";
    EXPECT_THROW(write_mesh(mesh, folder / "a.inp"), MeshError);
    mesh = three_tets();
    mesh.mesh.labels.pop_back();
    EXPECT_THROW(write_mesh(mesh, folder / "a.msh"), MeshError);
    mesh = three_tets();
    mesh.mesh.labels[0] = 0;
    EXPECT_THROW(write_mesh(mesh, folder / "a.msh"), MeshError);
    EXPECT_THROW(write_mesh(mesh, folder / "a.nas"), MeshError);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ReadMesh, RasIsTurnedToLps) {
    const TemporaryFolder folder;
    for (const char* extension : {".msh", ".feb", ".inp", ".bdf", ".mesh"}) {
        const std::string name = std::string("a") + extension;
        write_bytes(folder / name, replaced(written(extension), "SPACE=LPS", "SPACE=RAS"));
        EXPECT_EQ(read_mesh(folder / name).mesh.points[1], Vec3(-1, 0, 0)) << extension;
    }
}

}  // namespace
}  // namespace myotet::meshfiles
