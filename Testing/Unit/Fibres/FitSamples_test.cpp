// SPDX-License-Identifier: Apache-2.0
#include "Fibres/FitSamples.h"

#include <gtest/gtest.h>

#include "Core/Errors.h"
#include "SolidShapes.h"

namespace myotet::fibres {
namespace {

// Of 100 mm, through the normal equations, which square the condition.
constexpr double kExact = 1e-9;

std::vector<SolidSample> samples_of(const BSplineSolid& solid, int count) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> in(0, 1);
    std::vector<SolidSample> samples;
    for (int n = 0; n < count; ++n) {
        const Vec3 at(in(random), in(random), in(random));
        samples.push_back({at, evaluate(solid, at).position, 0.5 + in(random)});
    }
    return samples;
}

double furthest(const BSplineSolid& a, const BSplineSolid& b) {
    double most = 0;
    for (std::size_t n = 0; n < a.control.size(); ++n)
        most = std::max(most, (a.control[n] - b.control[n]).norm());
    return most;
}

TEST(FitSamples, FindsASolidFromItsOwnPoints) {
    for (const SolidShape& shape : test::some_shapes()) {
        const BSplineSolid solid = test::some_solid(shape);
        const BSplineSolid found = fit_samples(samples_of(solid, 4000), shape, 0);
        EXPECT_LT(furthest(found, solid), kExact);
    }
}

TEST(FitSamples, SmoothingCostsAStraightBlockNothing) {
    for (const SolidShape& shape : test::some_shapes()) {
        const BSplineSolid block = test::some_solid({{1, 1, 1}, {2, 2, 2}});
        BSplineSolid straight = block;
        // Parallel edges: linear in u, v and w.
        for (int corner = 0; corner < 8; ++corner)
            straight.control[corner] = Vec3(20 * (corner & 1) + 3.0 * (corner >> 2),
                                            30 * (corner >> 1 & 1), 100 * (corner >> 2));
        const std::vector<SolidSample> samples = samples_of(straight, 500);
        const BSplineSolid found = fit_samples(samples, shape, 10);
        for (const SolidSample& s : samples)
            EXPECT_LT((evaluate(found, s.uvw).position - s.point).norm(), kExact);
    }
}

TEST(FitSamples, SmoothingFillsInWhatSamplesLeaveOpen) {
    const SolidShape shape{{3, 3, 3}, {6, 6, 16}};
    const BSplineSolid solid = test::some_solid({{3, 3, 3}, {4, 4, 4}});
    const std::vector<SolidSample> few = samples_of(solid, 300);  // of 576 control points
    EXPECT_THROW((void)fit_samples(few, shape, 0), InputError);
    const BSplineSolid found = fit_samples(few, shape, 1e-4);
    constexpr double kBetween = 1.5;  // mm of 100
    for (const SolidSample& s : samples_of(solid, 1000))
        EXPECT_LT((evaluate(found, s.uvw).position - s.point).norm(), kBetween);
}

TEST(FitSamples, TurnsWithTheSamples) {
    const SolidShape shape{{3, 3, 3}, {5, 5, 8}};
    std::vector<SolidSample> samples = samples_of(test::some_solid(shape), 2000);
    const BSplineSolid straight = fit_samples(samples, shape, 0.01);
    const Mat3 R = test::some_rotation();
    for (SolidSample& s : samples) s.point = R * s.point + Vec3(5, 6, 7);
    BSplineSolid turned = fit_samples(samples, shape, 0.01);
    for (Vec3& p : turned.control) p = R.transpose() * (p - Vec3(5, 6, 7));
    EXPECT_LT(furthest(straight, turned), kExact);
}

TEST(FitSamples, RefusesWhatMakesNoSense) {
    const SolidShape shape{{1, 1, 1}, {2, 2, 2}};
    std::vector<SolidSample> samples = samples_of(test::some_solid(shape), 50);
    EXPECT_THROW((void)fit_samples(samples, shape, -1), InputError);
    EXPECT_THROW((void)fit_samples(samples, shape, std::nan("")), InputError);
    samples[3].uvw[1] = 1.01;
    EXPECT_THROW((void)fit_samples(samples, shape, 0), InputError);
    samples[3].uvw[1] = 1;
    samples[3].weight = -1;
    EXPECT_THROW((void)fit_samples(samples, shape, 0), InputError);
    samples[3].weight = 1;
    samples[3].point.x() = std::nan("");
    EXPECT_THROW((void)fit_samples(samples, shape, 0), InputError);
}

}  // namespace
}  // namespace myotet::fibres
