// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "LevelSet/Csg.h"
#include "Repair/Recipe.h"
#include "Repair/Route.h"

namespace myotet::repair {

/// The middle line of a bridge and its thickness along it.
struct MiddleLine {
    std::vector<Vec3> points;    ///< lattice coordinates
    std::vector<double> radius;  ///< mm, one a point
    double length = 0;           ///< mm
};

/// The largest ball inside a solid whose centre lies within `reach` mm of a
/// point of it, found by climbing its distance.
struct Ball {
    Vec3 centre = Vec3::Zero();
    double radius = 0;  ///< mm; at most 8 mm or 10 samples, whichever is more
};
[[nodiscard]] Ball ball_near(const levelset::Band& solid, const Vec3& point, double reach);

/// Smooths a route's stairs, its ends fixed, without entering walls, and
/// measures its length anew.
[[nodiscard]] Route smoothed(Route route, const RouteTask& task);

/// From the ball inside the solid that the path leaves, along the path, and
/// `depth` mm into the solid it reaches. The radius grows evenly from the first
/// to the second, which it has at the path's end and beyond.
[[nodiscard]] MiddleLine middle_line(const std::vector<Vec3>& path, const Ball& begin,
                                     const std::array<double, 2>& radius, double depth);

/// Round cones from point to point.
[[nodiscard]] levelset::Band swept(const MiddleLine& line, const levelset::CsgLattice& lattice);

}  // namespace myotet::repair
