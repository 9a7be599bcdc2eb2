// SPDX-License-Identifier: Apache-2.0
#include "Fibres/Pennation.h"

#include <cmath>
#include <numbers>

#include "Core/Errors.h"
#include "Fibres/CentralLine.h"

namespace myotet::fibres {
namespace {

// Fewer parts than a muscle has layers of tetrahedra: each must average over a section.
constexpr int kParts = 24;
// Directions to an aponeurosis shorter than this share of the muscle's size are rounding.
constexpr double kOnIt = 1e-9;

/// To the plane at right angles, 0 on it.
Vec3 towards_plane(const Plane& plane, const Vec3& x) {
    const Vec3 normal = plane.normal.normalized();
    return -(x - plane.point).dot(normal) * normal;
}

}  // namespace

void Pennation::validate() const {
    if (!(std::abs(angle_deg) < 90))
        throw InputError("pennation angle_deg is " + std::to_string(angle_deg) +
                         ", but it must lie between -90 and 90 degrees");
    if (!aponeurosis) return;
    const bool finite = aponeurosis->point.allFinite() && aponeurosis->normal.allFinite();
    if (!finite || !(aponeurosis->normal.norm() > 0))
        throw InputError(
            "the aponeurosis' plane needs a finite point and a finite normal that is not zero");
}

std::size_t pennate(const TetMesh& mesh, std::span<const double> potential,
                    const Pennation& pennation, std::vector<Vec3>& direction) {
    pennation.validate();
    const double angle = pennation.angle_deg * std::numbers::pi / 180;
    CentralLine line;
    if (!pennation.aponeurosis) line = central_line(mesh, potential, kParts);
    Box box;
    for (const Vec3& p : mesh.points) box.include(p);
    std::size_t left_alone = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const Vec3 x = centroid_of(mesh, mesh.tets[t]), f = direction[t];
        double level = 0;
        for (const std::int32_t node : mesh.tets[t]) level += 0.25 * potential[node];
        Vec3 n = pennation.aponeurosis ? towards_plane(*pennation.aponeurosis, x)
                                       : Vec3(line.at(level) - x);
        n -= n.dot(f) * f;
        if (!(n.norm() > kOnIt * box.diagonal())) {
            ++left_alone;
            continue;
        }
        direction[t] = (std::cos(angle) * f + std::sin(angle) * n.normalized()).normalized();
    }
    return left_alone;
}

}  // namespace myotet::fibres
