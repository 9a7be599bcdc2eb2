// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "Meshing/NodeEnergy.h"

namespace myotet::meshing {

/// The energy that the worst elements decide: over the tetrahedra at one node
///
///     sum of q^8 + sum over edges of (3 t / t0)^8 + (3 t1 / t)^8 + (3 a^2 / a0^2)^8
///
/// with q as in StarEnergy, t = tan^2(theta / 2) of the dihedral angle at an edge,
/// a = (|L|_16 |N|_16) / 6V, at least the longest edge over the shortest altitude
/// (norms over six edges and four doubled face areas). t0, t1, a0 are the values of
/// the goal: 116 degrees, 28 degrees, and an aspect ratio that is said. Every term is infinite for
/// a flat tetrahedron. The Hessian is that of Gauss and Newton, exact for q, and so positive
/// definite. Positions as in StarEnergy.
class AngleEnergy {
public:
    /// Forgets the last star and makes room for `count` tetrahedra; a0 is `aspect_ratio`.
    void reset(std::size_t count, double aspect_ratio = 3.4);
    /// Adds the tetrahedron (x, p, q, r), oriented as StarEnergy::add asks.
    void add(const Vec3& p, const Vec3& q, const Vec3& r);

    [[nodiscard]] double value(const Vec3& x) const;
    [[nodiscard]] Expansion expand(const Vec3& x) const;

private:
    std::vector<double> rows_;  // a table: one row a coefficient, `stride_` entries each
    std::size_t stride_ = 0, count_ = 0;
    double per_aspect_ = 0;  // 1 / a0^2
};

/// What the elements of a mesh shall keep to.
struct ShapeGoal {
    double max_dihedral_deg, min_dihedral_deg, max_aspect_ratio;
};

/// How far one tetrahedron is from a goal.
class Badness {
public:
    explicit Badness(const ShapeGoal& goal);

    /// The largest of t / t0, t1 / t and a^2 / a0^2 of the tetrahedron (oriented as
    /// TetMesh's); 1 at the goal, infinite unless it is positive.
    [[nodiscard]] double operator()(const Vec3& a, const Vec3& b, const Vec3& c,
                                    const Vec3& d) const;

private:
    double per_obtuse_, acute_, per_aspect_;  // 1 / t0, t1, 1 / a0^2
};

}  // namespace myotet::meshing
