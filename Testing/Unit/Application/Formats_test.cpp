// SPDX-License-Identifier: Apache-2.0
// mesh --format and convert, through the built program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "MeshFiles/MeshFiles.h"
#include "Support/RunProgram.h"

namespace myotet {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Pair;
using testing::run_program;
using testing::TemporaryFolder;
using ::testing::UnorderedElementsAre;

/// The meshes of two blocks, in `out`.
testing::Ran mesh_blocks(const TemporaryFolder& folder, const fs::path& out,
                         const std::vector<std::string>& more) {
    const std::string scan = folder / "blocks.nii.gz";
    EXPECT_EQ(run_program(MYOTET_PROGRAM, {"phantom", "blocks", "-o", scan}).code, 0);
    std::vector<std::string> words = {"mesh", scan, "-o", out.string(), "--edge-length", "6"};
    words.insert(words.end(), more.begin(), more.end());
    return run_program(MYOTET_PROGRAM, words);
}

TEST(MeshFormats, EachTissueInEachFormatAndAllTogether) {
    const TemporaryFolder folder;
    const fs::path out = folder / "out";
    const testing::Ran ran =
        mesh_blocks(folder, out, {"--format", "vtu,msh,xdmf,obj", "--together"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const TetMesh large = meshfiles::read_vtu(out / "1_large_block.vtu");
    for (const char* name : {"1_large_block.msh", "1_large_block.xdmf"}) {
        const meshfiles::NamedMesh mesh = meshfiles::read_mesh(out / name);
        EXPECT_EQ(mesh.mesh.tets, large.tets) << name;
        EXPECT_EQ(mesh.mesh.points, large.points) << name;
        EXPECT_THAT(mesh.names, UnorderedElementsAre(Pair(1, "large_block")));
        ASSERT_EQ(mesh.faces.size(), 1u);
        EXPECT_EQ(mesh.faces[0].name, "large_block|exterior");
        EXPECT_EQ(mesh.faces[0].tag, 1001);
    }
    const meshfiles::NamedMesh all = meshfiles::read_mesh(out / "all.msh");
    const TetMesh small = meshfiles::read_vtu(out / "2_small_block.vtu");
    EXPECT_EQ(all.mesh.tets.size(), large.tets.size() + small.tets.size());
    EXPECT_EQ(all.names.size(), 2u);
    EXPECT_EQ(all.faces.size(), 2u);
    for (const char* name : {"all.vtu", "all.xdmf", "all.h5", "all.obj", "2_small_block.obj"})
        EXPECT_TRUE(fs::exists(out / name)) << name;
    EXPECT_FALSE(fs::exists(out / "1_large_block.stl"));
}

TEST(MeshFormats, AnUnknownOneIsAMistakeOfUsage) {
    const TemporaryFolder folder;
    const testing::Ran ran = mesh_blocks(folder, folder / "out", {"--format", "vtu,step"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err, HasSubstr("step"));
}

TEST(Convert, NamesTheBoundaryOfWhatHasNone) {
    const TemporaryFolder folder;
    const fs::path out = folder / "out";
    ASSERT_EQ(mesh_blocks(folder, out, {}).code, 0);
    const std::string vtu = out / "2_small_block.vtu", feb = out / "b.feb", back = out / "b.vtu";
    const testing::Ran ran = run_program(MYOTET_PROGRAM, {"convert", vtu, "-o", feb});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("wrote " + feb));
    EXPECT_EQ(meshfiles::read_mesh(feb).faces.front().name, "small_block|exterior");
    ASSERT_EQ(run_program(MYOTET_PROGRAM, {"convert", feb, "-o", back}).code, 0);
    EXPECT_EQ(testing::read_bytes(back), testing::read_bytes(vtu));
}

TEST(Convert, RefusalsAreBadInput) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "a.feb", "<febio_spec version=\"1.2\"/>");
    const std::string in = folder / "a.feb";
    for (const std::string out : {folder / "b.msh", folder / "b.step"}) {
        const testing::Ran ran = run_program(MYOTET_PROGRAM, {"convert", in, "-o", out});
        EXPECT_EQ(ran.code, 3) << ran.err;
        EXPECT_FALSE(fs::exists(out));
    }
}

}  // namespace
}  // namespace myotet
