// SPDX-License-Identifier: Apache-2.0
// What a level set is worth against a surface whose distance is known.
#include <gtest/gtest.h>

#include "BandShapes.h"
#include "LabelShapes.h"
#include "LevelSet/Extract.h"
#include "LevelSet/FromLabels.h"
#include "LevelSet/Redistance.h"
#include "SurfaceShapes.h"

namespace myotet::levelset {
namespace {

SilentProgress silent;

const Vec3 kCentre(14.9, 15.1, 15.05);

double torus(const Vec3& p) {
    const Vec3 x = p - kCentre;
    return std::hypot(std::hypot(x.x(), x.y()) - 8, x.z()) - 4.5;
}
double sphere(const Vec3& p) { return (p - kCentre).norm() - 10; }

// Distances from a band three samples wide, carried to six.
LevelSet spread(const test::Field& field, double spacing) {
    const int blocks = static_cast<int>(std::ceil(30 / (Band::kSide * spacing)));
    Band band = refit(test::make_band(field, blocks, spacing), static_cast<float>(6 * spacing));
    redistance(band, Seeds::keep_cells, 1);
    return assemble(band);
}

struct Slopes {
    double worst = 0;  // largest | |grad phi| - 1 |
    double share = 0;  // of samples where that exceeds one percent
};

// By central differences over the samples within five of the surface.
Slopes slopes(const LevelSet& phi, const test::Field& field) {
    const double h = phi.spacing;
    Slopes out;
    int count = 0, steep = 0;
    for (int k = 1; k < 8 * phi.bricks[2]; ++k)
        for (int j = 1; j < 8 * phi.bricks[1]; ++j)
            for (int i = 1; i < 8 * phi.bricks[0]; ++i) {
                const Vec3 p = phi.origin + h * Vec3(i, j, k);
                if (!(std::abs(field(p)) <= 5 * h)) continue;
                Vec3 slope;
                for (int a = 0; a < 3; ++a)
                    slope[a] =
                        (phi.value(p + h * Vec3::Unit(a)) - phi.value(p - h * Vec3::Unit(a))) /
                        (2 * h);
                const double error = std::abs(slope.norm() - 1);
                out.worst = std::max(out.worst, error);
                ++count;
                steep += error > 0.01;
            }
    out.share = double(steep) / count;
    return out;
}

TEST(Accuracy, slopes_are_one_in_a_band_of_five_samples) {
    // Central differences of an exact distance err by (spacing / R)^2 / 3, R
    // being the smallest radius at the band's inner edge: 5 spacings less.
    constexpr double kTolerance = 0.01;
    EXPECT_LT(slopes(spread(sphere, 0.4), sphere).worst, kTolerance);
    // On the torus, of radius 18 and 13 spacings, single samples miss by more:
    // their nearest points slide along the interface once only.
    const Slopes bent = slopes(spread(torus, 0.25), torus);
    EXPECT_LT(bent.share, 0.01);
    EXPECT_LT(bent.worst, 0.03);
}

// Root mean square of phi on the true surface.
double error_on_sphere(double spacing) {
    const LevelSet phi = spread(sphere, spacing);
    double sum = 0;
    const auto directions = test::directions(2000);
    for (const Vec3& u : directions) sum += std::pow(phi.value(kCentre + 10 * u), 2);
    return std::sqrt(sum / static_cast<double>(directions.size()));
}

double error_on_torus(double spacing) {
    const LevelSet phi = spread(torus, spacing);
    double sum = 0;
    for (int i = 0; i < 60; ++i)
        for (int j = 0; j < 30; ++j)
            sum += std::pow(
                phi.value(kCentre + test::torus_point(8, 4.5, 0.1 + i * 0.1047, j * 0.2094)), 2);
    return std::sqrt(sum / 1800);
}

TEST(Accuracy, the_surface_is_met_to_second_order_at_three_resolutions) {
    constexpr double kFactor = 3.4;  // 4 in the limit
    for (const auto& error : {error_on_sphere, error_on_torus}) {
        const double coarse = error(0.8), middle = error(0.4), fine = error(0.2);
        EXPECT_GT(coarse / middle, kFactor);
        EXPECT_GT(middle / fine, kFactor);
    }
}

// Staircase energy: the mean square of the angle between the normals of the
// extracted triangles, weighed by area, and those of the true surface there.
double staircase_energy(const LabelLevelSets& sets, const test::Field& truth) {
    const TriMesh mesh = extract_surface(sets.regions[0].phi);
    double sum = 0, total = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = sets.frame.to_lps(mesh.points[t[0]]),
                   b = sets.frame.to_lps(mesh.points[t[1]]),
                   c = sets.frame.to_lps(mesh.points[t[2]]);
        const Vec3 n = (b - a).cross(c - a), middle = (a + b + c) / 3;
        Vec3 slope;
        for (int axis = 0; axis < 3; ++axis)
            slope[axis] =
                truth(middle + 1e-4 * Vec3::Unit(axis)) - truth(middle - 1e-4 * Vec3::Unit(axis));
        const double angle = std::atan2(n.cross(slope).norm(), n.dot(slope));
        sum += n.norm() * angle * angle;
        total += n.norm();
    }
    return sum / total;
}

TEST(Accuracy, staircases_lose_four_fifths_of_their_energy) {
    constexpr double kFactor = 5, kMean = 0.25;  // voxels moved, on average
    const auto ellipsoid = [](const Vec3& p) {
        return ((p - kCentre).cwiseQuotient(Vec3(12, 9, 7))).norm() * 9 - 9;
    };
    for (const test::Field& truth :
         {test::Field(sphere), test::Field(torus), test::Field(ellipsoid)}) {
        const auto volume = test::sample_volume(
            {31, 31, 31}, {1, 1, 1}, [&](const Vec3& p) { return truth(p) < 0 ? 1 : 0; });
        LabelOptions none;
        none.smoothing = Smoothing::none;
        const std::vector<std::int32_t> label{1};
        const double before = staircase_energy(from_labels(volume, label, none, silent), truth);
        for (const Smoothing kind : {Smoothing::curvature, Smoothing::constrained}) {
            LabelOptions options;
            options.smoothing = kind;
            const auto sets = from_labels(volume, label, options, silent);
            const double after = staircase_energy(sets, truth);
            EXPECT_GT(before / after, kFactor);
            EXPECT_LT(sets.smoothing[0].moved_mean, kMean);
        }
    }
}

}  // namespace
}  // namespace myotet::levelset
