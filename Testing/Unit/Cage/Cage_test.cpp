// SPDX-License-Identifier: Apache-2.0
#include "Cage/Cage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>

#include "Cage/Embedding.h"
#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Support/CageShapes.h"

namespace myotet::cage {
namespace {

using namespace myotet::testing;
using ::testing::HasSubstr;

Cage cage_of(const TriMesh& surface, const Options& options) {
    SilentProgress silent;
    return make_cage(surface, options, silent);
}

void expect_promises(const Cage& cage, const TriMesh& surface) {
    EXPECT_TRUE(cage.reached());
    EXPECT_TRUE(prove_enclosure(cage.mesh, surface, SurfaceTree(surface)).enclosed());
    EXPECT_LE(cage.measures.distance_max, cage.offset);
    EXPECT_GT(cage.measures.distance_min, 0);
    EXPECT_GT(cage.measures.volume_ratio, 1);
    EXPECT_TRUE(cage.measures.boundary_manifold);
    EXPECT_NO_THROW((void)embed(cage.mesh, surface.points));
}

// What is asked of shapes at each ratio; phantoms of which the truth is simple.
struct Asked {
    double ratio, least, most;
};
constexpr Asked kAsked[] = {{0.2, 24, 145}, {0.4, 30, 138}, {0.6, 36, 128}, {0.8, 45, 115}};
// The largest angle that goes with the smallest is within what is asked with a degree more.
constexpr double kSpare = 1;

TEST(Cage, ABananaAtEveryRatio) {
    const TriMesh surface = banana();
    double volume_before = 1;
    for (const Asked& a : kAsked) {
        const Cage cage = cage_of(
            surface,
            {.cell = 8, .offset_ratio = a.ratio, .angle_deg = a.least + kSpare, .tries = 2});
        expect_promises(cage, surface);
        EXPECT_GE(cage.measures.min_dihedral_deg, a.least) << a.ratio;
        EXPECT_LE(cage.measures.max_dihedral_deg, a.most) << a.ratio;
        EXPECT_EQ(cage.measures.euler_characteristic, 2);
        EXPECT_EQ(cage.measures.components, 1);
        EXPECT_GT(cage.measures.volume_ratio, volume_before) << "farther off, more volume";
        volume_before = cage.measures.volume_ratio;
    }
}

TEST(Cage, ARingKeepsItsHole) {
    const TriMesh surface = ring(20, 6);
    const Cage cage = cage_of(surface, {.cell = 8, .offset_ratio = 0.4});
    expect_promises(cage, surface);
    EXPECT_EQ(cage.measures.euler_characteristic, 0);
}

TEST(Cage, TwoFarPartsAreEachEnclosed) {
    const TriMesh surface =
        together(banana(40, 20), moved(block(Vec3::Zero(), Vec3(14, 18, 16)), Vec3(80, 30, 10)));
    const Cage cage = cage_of(surface, {.cell = 8, .offset_ratio = 0.4});
    expect_promises(cage, surface);
    EXPECT_EQ(cage.measures.components, 2);
}

TEST(Cage, ASpeckBesideALargePartIsHeldAllTheWay) {
    const TriMesh surface = together(block(Vec3::Zero(), Vec3(40, 40, 20)),
                                     block(Vec3(20, 20, 20.4), Vec3(20.2, 20.2, 20.6)));
    for (const double ratio : {0.2, 0.6}) {
        const Cage cage = cage_of(surface, {.cell = 9, .offset_ratio = ratio});
        expect_promises(cage, surface);
    }
}

TEST(Cage, SharpEdgesAndFlatSidesInLineWithTheLattice) {
    const TriMesh surface = block(Vec3::Zero(), Vec3(32, 16, 16));
    const Cage cage = cage_of(surface, {.cell = 8, .offset_ratio = 0.4});
    expect_promises(cage, surface);
}

TEST(Cage, AboutAsManyTetrahedraAsAskedFor) {
    const TriMesh surface = banana();
    for (const std::int64_t tets : {300, 1000}) {
        const Cage cage = cage_of(surface, {.tets = tets, .offset_ratio = 0.6});
        EXPECT_NEAR(static_cast<double>(cage.measures.tets), static_cast<double>(tets),
                    0.1 * static_cast<double>(tets));
    }
}

TEST(Cage, AnAngleToBeContentWithBuysACloserFit) {
    const TriMesh surface = banana();
    const Cage best = cage_of(surface, {.cell = 8, .offset_ratio = 0.6, .angle_deg = 60});
    const Cage close = cage_of(surface, {.cell = 8, .offset_ratio = 0.6, .angle_deg = 30});
    expect_promises(close, surface);
    EXPECT_GE(close.measures.min_dihedral_deg, 30);
    EXPECT_LT(close.measures.volume_ratio, best.measures.volume_ratio - 0.1);
}

TEST(Cage, EachLimitIsHeldByItself) {
    const TriMesh surface = banana();
    const Options loose{.cell = 8, .offset_ratio = 0.6, .angle_deg = 25};
    Options flat = loose, slender = loose;
    flat.max_angle_deg = 115;
    slender.max_aspect_ratio = 2.6;
    const Cage by_all = cage_of(surface, loose), by_angle = cage_of(surface, flat),
               by_aspect = cage_of(surface, slender);
    for (const Cage* cage : {&by_all, &by_angle, &by_aspect}) {
        expect_promises(*cage, surface);
        EXPECT_GE(cage->measures.min_dihedral_deg, 25);
    }
    EXPECT_LE(by_all.measures.max_dihedral_deg, 180 - 25 / 0.7);
    EXPECT_LE(by_all.measures.max_aspect_ratio, 105.0 / 25);
    EXPECT_LE(by_angle.measures.max_dihedral_deg, 115);
    EXPECT_LE(by_aspect.measures.max_aspect_ratio, 2.6);
    EXPECT_LT(by_all.measures.volume_ratio, by_angle.measures.volume_ratio);
    EXPECT_LT(by_all.measures.volume_ratio, by_aspect.measures.volume_ratio);
}

TEST(Cage, MoreTriesAreNeverWorseAndSeedsMatter) {
    const TriMesh surface = banana(40, 20);
    const Cage one = cage_of(surface, {.cell = 9, .offset_ratio = 0.4});
    const Cage three = cage_of(surface, {.cell = 9, .offset_ratio = 0.4, .tries = 3});
    const Cage other = cage_of(surface, {.cell = 9, .offset_ratio = 0.4, .tries = 3, .seed = 2});
    ASSERT_EQ(three.tries.size(), 3u);
    EXPECT_EQ(three.tries[0].score_deg, one.tries[0].score_deg);
    const Try &first = one.tries[0], &best = three.tries[static_cast<std::size_t>(three.best)];
    if (first.score_deg >= Options{}.angle_deg) {
        EXPECT_GE(best.score_deg, Options{}.angle_deg);
        EXPECT_LE(best.volume, first.volume);
    } else {
        EXPECT_GE(best.score_deg, first.score_deg);
    }
    EXPECT_NE(three.tries[1].score_deg, other.tries[1].score_deg);
}

TEST(Cage, SameBytesOnAnyNumberOfThreads) {
    const TriMesh surface = banana(40, 20);
    const Options options{.cell = 9, .offset_ratio = 0.4, .tries = 3};
    std::vector<Vec3> points;
    for (const int threads : {1, 2}) {
        const ThreadLimit limit(threads);
        const Cage cage = cage_of(surface, options);
        if (threads == 1) points = cage.mesh.points;
        ASSERT_EQ(cage.mesh.points.size(), points.size());
        EXPECT_EQ(std::memcmp(cage.mesh.points.data(), points.data(), points.size() * sizeof(Vec3)),
                  0);
    }
}

TEST(Cage, AnOffsetThatNoLatticeReachesIsSaid) {
    const Cage cage = cage_of(banana(40, 20), {.cell = 20, .offset_ratio = 1e-4});
    EXPECT_FALSE(cage.reached());
    EXPECT_TRUE(cage.enclosure.enclosed()) << "what there is still encloses";
    EXPECT_GT(cage.measures.distance_max, cage.offset);
}

TEST(Cage, BadOptionsAreRefusedByName) {
    const TriMesh surface = banana(20, 8);
    const auto refused = [&](const Options& options, const std::string& words) {
        try {
            (void)cage_of(surface, options);
            ADD_FAILURE() << words;
        } catch (const InputError& e) {
            EXPECT_THAT(e.what(), HasSubstr(words));
        }
    };
    refused({.cell = 1000}, "longest side");
    refused({.cell = -1}, "cell");
    refused({.tets = 3}, "tets");
    refused({.cell = 8, .offset_ratio = 0}, "offset_ratio");
    refused({.cell = 8, .offset_ratio = std::nan("")}, "offset_ratio");
    refused({.cell = 8, .angle_deg = 70}, "angle_deg");
    refused({.cell = 8, .max_angle_deg = 80}, "max_angle_deg");
    refused({.cell = 8, .max_angle_deg = 180}, "max_angle_deg");
    refused({.cell = 8, .max_aspect_ratio = 1}, "max_aspect_ratio");
    refused({.cell = 8, .max_aspect_ratio = std::nan("")}, "max_aspect_ratio");
    refused({.cell = 8, .tries = 0}, "tries");
}

// Asks to stop after so many questions.
class StopAfter final : public ProgressSink {
public:
    explicit StopAfter(int tries) : tries_(tries) {}
    void report(std::string_view, double) override { ++done_; }
    void warn(std::string_view) override {}
    void note(std::string_view) override {}
    [[nodiscard]] bool interrupted() const override { return done_ >= tries_; }

private:
    int tries_;
    std::atomic<int> done_ = 0;
};

TEST(Cage, StoppedItGivesTheBestSoFar) {
    const ThreadLimit limit(1);
    StopAfter stop(2), at_once(0);
    const Options options{.cell = 9, .offset_ratio = 0.4, .tries = 50};
    const TriMesh surface = banana(40, 20);
    const Cage cage = make_cage(surface, options, stop);
    EXPECT_EQ(cage.tries.size(), 2u);
    EXPECT_EQ(cage.tries_asked, 50);
    expect_promises(cage, surface);
    EXPECT_THROW((void)make_cage(surface, options, at_once), Interrupted);
}

}  // namespace
}  // namespace myotet::cage
