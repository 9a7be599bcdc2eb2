// SPDX-License-Identifier: Apache-2.0
// What others write, we read; what we write, gmsh, meshio and CalculiX read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "NamedMeshes.h"
#include "Support/RunProgram.h"

namespace myotet::meshfiles {
namespace {

using myotet::testing::run_program;
using myotet::testing::TemporaryFolder;
using myotet::testing::write_bytes;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

constexpr const char* kGmsh = "/usr/bin/gmsh";

/// Has gmsh read the file and save it as msh41; the result read back.
NamedMesh through_gmsh(const std::filesystem::path& file, const TemporaryFolder& folder) {
    const auto out = folder / "through.msh";
    const auto ran =
        run_program(kGmsh, {file.string(), "-save", "-format", "msh41", "-o", out.string()});
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    EXPECT_THAT(ran.out + ran.err, ::testing::Not(HasSubstr("Error")));
    EXPECT_THAT(ran.out + ran.err, ::testing::Not(HasSubstr("Warning")));
    return read_mesh(out);
}

class Gmsh : public ::testing::TestWithParam<Encoding> {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(kGmsh)) GTEST_SKIP() << "gmsh is not installed";
    }
};

TEST_P(Gmsh, KeepsGroupsTagsAndNamesOfOurMsh) {
    const TemporaryFolder folder;
    const NamedMesh mesh = three_tets();
    write_mesh(mesh, folder / "a.msh", GetParam());
    const NamedMesh back = through_gmsh(folder / "a.msh", folder);
    EXPECT_EQ(back.mesh.points.size(), mesh.mesh.points.size());
    EXPECT_EQ(back.mesh.tets.size(), mesh.mesh.tets.size());
    EXPECT_EQ(back.names, mesh.names);
    ASSERT_EQ(back.faces.size(), mesh.faces.size());
    for (std::size_t s = 0; s < back.faces.size(); ++s) {
        EXPECT_EQ(back.faces[s].name, mesh.faces[s].name);
        EXPECT_EQ(back.faces[s].tag, mesh.faces[s].tag);
        EXPECT_EQ(back.faces[s].triangles.size(), mesh.faces[s].triangles.size());
    }
}

INSTANTIATE_TEST_SUITE_P(Encodings, Gmsh, ::testing::Values(Encoding::text, Encoding::binary));

TEST(GmshReads, OurMeditAndNastran) {
    if (!std::filesystem::exists(kGmsh)) GTEST_SKIP() << "gmsh is not installed";
    const TemporaryFolder folder;
    const NamedMesh mesh = three_tets();
    for (const char* name : {"a.mesh", "a.bdf"}) {
        write_mesh(mesh, folder / name);
        const NamedMesh back = through_gmsh(folder / name, folder);
        EXPECT_EQ(back.mesh.tets.size(), 3u) << name;
        EXPECT_NEAR(volume(back.mesh), volume(mesh.mesh), 1e-6 * volume(mesh.mesh)) << name;
    }
}

constexpr const char* kPython = "/usr/bin/python3";

/// Counts of points, cells by type and names of sets, as meshio reads a file.
constexpr const char* kMeshio =
    "import meshio, sys\n"
    "for f in sys.argv[1:]:\n"
    "    m = meshio.read(f)\n"
    "    print(f.rsplit('/')[-1], len(m.points), *[(c.type, len(c.data)) for c in m.cells],\n"
    "          *sorted(m.field_data), *sorted(m.cell_sets or []), sep=';')\n";

TEST(MeshioReads, WhatWeWrite) {
    if (run_program(kPython, {"-c", "import meshio"}).code != 0)
        GTEST_SKIP() << "meshio is not installed";
    const TemporaryFolder folder;
    NamedMesh mesh = three_tets();
    std::vector<std::string> words = {"-c", kMeshio};
    for (const char* name : {"a.msh", "a.inp", "a.bdf", "a.mesh", "a.stl", "a.obj"}) {
        write_mesh(mesh, folder / name);
        words.push_back(folder / name);
    }
    mesh.faces.resize(1);
    write_mesh(mesh, folder / "one.ply");
    words.push_back(folder / "one.ply");
    const auto ran = run_program(kPython, words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    for (const char* line :
         {"a.msh;6;('triangle', 2);('triangle', 6);('triangle', 2);('tetra', 1);('tetra', 2);",
          ";M. triceps, caput <longum> & more|exterior;biceps;",
          "a.inp;6;('tetra', 1);('tetra', 2);", "a.bdf;6;('tetra', 3)\n",
          "a.mesh;6;('triangle', 10);('tetra', 3)\n", "a.stl;6;('triangle', 8)\n",
          "a.obj;6;('triangle', 2);('triangle', 6);('triangle', 2)\n", "one.ply;4;('triangle', 2)"})
        EXPECT_THAT(ran.out, HasSubstr(line));
}

/// The unit cube as six tetrahedra around a diagonal: nodes numbered by x + 2 y + 4 z.
NamedMesh cube() {
    TetMesh mesh;
    for (int n = 0; n < 8; ++n) mesh.points.emplace_back(n & 1, n >> 1 & 1, n >> 2);
    mesh.tets = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                 {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
    mesh.labels.assign(mesh.tets.size(), 5);
    return with_named_boundary(std::move(mesh), {{5, "block"}});
}

// CalculiX prints seven digits.
constexpr double kPrinted = 1e-6;

/// Law: the pressure p all around a free body shrinks it by (1 - 2 nu) p / E
/// everywhere. Needs the elements, every face of the exterior and its side.
TEST(CalculixSolves, OurAbaqusUnderPressure) {
    constexpr const char* kCalculix = "/usr/bin/ccx";
    if (!std::filesystem::exists(kCalculix)) GTEST_SKIP() << "CalculiX is not installed";
    const TemporaryFolder folder;
    const NamedMesh mesh = cube();
    write_mesh(mesh, folder / "mesh.inp");
    write_bytes(folder / "job.inp", "*INCLUDE, INPUT=" + (folder / "mesh.inp").string() +
                                        "\n*MATERIAL, NAME=M\n*ELASTIC\n1., 0.3\n"
                                        "*SOLID SECTION, ELSET=block, MATERIAL=M\n"
                                        "*BOUNDARY\n1, 1, 3\n2, 2, 3\n3, 3, 3\n"
                                        "*STEP\n*STATIC\n*DSLOAD\n\"block|exterior\", P, 0.001\n"
                                        "*NODE PRINT, NSET=\"block|exterior\"\nU\n*END STEP\n");
    const auto ran = run_program(  // there, because it leaves files where it runs
        "/bin/sh", {"-c", "cd '" + folder.path().string() + "' && " + kCalculix + " -i job"});
    ASSERT_EQ(ran.code, 0) << ran.out << ran.err;
    EXPECT_THAT(ran.out, ::testing::Not(HasSubstr("WARNING")));
    std::ifstream results(folder / "job.dat");
    std::string line;
    int nodes = 0, number = 0;
    Vec3 moved;
    while (std::getline(results, line)) {
        std::istringstream words(line);
        if (!(words >> number >> moved[0] >> moved[1] >> moved[2])) continue;
        const Vec3 wanted = -0.4e-3 * mesh.mesh.points.at(static_cast<std::size_t>(number - 1));
        EXPECT_NEAR((moved - wanted).norm(), 0, kPrinted * 1e-3) << number;
        ++nodes;
    }
    EXPECT_EQ(nodes, 8);
}

// gmsh writes Nastran's small fields: eight characters, five digits at least.
constexpr double kSmallField = 1e-5;

TEST(WeRead, GmshsAbaqusNastranAndMedit) {
    if (!std::filesystem::exists(kGmsh)) GTEST_SKIP() << "gmsh is not installed";
    const TemporaryFolder folder;
    const NamedMesh mesh = three_tets();
    write_mesh(mesh, folder / "a.msh");
    for (const char* format : {"inp", "bdf", "mesh"}) {
        const auto out = folder / (std::string("b.") + format);
        const auto ran = run_program(
            kGmsh, {(folder / "a.msh").string(), "-save", "-format", format, "-o", out.string()});
        ASSERT_EQ(ran.code, 0) << ran.out << ran.err;
        const NamedMesh back = read_mesh(out);
        EXPECT_EQ(back.mesh.tets.size(), 3u) << format;
        EXPECT_NEAR(volume(back.mesh), volume(mesh.mesh), kSmallField * volume(mesh.mesh))
            << format;
    }
}

/// Sets of elements, ranges and quoted names, as Abaqus writes them.
TEST(WeRead, AbaqusWithElementSetsAndRanges) {
    const TemporaryFolder folder;
    write_bytes(folder / "a.inp",
                "*Heading\r\n** a comment\r\n*Node\r\n 10, 0., 0., 0.\r\n 20, 1., 0., 0.\r\n"
                " 30, 0., 1., 0.\r\n 40, 0., 0., 1.\r\n 50, 1., 1., 1.\r\n"
                "*Element, type=C3D4\r\n1, 10, 20, 30, 40\r\n2, 20, 30, 40, 50\r\n"
                "*Elset, elset=bone\r\n 1,\r\n*Elset, elset=\"deep, fat\", generate\r\n 2, 2, 1\r\n"
                "*Nset, nset=fixed, generate\r\n 10, 30, 10\r\n"
                "*Surface, type=ELEMENT, name=under\r\nbone, S1\r\n"
                "*Material, name=any\r\n*Elastic\r\n1., 0.3\r\n");
    const NamedMesh mesh = read_mesh(folder / "a.inp");
    EXPECT_THAT(mesh.mesh.labels, ElementsAre(1, 2));
    EXPECT_THAT(mesh.names, ElementsAre(Pair(1, "bone"), Pair(2, "deep, fat")));
    ASSERT_EQ(mesh.faces.size(), 1u);
    EXPECT_EQ(mesh.faces[0].name, "under");
    EXPECT_THAT(mesh.faces[0].triangles, ElementsAre(Triangle{0, 2, 1}));
    EXPECT_THAT(mesh.nodes[0].nodes, ElementsAre(0, 1, 2));
}

/// Small, large and free fields, exponents without a letter, THRU-less sets.
TEST(WeRead, NastranInAllFields) {
    const TemporaryFolder folder;
    write_bytes(folder / "a.nas",
                "$ bulk data alone\n"
                "GRID           1              0.      0.      0.\n"
                "GRID,2,,1.+0,0.,0.\n"
                "GRID*                  3                             0.             1.D0\n"
                "*                     0.\n"
                "GRID           4              0.      0.   1.5-1\n"
                "CTETRA         1       9       1       2       3       4\n");
    const NamedMesh mesh = read_mesh(folder / "a.nas");
    EXPECT_THAT(mesh.mesh.labels, ElementsAre(9));
    EXPECT_DOUBLE_EQ(volume(mesh.mesh), 0.15 / 6);
}

/// Labels and tags of FEBio files come from their order and their names.
TEST(WeRead, FebioWithoutOurComments) {
    const TemporaryFolder folder;
    write_bytes(folder / "a.feb",
                "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?><febio_spec version=\"4.0\"><Mesh>"
                "<Nodes name=\"n\"><node id=\"3\">0,0,0</node><node id=\"4\">1.0e+00, 0, 0</node>"
                "<node id=\"5\">0,1,0</node><node id=\"9\">0,0,1</node></Nodes>"
                "<Elements type=\"tet4\" name=\"bone\"><elem id=\"1\"> 3, 4, 5, 9</elem></Elements>"
                "<Surface name=\"bone|exterior\"><tri3 id=\"1\">3,5,4</tri3></Surface>"
                "<Surface name=\"other\"><tri3 id=\"1\">3,4,9</tri3></Surface>"
                "</Mesh></febio_spec>");
    const NamedMesh mesh = read_mesh(folder / "a.feb");
    EXPECT_THAT(mesh.names, ElementsAre(Pair(1, "bone")));
    EXPECT_EQ(mesh.faces[0].tag, 1001);
    EXPECT_EQ(mesh.faces[1].tag, 1002);
    EXPECT_DOUBLE_EQ(volume(mesh.mesh), 1.0 / 6);
}

}  // namespace
}  // namespace myotet::meshfiles
