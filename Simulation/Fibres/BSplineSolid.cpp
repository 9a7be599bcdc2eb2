// SPDX-License-Identifier: Apache-2.0
#include "Fibres/BSplineSolid.h"

#include <algorithm>
#include <string>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Fibres/Gaps.h"

namespace myotet::fibres {
namespace {

constexpr std::size_t kGrain = 256;
// A file or a caller that asks for more has mistaken something.
constexpr double kMostControls = 1e7;

}  // namespace

void SolidShape::validate() const {
    constexpr const char* names[3] = {"u", "v", "w"};
    double controls = 1;
    for (int a = 0; a < 3; ++a) {
        if (degree[a] < 1 || degree[a] > kMostDegree)
            throw InputError(std::string("the degree along ") + names[a] + " is " +
                             std::to_string(degree[a]) + ", but it must be 1 to " +
                             std::to_string(kMostDegree));
        if (count[a] <= degree[a])
            throw InputError(std::string("there are ") + std::to_string(count[a]) +
                             " control points along " + names[a] + ", but degree " +
                             std::to_string(degree[a]) + " needs at least " +
                             std::to_string(degree[a] + 1));
        controls *= count[a];
    }
    if (!(controls <= kMostControls))
        throw InputError("a solid of more than 10^7 control points was asked for; use fewer");
}

void BSplineSolid::validate() const {
    shape.validate();
    if (control.size() != shape.controls())
        throw InputError("the solid has " + std::to_string(control.size()) +
                         " control points, but its counts make " +
                         std::to_string(shape.controls()));
    for (std::size_t n = 0; n < control.size(); ++n)
        if (!control[n].allFinite())
            throw InputError("control point " + std::to_string(n) + " of the solid is not finite");
}

SolidPoint evaluate(const BSplineSolid& solid, const Vec3& uvw) {
    const auto& [degree, count] = solid.shape;
    std::array<Basis, 3> basis;
    for (int a = 0; a < 3; ++a) basis[a] = basis_at(degree[a], count[a], uvw[a]);
    SolidPoint point;
    for (int k = 0; k <= degree[2]; ++k)
        for (int j = 0; j <= degree[1]; ++j) {
            const std::size_t row =
                (static_cast<std::size_t>(basis[2].first + k) * count[1] + basis[1].first + j) *
                    count[0] +
                basis[0].first;
            Vec3 value = Vec3::Zero(), slope = Vec3::Zero();
            for (int i = 0; i <= degree[0]; ++i) {
                value += basis[0].value[i] * solid.control[row + i];
                slope += basis[0].slope[i] * solid.control[row + i];
            }
            const double v = basis[1].value[j], w = basis[2].value[k];
            point.position += v * w * value;
            point.derivative.col(0) += v * w * slope;
            point.derivative.col(1) += basis[1].slope[j] * w * value;
            point.derivative.col(2) += v * basis[2].slope[k] * value;
        }
    return point;
}

Vec3 fibre_at(const BSplineSolid& solid, const Vec3& uvw) {
    return evaluate(solid, uvw).derivative.col(2).stableNormalized();
}

FibreField solid_fibres(const TetMesh& mesh, const BSplineSolid& solid) {
    const SolidLocator locator(solid);
    Box box;
    for (const Vec3& p : solid.control) box.include(p);
    // Inside, the locator ends a rounding away from the point.
    const double outside = 1e-6 * box.diagonal();
    FibreField fibres{std::vector<Vec3>(mesh.tets.size()), {}};
    std::vector<double> distance(mesh.tets.size());
    parallel_for(0, mesh.tets.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) {
            const SolidPlace place = locator.find(centroid_of(mesh, mesh.tets[t]));
            fibres.direction[t] = fibre_at(solid, place.uvw);
            distance[t] = place.distance;
        }
    });
    const auto count =
        std::count_if(distance.begin(), distance.end(), [&](double d) { return d > outside; });
    if (count > 0)
        fibres.notes.push_back(
            std::to_string(count) + " of " + std::to_string(mesh.tets.size()) +
            " tetrahedra have their centre outside the B-spline solid, by up to " +
            std::to_string(*std::max_element(distance.begin(), distance.end())) +
            " mm, and take the fibre of its nearest point");
    if (const std::size_t filled = fill_gaps(mesh, fibres.direction); filled > 0)
        fibres.notes.push_back("the solid has no direction in " + std::to_string(filled) +
                               " tetrahedra, which take their neighbours'");
    return fibres;
}

}  // namespace myotet::fibres
