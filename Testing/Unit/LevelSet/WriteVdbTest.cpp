// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <fstream>

#include "Core/Errors.h"
#include "LevelSet/WriteVdb.h"
#include "Support/AnalyticLevelSet.h"
#include "Support/TemporaryFolder.h"

namespace myotet::levelset {
namespace {

/// Two balls, each a component in a box of its own; lattices in step.
LevelSet ball(const Vec3& centre) {
    Box box = support::cube(8);
    box.min += centre;
    box.max += centre;
    LevelSet phi =
        support::sample_level_set(box, 0.5, [&](const Vec3& p) { return (p - centre).norm() - 5; });
    phi.band = 1.5;
    return phi;
}

openvdb::FloatGrid::Ptr read_back(const std::filesystem::path& file) {
    openvdb::initialize();
    openvdb::io::File in(file.string());
    in.open(false);
    return openvdb::gridPtrCast<openvdb::FloatGrid>(in.readGrid("biceps"));
}

TEST(WriteVdb, SaysDistanceAtEveryPlaceOfThePatient) {
    const testing::TemporaryFolder folder;
    const LevelSet one = ball({0, 0, 0}), two = ball({13, 0, 0});
    const std::vector<const LevelSet*> both = {&one, &two};
    Frame frame;
    frame.rotation = Eigen::AngleAxisd(0.5, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    frame.origin = {10, -20, 300};
    write_vdb(both, {7, "biceps", frame}, folder / "a.vdb");

    const auto grid = read_back(folder / "a.vdb");
    EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
    EXPECT_EQ(grid->metaValue<std::int32_t>("label"), 7);
    EXPECT_EQ(grid->metaValue<std::string>("SPACE"), "LPS");
    const auto value_at = [&](const Vec3& local) {
        const Vec3 p = frame.to_lps(local);
        const auto at = grid->worldToIndex({p.x(), p.y(), p.z()});
        EXPECT_NEAR(at.x(), std::round(at.x()), 1e-4) << "samples lie where ours lie";
        return double(grid->tree().getValue(openvdb::Coord::round(at)));
    };
    for (const Vec3& p : {Vec3(5, 0, 0), Vec3(4, 2, 1), Vec3(13, 5, 1), Vec3(0, -6, 0)})
        EXPECT_NEAR(value_at(p), std::min(one.value(p), two.value(p)), 1e-5);
    EXPECT_NEAR(value_at({0, 0, 0}), -1.5, 1e-6) << "inside beyond the band";
    EXPECT_NEAR(value_at({13, 0, 0}), -1.5, 1e-6);
    EXPECT_NEAR(value_at({6.5, 7, 0}), 1.5, 1e-6) << "outside beyond the band";
}

TEST(WriteVdb, SameArgumentsSameBytes) {
    const testing::TemporaryFolder folder;
    const LevelSet phi = ball({0, 0, 0});
    const std::vector<const LevelSet*> one = {&phi};
    for (const char* name : {"a.vdb", "b.vdb"}) write_vdb(one, {7, "biceps", {}}, folder / name);
    const auto bytes = [&](const char* name) {
        std::ifstream in(folder / name, std::ios::binary);
        return std::string((std::istreambuf_iterator<char>(in)), {});
    };
    EXPECT_GT(bytes("a.vdb").size(), 1000u);
    EXPECT_EQ(bytes("a.vdb"), bytes("b.vdb"));
}

TEST(WriteVdb, LatticesOutOfStepAndFoldersThatAreAbsentAreErrors) {
    const testing::TemporaryFolder folder;
    const LevelSet one = ball({0, 0, 0}), two = ball({13.2, 0, 0});
    const std::vector<const LevelSet*> both = {&one, &two}, alone = {&one};
    EXPECT_THROW(write_vdb(both, {7, "biceps", {}}, folder / "a.vdb"), MeshError);
    EXPECT_THROW(write_vdb(alone, {7, "biceps", {}}, folder / "no/such/a.vdb"), IoError);
}

}  // namespace
}  // namespace myotet::levelset
