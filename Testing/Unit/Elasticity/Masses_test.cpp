// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/Masses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "Core/Errors.h"
#include "CrookedBlock.h"

namespace myotet::elasticity {
namespace {

// Sums of some hundred terms.
constexpr double kRounding = 1e-13;

// A density for each label.
std::vector<double> densities(const TetMesh& mesh) {
    std::vector<double> density;
    for (const std::int32_t label : mesh.labels) density.push_back(label == 3 ? 1e-9 : 2e-9);
    return density;
}
double mass(const TetMesh& mesh) {
    const Points points = linear_points(mesh);
    const std::vector<double> density = densities(mesh);
    return std::inner_product(density.begin(), density.end(), points.volume.begin(), 0.0);
}
double sum(const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

TEST(NodalMassesOfTissues, AddUpAndAreThoseOfOneDensityWhereThereIsOne) {
    const TetMesh mesh = test::crooked_block({4, 2, 2});
    const std::vector<double> masses = nodal_masses(mesh, densities(mesh));
    EXPECT_NEAR(sum(masses) / mass(mesh), 1, kRounding);
    const std::vector<double> same(mesh.tets.size(), 3.0), one = nodal_masses(mesh, same),
                                                           other = nodal_masses(mesh, 3.0);
    for (std::size_t n = 0; n < one.size(); ++n) EXPECT_NEAR(one[n] / other[n], 1, kRounding) << n;
}

TEST(NodalMassesOfQuadraticTets, ArePositiveAndAddUp) {
    const TetMesh linear = test::crooked_block({4, 2, 2});
    const std::vector<double> masses = nodal_masses(quadratic_mesh(linear), densities(linear));
    for (const double m : masses) EXPECT_GT(m, 0);
    EXPECT_NEAR(sum(masses) / mass(linear), 1, kRounding);
}

TEST(NodalMassesOfQuadraticTets, AreTheScaledDiagonalOfTheConsistentMatrix) {
    // The integral of L0^a L1^b over a tetrahedron is 6 V a! b! / (a + b + 3)!; for
    // N = L (2 L - 1) and N = 4 L L', squared:
    const auto integral = [](int a, int b) {
        return 6 * std::tgamma(a + 1.0) * std::tgamma(b + 1.0) / std::tgamma(a + b + 4.0);
    };
    const double corner = 4 * integral(4, 0) - 4 * integral(3, 0) + integral(2, 0),
                 middle = 16 * integral(2, 2), all = 4 * corner + 6 * middle;
    const TetMesh one{{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {}};
    const std::vector<double> density = {5};
    const std::vector<double> masses = nodal_masses(quadratic_mesh(one), density);
    for (std::size_t n = 0; n < 10; ++n)
        EXPECT_NEAR(masses[n], 5 * volume(one) * (n < 4 ? corner : middle) / all, kRounding);
}

TEST(NodalMasses, RefuseDensitiesThatMakeNoSense) {
    const TetMesh mesh = test::crooked_block({2, 1, 1});
    std::vector<double> density(mesh.tets.size(), 1.0);
    density.pop_back();
    EXPECT_THROW((void)nodal_masses(mesh, density), InputError);
    for (const double bad : {0.0, -1.0, std::nan("")}) {
        density.assign(mesh.tets.size(), 1.0);
        density[3] = bad;
        EXPECT_THROW((void)nodal_masses(mesh, density), InputError);
        EXPECT_THROW((void)nodal_masses(quadratic_mesh(mesh), density), InputError);
    }
}

}  // namespace
}  // namespace myotet::elasticity
