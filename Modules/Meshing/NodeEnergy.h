// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Core/Geometry.h"

namespace myotet::meshing {

/// Value, gradient and Hessian of an energy of one point.
struct Expansion {
    double value = 0;
    Vec3 gradient = Vec3::Zero();
    Mat3 hessian = Mat3::Zero();
};

/// q = S^3 / (432 (6V)^2) of one tetrahedron; infinite unless it is positive.
[[nodiscard]] double shape_energy(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// sum of q^m (m a power of two) over the tetrahedra at one node as a function of its position x,
/// the other nodes fixed; q = S^3 / (432 (6V)^2), S the sum of squared edges.
/// q >= 1, with equality for a regular tetrahedron; infinite where a volume is
/// not positive. Convex in x for m >= 1/2 (the inverse mean ratio is convex,
/// Munson 2007). Positions are in units of the node's scale, about its place at
/// the time of gather().
class StarEnergy {
public:
    /// Forgets the last star and makes room for `count` tetrahedra.
    void reset(std::size_t count);
    /// Adds the tetrahedron (x, p, q, r) with (p, q, r) such that its volume is
    /// (q - p) x (r - p) . (x - p) / 6 ... positive.
    void add(const Vec3& p, const Vec3& q, const Vec3& r);

    [[nodiscard]] double value(const Vec3& x, int m) const;
    [[nodiscard]] Expansion expand(const Vec3& x, int m) const;

private:
    std::vector<double> rows_;  // a table: one row a coefficient, `stride_` entries each
    std::size_t stride_ = 0, count_ = 0;
};

}  // namespace myotet::meshing
