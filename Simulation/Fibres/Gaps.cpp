// SPDX-License-Identifier: Apache-2.0
#include "Fibres/Gaps.h"

#include <string>

#include "Core/Errors.h"
#include "Fibres/Dyads.h"

namespace myotet::fibres {
namespace {

/// What the tetrahedra around each node have between them.
std::vector<DyadSum> sums_at_nodes(const TetMesh& mesh, const std::vector<Vec3>& direction) {
    std::vector<DyadSum> sums(mesh.points.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        if (!direction[t].isZero(0))
            for (const std::int32_t node : mesh.tets[t]) sums[node].add(direction[t], 1);
    return sums;
}

Vec3 mean_of_corners(const Tet& tet, const std::vector<DyadSum>& sums) {
    DyadSum all;
    for (const std::int32_t node : tet) {
        all.dyads += sums[node].dyads;
        all.vectors += sums[node].vectors;
    }
    if (const auto principal = all.principal()) return *principal;
    // Two lines at right angles: any of the two serves, and their sum has neither's fault.
    return all.vectors.isZero(0) ? Vec3(Vec3::Zero()) : Vec3(all.vectors.normalized());
}

}  // namespace

std::size_t fill_gaps(const TetMesh& mesh, std::vector<Vec3>& direction) {
    std::vector<std::size_t> open;
    for (std::size_t t = 0; t < direction.size(); ++t)
        if (direction[t].isZero(0)) open.push_back(t);
    const std::size_t gaps = open.size();
    while (!open.empty()) {
        const std::vector<DyadSum> sums = sums_at_nodes(mesh, direction);
        std::vector<std::size_t> left;
        for (const std::size_t t : open) {
            direction[t] = mean_of_corners(mesh.tets[t], sums);
            if (direction[t].isZero(0)) left.push_back(t);
        }
        if (left.size() == open.size())
            throw MeshError(std::to_string(left.size()) + " tetrahedra, the first of them number " +
                            std::to_string(left.front()) +
                            ", lie where no neighbour has a fibre direction; leave that part out "
                            "or give it fibres in another way");
        open = std::move(left);
    }
    return gaps;
}

}  // namespace myotet::fibres
