// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "LevelSet/CutEdges.h"

namespace myotet::levelset {
namespace {

constexpr int kSamples = 7;
constexpr Index3 kFirst{0, 0, 0}, kLast{kSamples, kSamples, kSamples};

/// How often each lattice edge is cut.
using Cuts = std::map<std::pair<int, Index3>, int>;

void add(const std::array<Vec3, 3>& corners, Cuts& cuts) {
    for_each_cut_edge(snap(corners), kFirst, kLast, [&](int axis, const Index3& low) {
        ++cuts[{axis, low}];
    });
}

Cuts cuts_of_tet(const std::array<Vec3, 4>& p) {
    Cuts cuts;
    add({p[0], p[2], p[1]}, cuts);
    add({p[0], p[1], p[3]}, cuts);
    add({p[1], p[2], p[3]}, cuts);
    add({p[2], p[0], p[3]}, cuts);
    return cuts;
}

int count(const Cuts& cuts, int axis, const Index3& low) {
    const auto found = cuts.find({axis, low});
    return found == cuts.end() ? 0 : found->second;
}

// Around a square of four lattice edges a closed surface is crossed an even number of
// times: only then do its cuts part an inside from an outside.
int odd_squares(const Cuts& cuts) {
    int odd = 0;
    for (int a = 0; a < 3; ++a)
        for (int k = 0; k < kSamples; ++k)
            for (int j = 0; j < kSamples; ++j)
                for (int i = 0; i < kSamples; ++i) {
                    const int u = (a + 1) % 3, v = (a + 2) % 3;
                    const Index3 at{i, j, k};
                    Index3 up = at, right = at;
                    ++right[u], ++up[v];
                    odd += (count(cuts, u, at) + count(cuts, v, right) + count(cuts, u, up) +
                            count(cuts, v, at)) %
                           2;
                }
    return odd;
}

TEST(CutEdges, OfClosedSurfacesPartTwoSidesEvenWhereCornersLieOnSamples) {
    std::mt19937 random(5);
    std::uniform_int_distribution<int> halves(1, 2 * kSamples - 1);
    int cut = 0;
    for (int n = 0; n < 500; ++n) {
        std::array<Vec3, 4> p;
        for (Vec3& corner : p) corner = 0.5 * Vec3(halves(random), halves(random), halves(random));
        const Cuts cuts = cuts_of_tet(p);
        cut += static_cast<int>(cuts.size());
        ASSERT_EQ(odd_squares(cuts), 0) << "tetrahedron " << n;
    }
    EXPECT_GT(cut, 5000);
}

TEST(CutEdges, OfClosedSurfacesPartTwoSidesAnywhere) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> place(0.1, kSamples - 0.1);
    for (int n = 0; n < 200; ++n) {
        std::array<Vec3, 4> p;
        for (Vec3& corner : p) corner = Vec3(place(random), place(random), place(random));
        ASSERT_EQ(odd_squares(cuts_of_tet(p)), 0) << "tetrahedron " << n;
    }
}

// The plane x + y + z = 8.5 over the positive octant, whose own edges move inwards.
const SnappedTriangle kSlope = snap({Vec3(8.5, 0, 0), Vec3(0, 8.5, 0), Vec3(0, 0, 8.5)});
bool slope_cuts(int axis, const Index3& low) {
    return low[0] + low[1] + low[2] == 8 && low[(axis + 1) % 3] > 0 && low[(axis + 2) % 3] > 0;
}

TEST(CutEdges, AreThoseThatATriangleMeets) {
    Cuts cuts;
    for_each_cut_edge(kSlope, kFirst, kLast, [&](int axis, const Index3& low) {
        ++cuts[{axis, low}];
    });
    for (int a = 0; a < 3; ++a)
        for (int k = 0; k <= kSamples; ++k)
            for (int j = 0; j <= kSamples; ++j)
                for (int i = 0; i <= kSamples; ++i)
                    EXPECT_EQ(count(cuts, a, {i, j, k}), slope_cuts(a, {i, j, k}) ? 1 : 0);
}

TEST(CutEdges, OutsideTheBoxAreLeftOut) {
    const Index3 first{2, 1, 1}, last{3, 3, 7};
    int inside = 0, expected = 0;
    for_each_cut_edge(kSlope, first, last, [&](int axis, const Index3& low) {
        ++inside;
        EXPECT_TRUE(slope_cuts(axis, low));
        for (int a = 0; a < 3; ++a) EXPECT_TRUE(low[a] >= first[a] && low[a] <= last[a]);
    });
    for (int a = 0; a < 3; ++a)
        for (int k = first[2]; k <= last[2]; ++k)
            for (int j = first[1]; j <= last[1]; ++j)
                for (int i = first[0]; i <= last[0]; ++i) expected += slope_cuts(a, {i, j, k});
    EXPECT_EQ(inside, expected);
}

}  // namespace
}  // namespace myotet::levelset
