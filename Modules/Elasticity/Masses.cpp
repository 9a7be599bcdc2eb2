// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/Masses.h"

#include <string>

#include "Core/Errors.h"

namespace myotet::elasticity {
namespace {

// The integral of N_a^2 is V/70 for a corner and 8 V/105 for a middle, 36 V/70 in all.
constexpr double kCorner = 1.0 / 36, kMiddle = 4.0 / 27;

void check(std::span<const double> density, std::size_t tets) {
    if (density.size() != tets)
        throw InputError("there are " + std::to_string(density.size()) + " densities for " +
                         std::to_string(tets) + " tetrahedra; give one for each");
    for (std::size_t t = 0; t < tets; ++t)
        if (!(density[t] > 0))
            throw InputError("density of tetrahedron " + std::to_string(t) + " is " +
                             std::to_string(density[t]) + " t/mm^3, but it must be positive");
}

}  // namespace

std::vector<double> nodal_masses(const TetMesh& rest, std::span<const double> density) {
    check(density, rest.tets.size());
    std::vector<double> masses(rest.points.size(), 0.0);
    for (std::size_t t = 0; t < rest.tets.size(); ++t) {
        const double share =
            0.25 * density[t] * rest_tet(corners_of(rest.tets[t], rest.points)).volume;
        for (const std::int32_t n : rest.tets[t]) masses[n] += share;
    }
    return masses;
}

std::vector<double> nodal_masses(const QuadraticMesh& rest, std::span<const double> density) {
    check(density, rest.tets.size());
    const Points points = quadratic_points(rest);
    std::vector<double> masses(rest.points.size(), 0.0);
    for (std::size_t q = 0; q < points.size(); ++q) {
        const std::int32_t t = points.tets(q).front();
        const double mass = density[t] * points.volume[q];
        for (int a = 0; a < 10; ++a) masses[rest.tets[t][a]] += (a < 4 ? kCorner : kMiddle) * mass;
    }
    return masses;
}

}  // namespace myotet::elasticity
