// SPDX-License-Identifier: Apache-2.0
// Signs without rounding: checked against whole numbers, where they are easy.
#include "Cage/Predicates.h"

#include <gtest/gtest.h>

#include <random>

namespace myotet::cage {
namespace {

using Whole = __int128;

Whole determinant(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    std::array<std::array<Whole, 3>, 3> m;
    for (int i = 0; i < 3; ++i)
        m[i] = {static_cast<Whole>(b[i] - a[i]), static_cast<Whole>(c[i] - a[i]),
                static_cast<Whole>(d[i] - a[i])};
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

int sign(Whole w) { return w > 0 ? 1 : w < 0 ? -1 : 0; }

// Points nearly or exactly in a plane: a and two directions, with a little noise, in whole
// numbers below 2^38, whose determinants reach 2^116 and so are far beyond a double's digits.
TEST(Predicates, OrientationAgreesWithWholeNumbersNearAPlane) {
    std::mt19937_64 random(7);
    const auto whole = [&](std::int64_t most) {
        return static_cast<double>(static_cast<std::int64_t>(random() % (2 * most + 1)) - most);
    };
    const auto vector = [&](std::int64_t most) {
        return Vec3(whole(most), whole(most), whole(most));
    };
    int flat_ones = 0;
    for (int k = 0; k < 20000; ++k) {
        const Vec3 a = vector(1ll << 36), u = vector(1ll << 30), v = vector(1ll << 30);
        const Vec3 d = a + whole(8) * u + whole(8) * v + vector(k % 3);
        const Whole exact = determinant(a, a + u, a + v, d);
        flat_ones += exact == 0;
        ASSERT_EQ(orient3d(a, a + u, a + v, d), sign(exact));
        ASSERT_EQ(orient3d(d, a + v, a + u, a), sign(determinant(d, a + v, a + u, a)));
    }
    EXPECT_GT(flat_ones, 6000);
}

TEST(Predicates, SwappingTwoPointsTurnsTheSign) {
    std::mt19937_64 random(8);
    const auto part = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    for (int k = 0; k < 2000; ++k) {
        // Four points in a plane up to rounding: no signs but exact ones are antisymmetric.
        const Vec3 a(part(), part(), part()), b(part(), part(), part()), c(part(), part(), part());
        const Vec3 d = a + part() * (b - a) + part() * (c - a);
        const int s = orient3d(a, b, c, d);
        EXPECT_EQ(orient3d(b, a, c, d), -s);
        EXPECT_EQ(orient3d(a, c, b, d), -s);
        EXPECT_EQ(orient3d(a, b, d, c), -s);
        EXPECT_EQ(orient3d(b, c, a, d), s);
    }
}

TEST(Predicates, ATouchAtACornerAnEdgeAndAFaceIsAMeeting) {
    const Corners3 t{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
    const double up = 0x1p-60;
    for (const Vec3& at : {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(1, 1, 0)}) {
        EXPECT_TRUE(segment_meets(at, at + Vec3(0, 0, 1), t));
        EXPECT_TRUE(segment_meets(at - Vec3(0, 0, 1), at, t));
        EXPECT_FALSE(segment_meets(at + Vec3(0, 0, up), at + Vec3(0, 0, 1), t));
        EXPECT_TRUE(triangles_meet(t, {at, at + Vec3(1, 0, 1), at + Vec3(0, 1, 1)}));
        EXPECT_FALSE(
            triangles_meet(t, {at + Vec3(0, 0, up), at + Vec3(1, 0, 1), at + Vec3(0, 1, 1)}));
    }
}

TEST(Predicates, TrianglesInOnePlane) {
    const Corners3 t{Vec3(0, 0, 1), Vec3(4, 0, 1), Vec3(0, 4, 1)};
    const auto at = [](double x, double y) { return Vec3(x, y, 1); };
    EXPECT_TRUE(triangles_meet(t, {at(1, 1), at(1.5, 1), at(1, 1.5)})) << "inside";
    EXPECT_TRUE(triangles_meet(t, {at(-9, -9), at(30, -9), at(-9, 30)})) << "around";
    EXPECT_TRUE(triangles_meet(t, {at(2, 2), at(5, 5), at(5, 4)})) << "a corner on an edge";
    EXPECT_TRUE(triangles_meet(t, {at(4, 0), at(8, 0), at(8, 1)})) << "corner to corner";
    EXPECT_TRUE(triangles_meet(t, {at(1, 0), at(3, 0), at(2, -1)})) << "edge along edge";
    EXPECT_FALSE(triangles_meet(t, {at(4.5, 0), at(8, 0), at(8, 1)}));
    EXPECT_FALSE(triangles_meet(t, {at(2.5, 2), at(5, 5), at(5, 4)}));
}

TEST(Predicates, AFlatTriangleMeetsByItsEdges) {
    const Corners3 t{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
    const Corners3 needle{Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(1, 1, 3)};
    EXPECT_TRUE(flat(needle));
    EXPECT_FALSE(flat(t));
    EXPECT_TRUE(triangles_meet(t, needle));
    EXPECT_FALSE(triangles_meet(t, {Vec3(1, 1, 1), Vec3(1, 1, 2), Vec3(1, 1, 3)}));
}

TEST(Predicates, ATetrahedronMeetsWhatIsInsideAcrossAndAround) {
    const Corners4 tet{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0), Vec3(0, 0, 4)};
    EXPECT_TRUE(meets(tet, {Vec3(1, 1, 1), Vec3(1.1, 1, 1), Vec3(1, 1.1, 1)})) << "inside";
    EXPECT_TRUE(meets(tet, {Vec3(-9, 1, -9), Vec3(30, 1, -9), Vec3(-9, 1, 30)})) << "across";
    EXPECT_TRUE(meets(tet, {Vec3(-1, -1, 0), Vec3(0, 0, 0), Vec3(-1, 0, -1)})) << "a corner";
    EXPECT_FALSE(meets(tet, {Vec3(-1, -1, 0), Vec3(0, 0, -0x1p-50), Vec3(-1, 0, -1)}));
    EXPECT_FALSE(meets(tet, {Vec3(2, 2, 2), Vec3(3, 2, 2), Vec3(2, 3, 2)})) << "beyond a face";
    EXPECT_TRUE(holds(tet, Vec3(0, 0, 0)));
    EXPECT_TRUE(holds(tet, Vec3(1, 1, 2)));
    EXPECT_FALSE(holds(tet, Vec3(1, 1, 2 + 0x1p-51)));
}

TEST(Predicates, APassageIsCountedByItsSideAndDoubtedAtTheRim) {
    const Corners3 t{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
    bool doubtful = false;
    EXPECT_EQ(passes(Vec3(1, 1, 1), Vec3(1, 1, -1), t, doubtful), 1);
    EXPECT_EQ(passes(Vec3(1, 1, -1), Vec3(1, 1, 1), t, doubtful), -1);
    EXPECT_EQ(passes(Vec3(5, 1, -1), Vec3(5, 1, 1), t, doubtful), 0);
    EXPECT_FALSE(doubtful);
    EXPECT_EQ(passes(Vec3(2, 2, -1), Vec3(2, 2, 1), t, doubtful), 0);
    EXPECT_TRUE(doubtful);
}

}  // namespace
}  // namespace myotet::cage
