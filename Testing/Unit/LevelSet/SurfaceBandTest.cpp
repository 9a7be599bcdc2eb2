// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "LevelSet/SurfaceBand.h"
#include "SurfaceShapes.h"

namespace myotet::levelset {
namespace {

constexpr double kWidth = 2;

/// A box from `low` to `high`, its triangles outward.
TriMesh box_surface(const Vec3& low, const Vec3& high) {
    TriMesh box;
    for (int n = 0; n < 8; ++n)
        box.points.push_back(
            {n & 1 ? high.x() : low.x(), n & 2 ? high.y() : low.y(), n & 4 ? high.z() : low.z()});
    box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return box;
}

double distance_to_box(const Vec3& p, const Vec3& low, const Vec3& high) {
    const Vec3 q = (p - 0.5 * (low + high)).cwiseAbs() - 0.5 * (high - low);
    return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

/// Calls take(position, value) for every stored sample.
template <class Take>
void each_sample(const Band& band, Take&& take) {
    ASSERT_FALSE(band.position.empty());
    constexpr int n = Band::kSide;
    for (std::size_t b = 0; b < band.position.size(); ++b)
        for (int at = 0; at < Band::kSize; ++at) {
            const Index3& p = band.position[b];
            take(band.origin + band.spacing * Vec3(p[0] * n + at % n, p[1] * n + at / n % n,
                                                   p[2] * n + at / (n * n)),
                 band.block(static_cast<std::int32_t>(b))[at]);
        }
}

Band band_of(const TriMesh& surface, double spacing) {
    SilentProgress quiet;
    return surface_band(surface, spacing, kWidth, quiet);
}

}  // namespace

// Large and small triangles; faces on samples and between them.
TEST(SurfaceBand, HoldsTheExactDistancesOfABox) {
    const Vec3 low(1, 2, 3), high(31, 14, 9);
    for (const double spacing : {0.5, 0.37, 3.0}) {
        const Band band = band_of(box_surface(low, high), spacing);
        int inside = 0;
        each_sample(band, [&](const Vec3& p, float value) {
            const double d = distance_to_box(p, low, high);
            const double clamped = std::clamp(d, -kWidth * spacing, kWidth * spacing);
            EXPECT_NEAR(value, clamped, 1e-5 * spacing);  // floats
            inside += value < 0;
        });
        EXPECT_GT(inside, 0);
        const Index3 middle{band.blocks[0] / 2, band.blocks[1] / 2, band.blocks[2] / 2};
        const std::int32_t home = band.find(middle);
        if (home < 0) {
            EXPECT_EQ(home, Band::kInside);
        }
        EXPECT_EQ(band.find({0, 0, 0}), Band::kOutside);
    }
}

TEST(SurfaceBand, IsTheSameForASurfaceInsideOut) {
    const TriMesh box = box_surface(Vec3(0, 0, 0), Vec3(10, 11, 12));
    TriMesh turned = box;
    for (Triangle& t : turned.triangles) std::swap(t[0], t[1]);
    const Band a = band_of(box, 0.7), b = band_of(turned, 0.7);
    EXPECT_EQ(a.block_of, b.block_of);
    ASSERT_EQ(a.values.size(), b.values.size());
    for (std::size_t n = 0; n < a.values.size(); ++n)
        ASSERT_NEAR(a.values[n], b.values[n], 1e-5 * 0.7);  // sums in another order
}

TEST(SurfaceBand, TakesCrossingBoxesAsTheirUnion) {
    TriMesh both = box_surface(Vec3(0, 0, 0), Vec3(10, 10, 10));
    const TriMesh other = box_surface(Vec3(5, 5, 5), Vec3(15, 15, 15));
    for (Triangle t : other.triangles) {
        for (std::int32_t& v : t) v += 8;
        both.triangles.push_back(t);
    }
    both.points.insert(both.points.end(), other.points.begin(), other.points.end());
    each_sample(band_of(both, 0.8), [&](const Vec3& p, float value) {
        const double a = distance_to_box(p, Vec3(0, 0, 0), Vec3(10, 10, 10));
        const double b = distance_to_box(p, Vec3(5, 5, 5), Vec3(15, 15, 15));
        if (std::abs(std::min(a, b)) > 1e-6)  // a sample on the surface has either side
            EXPECT_EQ(value < 0, std::min(a, b) < 0) << p.transpose();
    });
}

// A wall with no sample in it lets nothing through.
TEST(SurfaceBand, KeepsAHollowBehindAThinWall) {
    TriMesh shell = box_surface(Vec3(0.05, 0.05, 0.05), Vec3(20.05, 20.05, 20.05));
    const TriMesh hollow = box_surface(Vec3(0.15, 0.15, 0.15), Vec3(19.95, 19.95, 19.95));
    for (Triangle t : hollow.triangles) {
        for (std::int32_t& v : t) v += 8;
        shell.triangles.push_back({t[0], t[2], t[1]});
    }
    shell.points.insert(shell.points.end(), hollow.points.begin(), hollow.points.end());
    each_sample(band_of(shell, 1), [&](const Vec3& p, float value) {
        const double d = distance_to_box(p, Vec3::Constant(0.05), Vec3::Constant(20.05));
        if (std::abs(d) > 1e-6) EXPECT_EQ(value < 0, d < 0) << p.transpose();
    });
}

}  // namespace myotet::levelset
