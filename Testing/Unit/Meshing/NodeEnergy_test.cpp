// SPDX-License-Identifier: Apache-2.0
#include "Meshing/NodeEnergy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace myotet;
using namespace myotet::meshing;

namespace {

// Central differences with step 1e-5 of a smooth function near 1: truncation
// 1e-10 times third derivatives, rounding 1e-16 / 1e-5.
constexpr double kStep = 1e-5, kGradientTolerance = 1e-6, kHessianTolerance = 1e-4;

StarEnergy ring() {
    // An octahedron's eight corners around the origin, somewhat skewed.
    const Vec3 x[3] = {{1, 0.1, 0}, {-0.2, 1.1, 0.1}, {0.1, 0, 0.8}};
    StarEnergy star;
    star.reset(8);
    for (int s = 0; s < 8; ++s) {
        Vec3 p = s & 1 ? Vec3(-x[0]) : x[0], q = s & 2 ? Vec3(-x[1]) : x[1],
             r = s & 4 ? Vec3(-x[2]) : x[2];
        if ((q - p).cross(r - p).dot(-p) < 0) std::swap(q, r);
        star.add(p, q, r);
    }
    return star;
}

}  // namespace

TEST(StarEnergy, IsOneForARegularTetrahedronAtAnyExponentAndScale) {
    StarEnergy star;
    star.reset(1);
    const double a = std::sqrt(0.5);
    Vec3 p(a, a, 0), q(0, a, a), r(a, 0, a);
    if ((q - p).cross(r - p).dot(-p) < 0) std::swap(q, r);
    for (const double scale : {0.1, 1.0, 7.0}) {
        star.reset(1);
        star.add(scale * p, scale * q, scale * r);
        for (const int m : {1, 2, 4, 8}) EXPECT_NEAR(star.value(Vec3::Zero(), m), 1, 1e-12);
    }
    EXPECT_NEAR(shape_energy(Vec3::Zero(), p, r, q), 1, 1e-12);
}

TEST(StarEnergy, DerivativesAreThoseOfTheValue) {
    StarEnergy star = ring();
    const Vec3 x(0.07, -0.05, 0.04);
    for (const int m : {1, 2, 4, 8}) {
        const Expansion e = star.expand(x, m);
        EXPECT_NEAR(e.value, star.value(x, m), 1e-12 * e.value);
        for (int i = 0; i < 3; ++i) {
            const Vec3 d = kStep * Vec3::Unit(i);
            const double slope = (star.value(x + d, m) - star.value(x - d, m)) / (2 * kStep);
            EXPECT_NEAR(e.gradient[i], slope, kGradientTolerance * e.value) << "m = " << m;
            const Vec3 column =
                (star.expand(x + d, m).gradient - star.expand(x - d, m).gradient) / (2 * kStep);
            for (int j = 0; j < 3; ++j)
                EXPECT_NEAR(e.hessian(j, i), column[j], kHessianTolerance * e.value);
        }
    }
}

TEST(StarEnergy, IsConvexInTheNode) {
    StarEnergy star = ring();
    for (const double t : {0.0, 0.1, 0.25})
        for (const int m : {1, 2, 8}) {
            const Mat3 h = star.expand(Vec3(t, -0.5 * t, 0.3 * t), m).hessian;
            EXPECT_GT(h.determinant(), 0);
            EXPECT_GT(h(0, 0), 0);
            const double minor = h.topLeftCorner<2, 2>().determinant();
            EXPECT_GT(minor, 0);
        }
}

TEST(StarEnergy, IsInfiniteWhereAVolumeIsNotPositive) {
    StarEnergy star = ring();
    EXPECT_EQ(star.value({5, 0, 0}, 1), std::numeric_limits<double>::infinity());
    EXPECT_EQ(star.expand({5, 0, 0}, 1).value, std::numeric_limits<double>::infinity());
    EXPECT_EQ(star.value({std::nan(""), 0, 0}, 1), std::numeric_limits<double>::infinity());
    EXPECT_EQ(shape_energy({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}),
              std::numeric_limits<double>::infinity());
}
