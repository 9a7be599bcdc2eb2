// SPDX-License-Identifier: Apache-2.0
// What users of such tools ask for most, each with a run that shows it. What is
// not answered yet stands in README.md beside this file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "MeshFiles/MeshFiles.h"
#include "Phantoms/Phantoms.h"
#include "Segmentation/Census.h"
#include "Segmentation/ReadLabels.h"
#include "Support/RunProgram.h"

namespace myotet {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

/// A scan on disk and the program's runs on it.
class UserNeeds : public ::testing::Test {
protected:
    void save(const LabelVolume& labels) { segmentation::write_labels(labels, scan()); }
    [[nodiscard]] std::filesystem::path scan() const { return folder_ / "scan.nii.gz"; }
    [[nodiscard]] std::filesystem::path out() const { return folder_ / "out"; }

    testing::Ran run(std::vector<std::string> words, const std::string& folder = "out") {
        const std::string command = words.front();
        words.insert(words.begin() + 1, scan().string());
        if (command != "inspect")
            words.insert(words.end(), {"-o", (folder_ / folder).string(), "--quiet"});
        return testing::run_program(MYOTET_PROGRAM, words);
    }
    /// The report of a run that must succeed.
    Json report(std::vector<std::string> words) {
        words.emplace_back("--json");
        const testing::Ran ran = run(std::move(words));
        EXPECT_EQ(ran.code, 0) << ran.err;
        return Json::parse(ran.out);
    }
    TetMesh mesh_of(const Json& tissue) {
        return meshfiles::read_vtu(out() / tissue["files"][0].get<std::string>());
    }
    [[nodiscard]] std::string bytes(const std::string& folder, const std::string& name) const {
        return testing::read_bytes(folder_ / folder / name);
    }

    testing::TemporaryFolder folder_;
};

/// A ball cut into `parts` equal sectors about z, labels 10, 20 ...: walls, a
/// line where all of them meet, and its two ends on the outside.
LabelVolume sectors(int parts, double radius) {
    LabelVolume v;
    const int n = 2 * static_cast<int>(radius) + 8;
    v.size = {n, n, n};
    v.values.assign(static_cast<std::size_t>(n) * n * n, 0);
    const Vec3 centre = Vec3::Constant(0.5 * n - 0.3);
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const Vec3 p = Vec3(i, j, k) - centre;
                if (p.norm() > radius) continue;
                const double turn = std::atan2(p.y(), p.x()) / (2 * M_PI) + 0.5;
                v.values[v.offset(i, j, k)] =
                    10 * (1 + std::min(parts - 1, static_cast<int>(turn * parts)));
            }
    for (int part = 1; part <= parts; ++part)
        v.names[10 * part] = {"part " + std::to_string(part), {}};
    return v;
}

// 1. Label values and names are kept.
TEST_F(UserNeeds, LabelsKeepValuesAndNamesInEveryOutput) {
    save(sectors(3, 9));
    const Json r = report({"mesh", "--edge-length", "3"});
    ASSERT_EQ(r["tissues"].size(), 3u);
    for (int t = 0; t < 3; ++t) {
        const Json& tissue = r["tissues"][t];
        EXPECT_EQ(tissue["label"], 10 * (t + 1));
        EXPECT_EQ(tissue["name"], "part " + std::to_string(t + 1));
        const std::string file = tissue["files"][0];
        EXPECT_EQ(file, std::to_string(10 * (t + 1)) + "_part_" + std::to_string(t + 1) + ".vtu");
        EXPECT_THAT(bytes("out", file), HasSubstr("label_names"));
        const TetMesh mesh = mesh_of(tissue);
        EXPECT_TRUE(
            std::ranges::all_of(mesh.labels, [&](int label) { return label == 10 * (t + 1); }));
    }
}

// 2. Meshes lie where the scan lies, whatever its axes; sheared ones included.
TEST_F(UserNeeds, MeshesLieWhereTheScanLies) {
    Mat3 oblique = Eigen::AngleAxisd(0.4, Vec3(1, -2, 1).normalized()).toRotationMatrix();
    Mat3 left = oblique, sheared = oblique;
    left.col(1) *= -1;
    sheared.col(0) += 0.3 * sheared.col(1);
    for (const Mat3& axes : {oblique, left, sheared}) {
        LabelVolume labels = sectors(2, 8);
        labels.index_to_lps.linear() = axes * Vec3(1, 1.2, 0.8).asDiagonal();
        labels.index_to_lps.translation() = Vec3(-120, 35, 900);
        save(labels);
        const Json r = report({"mesh", "--edge-length", "3"});
        const auto counts = segmentation::count_labels(labels);
        for (std::size_t t = 0; t < 2; ++t)
            EXPECT_LT((centroid(mesh_of(r["tissues"][t])) - counts[t].centroid).norm(), 0.5);
    }
}

// 3. Smoothing keeps volume and thin parts, its distance is in millimetres, and
// the report says for each label what it did.
TEST_F(UserNeeds, SmoothingKeepsVolumeAndThinPartsAndSaysWhatItDid) {
    LabelVolume labels = sectors(2, 9);
    for (int k = 2; k < labels.size[2] - 2; ++k)  // a thin rod in front
        labels.values[labels.offset(1, 1, k)] = 30;
    save(labels);
    const Json r = report({"mesh", "--edge-length", "2", "--smooth", "0.5"});
    ASSERT_EQ(r["tissues"].size(), 3u);
    for (const Json& tissue : r["tissues"]) {
        const double before = tissue["volume_labels_mm3"];
        EXPECT_NEAR(tissue["volume_mesh_mm3"].get<double>() / before, 1, 0.02) << tissue["label"];
        EXPECT_EQ(tissue["components_out"], 1);
        const Json& smoothing = tissue["smoothing"];
        EXPECT_NEAR(smoothing["volume_after_mm3"].get<double>() / before, 1, 0.02);
        EXPECT_LE(smoothing["moved_mean_mm"], smoothing["moved_95_percent_mm"]);
        EXPECT_LE(smoothing["moved_95_percent_mm"], smoothing["moved_max_mm"]);
        EXPECT_GT(smoothing["moved_max_mm"], 0);
    }
}

// 4. Nothing is lost in silence: as many components out as in, or a sentence.
TEST_F(UserNeeds, EveryComponentComesOutOrIsSpokenOf) {
    LabelVolume labels = sectors(2, 8);
    labels.values[labels.offset(1, 1, 1)] = 10;  // a speck
    for (int i = 0; i < 5; ++i)                  // and a block of 125 voxels, far away
        for (int j = 0; j < 5; ++j)
            for (int k = 0; k < 5; ++k)
                labels.values[labels.offset(labels.size[0] - 6 + i, 1 + j, 1 + k)] = 20;
    save(labels);
    const Json r = report({"mesh", "--edge-length", "2"});
    for (const Json& tissue : r["tissues"]) {
        EXPECT_EQ(tissue["components_in"], 2);
        EXPECT_TRUE(tissue["components_out"] == 2 || !tissue["notes"].empty());
    }
    EXPECT_EQ(r["tissues"][1]["components_out"], 2) << "thick enough to be promised";
}

// 5. Where three, four or eight tissues meet, elements are as good as elsewhere.
TEST_F(UserNeeds, JunctionsOfTissuesHaveGoodElements) {
    for (const int parts : {3, 4, 8}) {
        save(sectors(parts, 12));
        const Json r = report({"mesh", "--edge-length", "2.5"});
        ASSERT_EQ(r["tissues"].size(), static_cast<std::size_t>(parts));
        for (const Json& tissue : r["tissues"]) {
            EXPECT_EQ(tissue["inverted_tets"], 0);
            EXPECT_TRUE(tissue["boundary_manifold"]);
            // Wedges with sharp edges: no flat element, but no smooth shape's angles.
            EXPECT_GT(tissue["min_dihedral_deg"], 10) << parts << " " << tissue["label"];
            EXPECT_LT(tissue["max_dihedral_deg"], 165) << parts << " " << tissue["label"];
            EXPECT_TRUE(tissue["broken_promises"].empty());
        }
    }
}

// 6. Sizes are in millimetres, and thin parts get smaller ones.
TEST_F(UserNeeds, SizesAreMillimetres) {
    LabelVolume labels = sectors(1, 12);
    labels.index_to_lps.linear() *= 0.5;
    save(labels);
    const Json r = report({"mesh", "--edge-length", "1.5"});
    EXPECT_NEAR(r["tissues"][0]["edge_length_surface_median_mm"].get<double>() / 1.5, 1, 0.25);
}

// 9. A run that would not fit says so before it begins; --dry-run says what one takes.
TEST_F(UserNeeds, MemoryIsForecast) {
    save(sectors(2, 9));
    const testing::Ran dry = run({"mesh", "--dry-run", "--json"});
    EXPECT_EQ(dry.code, 0);
    EXPECT_GT(Json::parse(dry.out)["memory_bytes"], 0);
    const testing::Ran huge = run({"mesh", "--edge-length", "0.0005"});
    EXPECT_EQ(huge.code, 6);
    EXPECT_THAT(huge.err, HasSubstr("use a longer --edge-length"));
    EXPECT_FALSE(std::filesystem::exists(out()));
}

// 10. An error names the file, the value, the rule and the remedy.
TEST_F(UserNeeds, ErrorsNameCauseAndCure) {
    save(sectors(2, 6));
    const testing::Ran ran = run({"mesh", "--labels", "part 7"});
    EXPECT_EQ(ran.code, 3);
    EXPECT_THAT(ran.err, HasSubstr("no label is called 'part 7'; the nearest are"));
}

// 11. Same input, same bytes, on one thread or many.
TEST_F(UserNeeds, OutputIsTheSameOnOneThreadOrMany) {
    save(sectors(3, 9));
    for (const char* command : {"mesh", "levelset"}) {
        const testing::Ran one = run({command, "--threads", "1"}, "one");
        const testing::Ran many = run({command, "--threads", "3"}, "many");
        ASSERT_EQ(one.code, 0) << one.err;
        ASSERT_EQ(many.code, 0) << many.err;
        int compared = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder_ / "one")) {
            const std::string name = entry.path().filename();
            if (name == "report.json" || name == "report.html") continue;  // they tell times
            EXPECT_EQ(bytes("one", name), bytes("many", name)) << name;
            ++compared;
        }
        EXPECT_GE(compared, 6);
    }
}

// 12. The licence is permissive, and every source file says so.
TEST(Licence, StandsInEverySourceFile) {
    const std::filesystem::path root = MYOTET_SOURCE_DIR;
    std::ifstream licence(root / "LICENSE");
    std::string text((std::istreambuf_iterator<char>(licence)), {});
    EXPECT_THAT(text, HasSubstr("Apache License"));
    int files = 0;
    for (const char* folder : {"Modules", "Applications", "Testing", "Simulation"}) {
        if (!std::filesystem::exists(root / folder)) continue;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
            const auto kind = entry.path().extension();
            if (kind != ".h" && kind != ".cpp") continue;
            std::ifstream in(entry.path());
            std::string first;
            std::getline(in, first);
            EXPECT_EQ(first, "// SPDX-License-Identifier: Apache-2.0") << entry.path();
            ++files;
        }
    }
    EXPECT_GT(files, 100);
}

}  // namespace
}  // namespace myotet
