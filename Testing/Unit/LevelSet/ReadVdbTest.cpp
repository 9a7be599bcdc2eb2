// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <fstream>
#include <functional>

#include "Core/Errors.h"
#include "Core/Progress.h"
#include "LevelSet/Extract.h"
#include "LevelSet/FromSurface.h"
#include "LevelSet/Measure.h"
#include "LevelSet/ReadVdb.h"
#include "LevelSet/WriteVdb.h"
#include "Support/TemporaryFolder.h"

namespace myotet::levelset {
namespace {

using openvdb::FloatGrid;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

// Positions pass through 64-bit transforms, values are copied.
constexpr double kCopied = 1e-6;  // mm
// Of a value that is interpolated between far samples, computed twice.
constexpr double kFar = 0.1;  // of it
constexpr double kRadius = 6, kVoxel = 0.5;

/// A ball as OpenVDB makes it, `half_width` voxels to either side.
FloatGrid::Ptr ball(const openvdb::Vec3f& centre = {1, 2, 3}, float half_width = 3) {
    return openvdb::tools::createLevelSetSphere<FloatGrid>(kRadius, centre, kVoxel, half_width);
}

class ReadVdb : public ::testing::Test {
protected:
    void SetUp() override { openvdb::initialize(); }
    fs::path save(const openvdb::GridPtrVec& grids) const {
        openvdb::io::File(file().string()).write(grids);
        return file();
    }
    /// The only level set of a file with this grid.
    [[nodiscard]] VdbLevelSet read(const FloatGrid::Ptr& grid) const {
        VdbFile made = read_vdb(save({grid}));
        EXPECT_EQ(made.level_sets.size(), 1u);
        EXPECT_TRUE(made.warnings.empty());
        return std::move(made.level_sets.front());
    }
    template <class Refusal = InputError>
    void expect_refused(const openvdb::GridPtrVec& grids, const char* word) const {
        save(grids);
        try {
            (void)read_vdb(file());
            ADD_FAILURE() << word;
        } catch (const Refusal& error) {
            EXPECT_THAT(error.what(), HasSubstr(word));
            EXPECT_THAT(error.what(), HasSubstr(file().string())) << "says where";
        }
    }
    [[nodiscard]] fs::path file() const { return folder_ / "a.vdb"; }
    testing::TemporaryFolder folder_;
};

/// Near the surface to `off` mm; elsewhere as far fields are, to a tenth.
void expect_ball(const VdbLevelSet& set, const Vec3& centre, double radius, double off) {
    EXPECT_LT(set.phi.value(set.frame.to_local(centre)), -0.5 * radius);
    for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(1, 2, -2)})
        for (const double r : {0.5, 0.9, 1.0, 1.1, 1.5}) {
            const Vec3 p = centre + r * radius * way.normalized();
            const double distance = (r - 1) * radius;
            EXPECT_NEAR(set.phi.value(set.frame.to_local(p)), distance,
                        std::abs(r - 1) < 0.2 ? off : kFar * std::abs(distance))
                << r;
        }
}

TEST_F(ReadVdb, WhatWriteVdbWroteComesBackSampleBySample) {
    SilentProgress quiet;
    const TriMesh sphere = extract_surface(read(ball()).phi);
    const LevelSet phi = from_surface(sphere, {.spacing = 0.4}, quiet);
    Frame frame;
    frame.rotation = Eigen::AngleAxisd(0.5, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    frame.origin = {10, -20, 300};
    const std::vector<const LevelSet*> one = {&phi};
    write_vdb(one, {7, "biceps", frame}, file());

    const VdbFile made = read_vdb(file());
    ASSERT_EQ(made.level_sets.size(), 1u);
    EXPECT_EQ(made.unit, "mm");
    const VdbLevelSet& back = made.level_sets.front();
    EXPECT_EQ(back.label, 7);
    EXPECT_EQ(back.name, "biceps");
    EXPECT_NEAR(back.phi.spacing, phi.spacing, kCopied);
    std::size_t near = 0;
    for (const Vec3& p : sphere.points)
        for (const double step : {-0.9, 0.0, 0.3, 0.9}) {
            const Vec3 q = p + step * (p - Vec3(1, 2, 3)).normalized();
            EXPECT_NEAR(back.phi.value(back.frame.to_local(frame.to_lps(q))), phi.value(q),
                        kCopied);
            ++near;
        }
    EXPECT_GT(near, 1000u);
    for (const Vec3& p : {Vec3(1, 2, 3), Vec3(0, 0, 3), Vec3(1, 12, 3), Vec3(30, 2, 3)}) {
        const double was = phi.value(p);
        EXPECT_NEAR(back.phi.value(back.frame.to_local(frame.to_lps(p))), was,
                    kFar * std::abs(was));
    }
    EXPECT_NEAR(enclosed_volume(back.phi) / enclosed_volume(phi), 1, kCopied);
}

TEST_F(ReadVdb, ALevelSetOfAnotherProgramNeedsNoMetadata) {
    const FloatGrid::Ptr grid = ball();
    const VdbLevelSet set = read(grid);
    EXPECT_EQ(set.label, 1);
    EXPECT_EQ(set.name, "a") << "the file's";
    expect_ball(set, {1, 2, 3}, kRadius, 0.02);
}

TEST_F(ReadVdb, NarrowBandsAreMadeWiderAndWideOnesNarrower) {
    for (const float half_width : {1.1f, 1.5f, 2.0f, 3.0f, 8.0f}) {
        const VdbLevelSet set = read(ball({1, 2, 3}, half_width));
        EXPECT_GE(set.phi.band, 3 * kVoxel * (1 - kCopied)) << half_width;
        EXPECT_LE(set.phi.band, 4 * kVoxel * (1 + kCopied)) << half_width;
        expect_ball(set, {1, 2, 3}, kRadius, 0.03);
    }
}

TEST_F(ReadVdb, FrameAndUnitAreTheFilesOwn) {
    const FloatGrid::Ptr grid = ball();
    grid->insertMeta("units", openvdb::StringMetadata("cm"));
    grid->insertMeta("SPACE", openvdb::StringMetadata("RAS"));
    expect_ball(read(grid), {-10, -20, 30}, 10 * kRadius, 0.2);
    EXPECT_THROW((void)read_vdb(file(), "m"), InputError) << "the file says cm";
    grid->removeMeta("units");
    save({grid});
    const VdbFile metres = read_vdb(file(), "m");
    EXPECT_EQ(metres.unit, "m");
    expect_ball(metres.level_sets.front(), {-1000, -2000, 3000}, 1000 * kRadius, 20);
}

TEST_F(ReadVdb, MirroredAxesAreTurned) {
    const FloatGrid::Ptr grid = ball();
    openvdb::math::Mat4d m = openvdb::math::Mat4d::identity();
    m(0, 0) = -kVoxel;
    m(1, 2) = m(2, 1) = kVoxel;  // two axes change places as well
    m(1, 1) = m(2, 2) = 0;
    grid->setTransform(openvdb::math::Transform::createLinearTransform(m));
    expect_ball(read(grid), {-1, 3, 2}, kRadius, 0.02);
    m(1, 2) = -kVoxel;
    grid->setTransform(openvdb::math::Transform::createLinearTransform(m));
    const VdbLevelSet set = read(grid);
    expect_ball(set, {-1, 3, -2}, kRadius, 0.02);
    EXPECT_NEAR(set.frame.rotation.determinant(), 1, kCopied);
}

TEST_F(ReadVdb, AllLevelSetsOfAFileAreReadAndOthersNamed) {
    const FloatGrid::Ptr one = ball(), two = ball({20, 2, 3}), three = ball({40, 2, 3});
    one->setName("bone");
    two->setName("muscle");
    two->insertMeta("label", openvdb::Int32Metadata(1));
    three->setName("tendon");
    const FloatGrid::Ptr fog = FloatGrid::create();
    fog->setName("density");
    fog->setGridClass(openvdb::GRID_FOG_VOLUME);
    save({one, two, fog, three});
    const VdbFile made = read_vdb(file());
    ASSERT_EQ(made.level_sets.size(), 3u);
    std::vector<std::string> names;
    std::vector<std::int32_t> labels;
    for (const VdbLevelSet& set : made.level_sets) {
        names.push_back(set.name);
        labels.push_back(set.label);
    }
    EXPECT_THAT(names, ::testing::ElementsAre("bone", "muscle", "tendon"));
    EXPECT_THAT(labels, ::testing::ElementsAre(2, 1, 3)) << "what is said stays";
    ASSERT_EQ(made.warnings.size(), 1u);
    EXPECT_THAT(made.warnings[0], HasSubstr("'density': is left out"));
    three->insertMeta("label", openvdb::Int32Metadata(1));
    expect_refused({one, two, three}, "its label, 1, is that of another");
}

TEST_F(ReadVdb, WhatIsNoLevelSetIsRefused) {
    expect_refused({}, "holds no grid");
    const FloatGrid::Ptr fog = ball();
    fog->setGridClass(openvdb::GRID_FOG_VOLUME);
    expect_refused({fog}, "no level set");
    expect_refused({openvdb::Vec3SGrid::create()}, "Tree_vec3s_5_4_3");
    const FloatGrid::Ptr empty = FloatGrid::create(1.0f);
    empty->setGridClass(openvdb::GRID_LEVEL_SET);
    expect_refused({empty}, "has no samples");
    const FloatGrid::Ptr all_inside = FloatGrid::create(3.0f);
    all_inside->setGridClass(openvdb::GRID_LEVEL_SET);
    all_inside->fill({{0, 0, 0}, {7, 7, 7}}, 2.0f);
    all_inside->tree().voxelizeActiveTiles();
    expect_refused({all_inside}, "has no surface");
}

TEST_F(ReadVdb, VoxelsMustBeCubes) {
    const FloatGrid::Ptr grid = ball();
    grid->transform().preScale({1, 1, 2});
    expect_refused({grid}, "no cubes (sides of 0.5, 0.5 and 1 mm");
    grid->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd({0, 0, 0}, {9, 9, 9}), 0.5, 10, kVoxel));
    expect_refused({grid}, "frustum");
    openvdb::math::Mat4d m = openvdb::math::Mat4d::identity();
    m(0, 1) = 0.3;
    grid->setTransform(openvdb::math::Transform::createLinearTransform(m));
    expect_refused({grid}, "sheared");
}

TEST_F(ReadVdb, ValuesMustBeDistancesThatCloseASurface) {
    const FloatGrid::Ptr inverted = ball();
    inverted->tree().root().setBackground(-1.5f, false);
    expect_refused({inverted}, "background");
    const FloatGrid::Ptr in_voxels = ball();
    in_voxels->setTransform(openvdb::math::Transform::createLinearTransform(kVoxel / 2));
    expect_refused({in_voxels}, "no distances");
    const FloatGrid::Ptr not_a_number = ball();
    not_a_number->tree().setValue({14, 4, 6}, std::numeric_limits<float>::quiet_NaN());
    expect_refused({not_a_number}, "(14, 4, 6) is no finite number");
    const FloatGrid::Ptr half = FloatGrid::create(3.0f);  // a piece of a plane
    half->setGridClass(openvdb::GRID_LEVEL_SET);
    for (const openvdb::Coord& at : openvdb::CoordBBox({0, 0, -2}, {15, 15, 2}))
        half->tree().setValue(at, static_cast<float>(at.z()) + 0.5f);
    expect_refused({half}, "inside and outside meet");
    const FloatGrid::Ptr without_signs = ball();
    for (auto leaf = without_signs->tree().beginLeaf(); leaf; ++leaf)
        for (auto value = leaf->beginValueOff(); value; ++value)
            value.setValue(without_signs->background());
    expect_refused({without_signs}, "inside and outside meet");
    const FloatGrid::Ptr unit = ball();
    unit->insertMeta("units", openvdb::StringMetadata("inch"));
    expect_refused({unit}, "'inch'");
    const FloatGrid::Ptr far = ball();
    far->tree().setValue({1000000, 1000000, 1000000}, 1.0f);
    expect_refused<ResourceError>({far}, "GB");
}

TEST_F(ReadVdb, DamagedFilesAreErrorsThatNameTheFile) {
    EXPECT_THROW((void)read_vdb(folder_ / "absent.vdb"), IoError);
    const FloatGrid::Ptr grid = ball();
    const std::string whole = [&] {
        std::ifstream in(save({grid}), std::ios::binary);
        return std::string((std::istreambuf_iterator<char>(in)), {});
    }();
    const auto write = [&](const std::string& bytes) {
        std::ofstream(file(), std::ios::binary) << bytes;
    };
    for (const std::size_t length : {std::size_t{0}, std::size_t{7}, std::size_t{60},
                                     std::size_t{300}, whole.size() / 2, whole.size() - 1}) {
        write(whole.substr(0, length));
        try {
            (void)read_vdb(file());
            ADD_FAILURE() << length;
        } catch (const IoError& error) {
            EXPECT_THAT(error.what(), HasSubstr("a.vdb: is no OpenVDB file, or damaged"));
        }
    }
    // A byte that is another may do no harm; else it is one of our errors.
    for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 150) {
        std::string other = whole;
        other[at] = static_cast<char>(other[at] ^ 0x55);
        write(other);
        try {
            (void)read_vdb(file());
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr(file().string())) << at;
        }
    }
}

}  // namespace
}  // namespace myotet::levelset
