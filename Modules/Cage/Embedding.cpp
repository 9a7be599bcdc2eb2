// SPDX-License-Identifier: Apache-2.0
#include "Cage/Embedding.h"

#include <algorithm>
#include <string>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Core/Text.h"

namespace myotet::cage {
namespace {

constexpr std::size_t kFew = 256;    // points looked for at a time
constexpr std::size_t kMany = 8192;  // points moved at a time

std::string shown(const Vec3& p) { return formatted("(%.6g, %.6g, %.6g)", p.x(), p.y(), p.z()); }

void require_finite(std::span<const Vec3> points) {
    for (std::size_t i = 0; i < points.size(); ++i)
        if (!points[i].allFinite())
            throw InputError("point " + std::to_string(i) + " is " + shown(points[i]) +
                             ", but points to embed must be finite");
}

[[noreturn]] void refuse(std::size_t outside, std::size_t farthest, double distance,
                         const Vec3& p) {
    const std::string text = formatted("%.3g", distance);
    throw MeshError(std::to_string(outside) + " points lie outside of the mesh, point " +
                    std::to_string(farthest) + " at " + shown(p) + " farthest, by " + text +
                    " mm; give a mesh that encloses them, or let them go with the nearest "
                    "tetrahedron");
}

}  // namespace

Embedding embed(const TetMesh& mesh, std::span<const Vec3> points, Outside outside) {
    require_finite(points);
    const TetTree tree(mesh.points, mesh.tets);
    Embedding embedding;
    embedding.tets.resize(points.size());
    embedding.corners.resize(points.size());
    embedding.weights.resize(points.size());
    std::vector<double> distance(points.size());
    parallel_for(0, points.size(), kFew, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Holder holder = tree.find(points[i]);
            embedding.tets[i] = holder.tet;
            embedding.corners[i] = mesh.tets[holder.tet];
            embedding.weights[i] = holder.weights;
            distance[i] = holder.distance;
        }
    });
    for (const double d : distance) embedding.outside += d > 0;
    if (embedding.outside == 0) return embedding;
    const auto most = std::max_element(distance.begin(), distance.end());
    embedding.farthest = *most;
    const auto farthest = static_cast<std::size_t>(most - distance.begin());
    if (outside == Outside::refused) refuse(embedding.outside, farthest, *most, points[farthest]);
    return embedding;
}

void deform(const Embedding& embedding, std::span<const Vec3> nodes, std::span<Vec3> points) {
    if (points.size() != embedding.size())
        throw InputError("there is room for " + std::to_string(points.size()) + " points, but " +
                         std::to_string(embedding.size()) + " are embedded");
    for (const Tet& t : embedding.corners)
        for (const std::int32_t n : t)
            if (n < 0 || static_cast<std::size_t>(n) >= nodes.size())
                throw InputError("an embedding names node " + std::to_string(n) +
                                 ", but there are " + std::to_string(nodes.size()));
    parallel_for(0, points.size(), kMany, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const Tet& t = embedding.corners[i];
            const Weights& w = embedding.weights[i];
            points[i] =
                w[0] * nodes[t[0]] + w[1] * nodes[t[1]] + w[2] * nodes[t[2]] + w[3] * nodes[t[3]];
        }
    });
}

std::vector<Vec3> deform(const Embedding& embedding, std::span<const Vec3> nodes) {
    std::vector<Vec3> points(embedding.size());
    deform(embedding, nodes, points);
    return points;
}

}  // namespace myotet::cage
