// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/NodalLoads.h"

#include "Core/Errors.h"
#include "Dynamics/NodeAlgebra.h"

namespace myotet::dynamics {
namespace {

double area(const std::vector<Vec3>& x, std::int32_t a, std::int32_t b, std::int32_t c) {
    return 0.5 * (x[b] - x[a]).cross(x[c] - x[a]).norm();
}

template <class Triangles>
double total_area(const std::vector<Vec3>& rest, const Triangles& triangles) {
    double sum = 0;
    for (const auto& t : triangles) sum += area(rest, t[0], t[1], t[2]);
    if (!(sum > 0))
        throw InputError("the faces of a traction have no area; name faces of the surface");
    return sum;
}

}  // namespace

double NodalLoads::move_to(const NodeVectors& x) { return -dot(force_, x); }

void NodalLoads::add_forces(NodeVectors& forces) const { add_scaled(1, force_, forces); }

void add_traction(const std::vector<Vec3>& rest, const std::vector<Triangle>& triangles,
                  const Vec3& total, NodeVectors& forces) {
    const double all = total_area(rest, triangles);
    for (const Triangle& t : triangles)
        for (const std::int32_t n : t)
            forces[n] += area(rest, t[0], t[1], t[2]) / (3 * all) * total;
}

void add_quadratic_traction(const std::vector<Vec3>& rest,
                            const std::vector<std::array<std::int32_t, 6>>& triangles,
                            const Vec3& total, NodeVectors& forces) {
    // The integral of a corner's quadratic basis function is nothing, of a middle's A / 3.
    const double all = total_area(rest, triangles);
    for (const auto& t : triangles)
        for (int m = 3; m < 6; ++m)
            forces[t[m]] += area(rest, t[0], t[1], t[2]) / (3 * all) * total;
}

}  // namespace myotet::dynamics
