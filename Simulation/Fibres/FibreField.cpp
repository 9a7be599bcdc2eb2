// SPDX-License-Identifier: Apache-2.0
#include "Fibres/FibreField.h"

#include <algorithm>

#include "Core/Errors.h"
#include "Fibres/Dyads.h"

namespace myotet::fibres {
namespace {

void require_sizes(std::size_t tets, std::size_t groups, std::size_t weights) {
    const auto text = [](std::size_t n) { return std::to_string(n); };
    if (groups != tets)
        throw InputError("there are group numbers for " + text(groups) + " tetrahedra, but " +
                         text(tets) + " have fibres; give each its group, or -1");
    if (weights != 0 && weights != tets)
        throw InputError("there are " + text(weights) + " weights, but " + text(tets) +
                         " tetrahedra have fibres; give each its weight, or none at all");
}

std::size_t groups_in(std::span<const std::int32_t> group_of) {
    std::int32_t last = -1;
    for (const std::int32_t group : group_of) {
        if (group < -1)
            throw InputError("a group has the number " + std::to_string(group) +
                             ", but they begin at 0, with -1 for none");
        last = std::max(last, group);
    }
    return static_cast<std::size_t>(last + 1);
}

}  // namespace

FibreField constant_fibres(const TetMesh& mesh, const Vec3& direction) {
    const double length = direction.stableNorm();
    if (!(length > 0) || !direction.allFinite())
        throw InputError("the fibres' direction is " + std::to_string(direction.x()) + ", " +
                         std::to_string(direction.y()) + ", " + std::to_string(direction.z()) +
                         ", but it must be finite and not zero");
    return {std::vector<Vec3>(mesh.tets.size(), direction / length), {}};
}

std::vector<Vec3> average(const FibreField& fibres, std::span<const std::int32_t> group_of,
                          std::span<const double> weight) {
    require_sizes(fibres.direction.size(), group_of.size(), weight.size());
    const std::size_t groups = groups_in(group_of);
    std::vector<DyadSum> sums(groups);
    std::vector<Vec3> mean(groups, Vec3::Zero());
    for (std::size_t t = 0; t < group_of.size(); ++t) {
        if (group_of[t] < 0) continue;
        const auto group = static_cast<std::size_t>(group_of[t]);
        const double w = weight.empty() ? 1.0 : weight[t];
        if (!(w >= 0))
            throw InputError("the weight of tetrahedron " + std::to_string(t) + " is " +
                             std::to_string(w) + ", but it must not be negative");
        if (mean[group].isZero(0)) mean[group] = fibres.direction[t];
        sums[group].add(fibres.direction[t], w);
    }
    for (std::size_t group = 0; group < groups; ++group) {
        if (mean[group].isZero(0))
            throw InputError("group " + std::to_string(group) +
                             " has no tetrahedron; number the groups without gaps");
        if (const auto principal = sums[group].principal()) mean[group] = *principal;
    }
    return mean;
}

void require_positive(const TetMesh& mesh) {
    if (mesh.tets.empty())
        throw MeshError("the mesh has no tetrahedra, so there is nothing to give fibres to");
    const auto points = static_cast<std::int32_t>(mesh.points.size());
    for (std::size_t i = 0; i < mesh.tets.size(); ++i) {
        const Tet& t = mesh.tets[i];
        const std::string where = "tetrahedron " + std::to_string(i);
        for (const std::int32_t node : t)
            if (node < 0 || node >= points)
                throw MeshError(where + " has the node " + std::to_string(node) +
                                ", but there are " + std::to_string(points) +
                                " points, numbered from 0");
        const double volume = signed_volume(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]],
                                            mesh.points[t[3]]);
        if (!(volume > 0))
            throw MeshError(where + " has the volume " + std::to_string(volume) +
                            " mm^3, but it must be positive; mesh the tissue again");
    }
}

}  // namespace myotet::fibres
