// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Geometry.h"
#include "Fibres/BSplineBasis.h"
#include "Fibres/FibreField.h"

namespace myotet::fibres {

/// Degrees and numbers of control points along u, v and w.
struct SolidShape {
    std::array<int, 3> degree{3, 3, 3};  ///< 1 to 3
    std::array<int, 3> count{6, 6, 16};  ///< more than the degree
    /// Throws InputError naming the direction, its value and the rule.
    void validate() const;
    [[nodiscard]] std::size_t controls() const {
        return static_cast<std::size_t>(count[0]) * count[1] * count[2];
    }
};

/// A solid X(u, v, w) = sum of N_i(u) N_j(v) N_k(w) P_ijk on the cube [0, 1]^3, with
/// clamped uniform knots [Ng97]. w runs along the muscle, from origin to insertion; u and
/// v span its cross-section like a square, which has no axis at which polar coordinates
/// would be singular; only on its four edges do u and v turn parallel where the
/// cross-section is round, and w is regular there too.
struct BSplineSolid {
    SolidShape shape;
    std::vector<Vec3> control;  ///< shape.controls() points, mm, LPS; u fastest, w slowest
    /// Throws InputError when the shape is not valid, the number of points is another or
    /// one of them is not finite.
    void validate() const;
};

/// A point of a solid and dX/du, dX/dv, dX/dw as columns.
struct SolidPoint {
    Vec3 position = Vec3::Zero();
    Mat3 derivative = Mat3::Zero();
};

/// `uvw` is clamped to the cube. Cost: about 0.3 us at degree 3.
[[nodiscard]] SolidPoint evaluate(const BSplineSolid& solid, const Vec3& uvw);

/// Fibre: dX/dw at length 1; zero where dX/dw is.
[[nodiscard]] Vec3 fibre_at(const BSplineSolid& solid, const Vec3& uvw);

/// Where a point is in a solid.
struct SolidPlace {
    Vec3 uvw = Vec3::Zero();
    double distance = 0;  ///< from the solid, mm; rounding for points inside
};

/// Finds u, v and w of points.
class SolidLocator {
public:
    /// Keeps a reference to the solid. Throws InputError as validate().
    explicit SolidLocator(const BSplineSolid& solid);
    /// Place of a point of the solid, or of the nearest one to a point outside, which lies
    /// on its boundary: Levenberg and Marquardt's method within the cube, from the nearest
    /// points of a grid in it, one after the other until one ends at the point.
    /// Source: [Nocedal06, sec. 10.3, 16.7]. Cost: 5 us inside,
    /// 90 us outside.
    [[nodiscard]] SolidPlace find(const Vec3& point) const;

private:
    const BSplineSolid& solid_;
    std::vector<Vec3> uvw_, position_;  // the grid
    double close_ = 0;                  // mm
};

/// Fibres of the solid at the centroids; outside it those of its nearest point. A note
/// says how many centroids lie outside and how far. Where dX/dw vanishes, the neighbours'.
/// Throws InputError as validate(), MeshError when it vanishes everywhere.
[[nodiscard]] FibreField solid_fibres(const TetMesh& mesh, const BSplineSolid& solid);

}  // namespace myotet::fibres
