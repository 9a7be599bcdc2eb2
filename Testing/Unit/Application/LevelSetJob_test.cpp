// SPDX-License-Identifier: Apache-2.0
// The program as a user runs it: labels to level sets and surfaces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "MeshFiles/MeshFiles.h"
#include "Phantoms/Phantoms.h"
#include "Segmentation/ReadLabels.h"
#include "Support/RunProgram.h"

namespace myotet {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Ran;
using Json = nlohmann::json;

// The level set's surface meets the volume that the report tells.
constexpr double kVolume = 0.005;

class LevelSetJob : public ::testing::Test {
protected:
    fs::path save(const LabelVolume& labels, const std::string& name = "scan.nrrd") {
        segmentation::write_labels(labels, folder_ / name);
        return folder_ / name;
    }
    [[nodiscard]] fs::path out() const { return folder_ / "out"; }
    fs::path write(const std::string& name, const std::string& text) {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }
    Ran levelset(const fs::path& input, std::vector<std::string> more = {}) {
        std::vector<std::string> words = {"levelset", input, "-o", out(), "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return testing::run_program(MYOTET_PROGRAM, words);
    }
    Json report(const fs::path& input, std::vector<std::string> more = {}) {
        more.emplace_back("--json");
        const Ran ran = levelset(input, more);
        EXPECT_EQ(ran.code, 0) << ran.err;
        return Json::parse(ran.out);
    }

    testing::TemporaryFolder folder_;
};

TEST_F(LevelSetJob, WritesADistanceAndASurfaceATissue) {
    const Json r = report(save(phantoms::make_phantom("blocks").volume));
    ASSERT_EQ(r["tissues"].size(), 2u);
    for (const Json& tissue : r["tissues"]) {
        ASSERT_EQ(tissue["files"].size(), 2u);
        EXPECT_GT(fs::file_size(out() / tissue["files"][0].get<std::string>()), 1000u);
        const TriMesh surface =
            meshfiles::read_surface(out() / tissue["files"][1].get<std::string>());
        EXPECT_NEAR(volume(surface) / tissue["volume_level_set_mm3"].get<double>(), 1, kVolume);
        EXPECT_NEAR(volume(surface) / tissue["volume_labels_mm3"].get<double>(), 1, kVolume);
        EXPECT_EQ(surface.triangles.size(), tissue["triangles"]);
    }
    EXPECT_EQ(r["tissues"][0]["files"][0], "1_large_block.vdb");
    EXPECT_EQ(r["options"]["smoothing"], "curvature");
}

TEST_F(LevelSetJob, SurfacesAsVtpCarryFrameAndName) {
    const Json r = report(save(phantoms::make_phantom("blocks").volume), {"--surface", "vtp"});
    std::ifstream in(out() / r["tissues"][1]["files"][1].get<std::string>());
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    for (const char* fact : {"label_names", "SPACE", "units"}) EXPECT_THAT(text, HasSubstr(fact));
}

TEST_F(LevelSetJob, ConstrainedSmoothingChangesNoVoxel) {
    const fs::path scan = save(phantoms::make_phantom("arm", Vec3::Constant(3)).volume);
    const Json held = report(scan, {"--smoothing", "constrained"});
    for (const Json& tissue : held["tissues"]) {
        EXPECT_EQ(tissue["smoothing"]["voxels_lost"], 0) << tissue["name"];
        EXPECT_EQ(tissue["smoothing"]["voxels_gained"], 0) << tissue["name"];
        EXPECT_GT(tissue["smoothing"]["moved_mean_mm"], 0) << tissue["name"];
    }
    for (const Json& tissue : report(scan, {"--smoothing", "none"})["tissues"])
        EXPECT_LT(tissue["smoothing"]["moved_95_percent_mm"], 0.05) << tissue["name"];
}

TEST_F(LevelSetJob, SegmentsOfTwoLayersStayWhole) {
    // Two blocks in two layers that share four slices; value 1 in both.
    std::string header =
        "NRRD0005\ntype: uint8\ndimension: 4\nspace: left-posterior-superior\n"
        "sizes: 2 12 12 16\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n"
        "kinds: list domain domain domain\nencoding: raw\nspace origin: (0,0,0)\n"
        "Segment0_LabelValue:=1\nSegment0_Layer:=0\nSegment0_Name:=below\n"
        "Segment1_LabelValue:=1\nSegment1_Layer:=1\nSegment1_Name:=above\n\n";
    std::string voxels;
    for (int k = 0; k < 16; ++k)
        for (int j = 0; j < 12; ++j)
            for (int i = 0; i < 12; ++i) {
                const bool within = i > 1 && i < 10 && j > 1 && j < 10;
                voxels += static_cast<char>(within && k > 1 && k < 10);
                voxels += static_cast<char>(within && k > 5 && k < 14);
            }
    const fs::path scan = write("layers.seg.nrrd", header + voxels);
    const Json r = report(scan);
    ASSERT_EQ(r["tissues"].size(), 2u);
    for (const Json& tissue : r["tissues"])
        EXPECT_NEAR(tissue["volume_level_set_mm3"].get<double>(), 8 * 8 * 8, 0.02 * 512);
    EXPECT_EQ(r["tissues"][0]["files"][0], "1_below.vdb");
    EXPECT_EQ(r["tissues"][1]["files"][0], "1-1_above.vdb");
    EXPECT_EQ(report(scan, {"--labels", "1:1"})["tissues"][0]["name"], "above");

    const fs::path recipe = write("r.yaml", "steps:\n  - priority: [above, below]\n");
    const Json decided = report(scan, {"--repair", recipe});
    EXPECT_NEAR(decided["tissues"][0]["volume_level_set_mm3"].get<double>(), 8 * 8 * 4, 0.03 * 256);
    EXPECT_NEAR(decided["tissues"][1]["volume_level_set_mm3"].get<double>(), 512, 0.02 * 512);
    ASSERT_EQ(decided["repair"].size(), 1u);
    EXPECT_NEAR(decided["repair"][0]["removed_mm3"].get<double>(), 256, 0.03 * 256);
}

TEST_F(LevelSetJob, GapsAreAlwaysToldAndClosedOnDemand) {
    LabelVolume blocks;  // 1 above 2, a slit of one voxel between, and a pocket in it
    blocks.size = {14, 14, 17};
    blocks.values.assign(14 * 14 * 17, 0);
    for (int k = 2; k < 15; ++k)
        for (int j = 2; j < 12; ++j)
            for (int i = 2; i < 12; ++i) {
                const bool rim = i == 2 || i == 11 || j == 2 || j == 11;
                blocks.values[blocks.offset(i, j, k)] = k < 8 ? 2 : k > 8 || rim ? 1 : 0;
            }
    const fs::path scan = save(blocks);
    const Json open = report(scan);
    EXPECT_EQ(open["gaps"]["pockets"], 1);
    EXPECT_EQ(open["gaps"]["pocket_voxels"], 64);
    EXPECT_EQ(open["gaps"]["closed_voxels"], 0);
    const Json closed = report(scan, {"--close-gaps", "1.5"});
    EXPECT_EQ(closed["gaps"]["closed_voxels"], 64);
    double before = 0, after = 0;
    for (const Json& t : open["tissues"]) before += t["voxels"].get<double>();
    for (const Json& t : closed["tissues"]) after += t["voxels"].get<double>();
    EXPECT_EQ(after - before, 64);
}

TEST_F(LevelSetJob, ARecipeThatCannotBeDoneLeavesNothing) {
    const fs::path scan = save(phantoms::make_phantom("blocks").volume);
    const fs::path recipe = write("r.yaml", "steps:\n  - keep_largest: smal_block\n");
    const Ran ran = levelset(scan, {"--repair", recipe});
    EXPECT_EQ(ran.code, 3);
    EXPECT_THAT(ran.err, HasSubstr("step 1"));
    EXPECT_THAT(ran.err, HasSubstr("small_block"));
    EXPECT_FALSE(fs::exists(out()));
}

TEST_F(LevelSetJob, RepairReachesMeshesAndNeighboursThatWereNotAskedFor) {
    const fs::path scan = save(phantoms::make_phantom("blocks").volume);
    const fs::path recipe = write("r.yaml", "steps:\n  - offset: small_block\n    by: 2\n");
    const Ran ran = testing::run_program(
        MYOTET_PROGRAM, {"mesh", scan, "-o", out(), "--labels", "small_block", "--edge-length", "4",
                         "--repair", recipe, "--json", "--quiet"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Json r = Json::parse(ran.out);
    ASSERT_EQ(r["tissues"].size(), 1u);
    const double added = r["repair"][0]["added_mm3"];
    EXPECT_GT(added, 0);
    // The large block, which no result was asked of, keeps what is its own.
    EXPECT_EQ(r["tissues"][0]["label"], 2);
    EXPECT_NEAR(r["tissues"][0]["volume_mesh_mm3"].get<double>() /
                    r["tissues"][0]["volume_labels_mm3"].get<double>(),
                1, 0.02);
}

/// Words of a patient's identity, put wherever a header has room for them.
const std::string kMark = "Mustermann";

TEST_F(LevelSetJob, NothingOfThePatientReachesAnOutputOrALog) {
    const fs::path nifti = save(phantoms::make_phantom("blocks").volume, "scan.nii");
    std::fstream file(nifti, std::ios::in | std::ios::out | std::ios::binary);
    for (const int field : {14, 148, 228, 328}) {  // db_name, descrip, aux_file, intent_name
        file.seekp(field);
        file << kMark;
    }
    file.close();
    std::string header =
        "NRRD0005\n# " + kMark + "\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\n" +
        "sizes: 8 8 8\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\n" +
        "content: " + kMark + "\nspace origin: (0,0,0)\nPatientName:=" + kMark +
        "\nSegment0_Name:=cube\nSegment0_LabelValue:=1\nSegment0_Tags:=x:" + kMark + "\n\n";
    std::string voxels;
    for (int v = 0; v < 512; ++v) {
        const int i = v % 8, j = v / 8 % 8, k = v / 64;
        voxels += static_cast<char>(i > 1 && i < 6 && j > 1 && j < 6 && k > 1 && k < 6);
    }
    for (const fs::path& scan : {nifti, write("scan.nrrd", header + voxels)}) {
        for (const std::vector<std::string>& words :
             {std::vector<std::string>{"levelset", scan, "-o", out(), "--verbose"},
              {"mesh", scan, "-o", folder_ / "meshes", "--edge-length", "3", "--verbose"},
              {"inspect", scan},
              {"inspect", scan, "--json"}}) {
            const Ran ran = testing::run_program(MYOTET_PROGRAM, words);
            EXPECT_EQ(ran.code, 0) << ran.err;
            EXPECT_THAT(ran.out + ran.err, Not(HasSubstr(kMark)));
        }
        for (const char* results : {"out", "meshes"})
            for (const auto& entry : fs::directory_iterator(folder_ / results)) {
                std::ifstream in(entry.path(), std::ios::binary);
                const std::string bytes((std::istreambuf_iterator<char>(in)), {});
                EXPECT_THAT(bytes, Not(HasSubstr(kMark))) << entry.path();
            }
    }
}

}  // namespace
}  // namespace myotet
