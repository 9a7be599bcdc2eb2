// SPDX-License-Identifier: Apache-2.0
// What [Stuart13, tables 1 and 2] report, asked of cages of our own, and what a try costs.
#include <gtest/gtest.h>

#include <cstdio>
#include <ctime>
#include <filesystem>

#include "Cage/Cage.h"
#include "Core/Parallel.h"
#include "MeshFiles/MeshFiles.h"

using namespace myotet;
using namespace myotet::cage;

namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

class CageFigures : public ::testing::Test {
protected:
    static TriMesh load(const std::string& name) {
        const std::filesystem::path file =
            std::filesystem::path(MYOTET_SHARED_DIR) / "data" / "bench_surfaces" / name;
        return std::filesystem::exists(file) ? meshfiles::read_surface(file) : TriMesh{};
    }
    static Cage make(const TriMesh& surface, const Options& options, double* seconds = nullptr) {
        SilentProgress silent;
        const double start = processor_seconds();
        Cage cage = make_cage(surface, options, silent);
        const double took = processor_seconds() - start;
        if (seconds != nullptr) *seconds = took;
        const Measures& m = cage.measures;
        std::printf("| %lld | %.1f | %.1f | %.2f | %.4f | %.4f | %.3f | %.2f |\n",
                    static_cast<long long>(m.tets), m.min_dihedral_deg, m.max_dihedral_deg,
                    m.max_aspect_ratio, m.distance_mean, m.distance_max, m.volume_ratio, took);
        EXPECT_TRUE(cage.reached());
        EXPECT_TRUE(cage.enclosure.enclosed()) << cage.enclosure.where;
        EXPECT_LE(m.distance_max, cage.offset);
        EXPECT_TRUE(m.boundary_manifold);
        return cage;
    }
};

struct Asked {
    double ratio, least, most;
};
constexpr Asked kAsked[] = {{0.2, 24, 145}, {0.4, 30, 138}, {0.6, 36, 128}, {0.8, 45, 115}};
// The largest angle that goes with the smallest is within what is asked with a degree more.
constexpr double kSpare = 1;

// The surface that left most dashes in the paper's table 1, at its coarsest here.
TEST_F(CageFigures, TheDragonAtEveryRatio) {
    const TriMesh dragon = load("dragon.off");
    if (dragon.triangles.empty()) GTEST_SKIP() << "the surface is not here";
    for (const Asked& a : kAsked) {
        const Cage cage =
            make(dragon, {.cell = 0.135, .offset_ratio = a.ratio, .angle_deg = a.least + kSpare});
        EXPECT_GE(cage.measures.min_dihedral_deg, a.least) << a.ratio;
        EXPECT_LE(cage.measures.max_dihedral_deg, a.most) << a.ratio;
    }
}

// Table 2: about a thousand tetrahedra, the closest fit within limits of angles and aspect ratio.
struct Fit {
    const char* file;
    Options options;
    double volume;
};
const Fit kFits[] = {
    {"bunny.off",
     {.tets = 1080, .offset_ratio = 0.5, .angle_deg = 30, .max_angle_deg = 125, .tries = 2},
     1.25},
    {"dragon.off",
     {.tets = 1080,
      .offset_ratio = 0.5,
      .angle_deg = 30,
      .max_angle_deg = 125,
      .tries = 8,
      .seed = 2},
     1.6}};

TEST_F(CageFigures, AThousandTetrahedraFitClosely) {
    for (const Fit& fit : kFits) {
        const TriMesh surface = load(fit.file);
        if (surface.triangles.empty()) GTEST_SKIP() << "the surface is not here";
        const Measures m = make(surface, fit.options).measures;
        EXPECT_GE(m.tets, 950) << fit.file;
        EXPECT_LE(m.tets, 1100) << fit.file;
        EXPECT_GE(m.min_dihedral_deg, 30) << fit.file;
        EXPECT_LE(m.max_dihedral_deg, 125) << fit.file;
        EXPECT_LE(m.max_aspect_ratio, 3.5) << fit.file;
        EXPECT_LE(m.volume_ratio, fit.volume) << fit.file;
    }
}

TEST_F(CageFigures, OneTryOnTheDragonTakesUnderFiveSeconds) {
    const TriMesh dragon = load("dragon.off");
    if (dragon.triangles.empty()) GTEST_SKIP() << "the surface is not here";
    const ThreadLimit limit(1);
    double seconds = 0;
    (void)make(dragon, {.tets = 1000}, &seconds);
    EXPECT_LT(seconds, 5);
}

}  // namespace
