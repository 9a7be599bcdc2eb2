// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "Core/Parallel.h"
#include "Quality/Quality.h"

namespace myotet::quality {
namespace {

constexpr std::size_t kGrain = 1024;

std::vector<std::array<std::int32_t, 2>> unique_edges(const std::vector<Triangle>& faces) {
    std::vector<std::array<std::int32_t, 2>> edges;
    for (const Triangle& f : faces)
        for (int i = 0; i < 3; ++i)
            edges.push_back({std::min(f[i], f[(i + 1) % 3]), std::max(f[i], f[(i + 1) % 3])});
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

}  // namespace

EdgeLengths boundary_edge_lengths(const TetMesh& mesh) {
    std::vector<double> lengths;
    for (const auto& e : unique_edges(boundary_faces(mesh.tets)))
        lengths.push_back((mesh.points[e[0]] - mesh.points[e[1]]).norm());
    if (lengths.empty()) return {};
    std::sort(lengths.begin(), lengths.end());
    return {lengths.front(), lengths[lengths.size() / 2], lengths.back()};
}

SurfaceDistance surface_distance(const TetMesh& mesh,
                                 const std::function<double(const Vec3&)>& distance) {
    const std::vector<Triangle> faces = boundary_faces(mesh.tets);
    std::vector<Vec3> samples;
    std::vector<char> seen(mesh.points.size(), 0);
    for (const Triangle& f : faces) {
        samples.push_back((mesh.points[f[0]] + mesh.points[f[1]] + mesh.points[f[2]]) / 3);
        for (const std::int32_t n : f)
            if (!seen[n]) {
                seen[n] = 1;
                samples.push_back(mesh.points[n]);
            }
    }
    for (const auto& e : unique_edges(faces))
        samples.push_back(0.5 * (mesh.points[e[0]] + mesh.points[e[1]]));
    if (samples.empty()) return {};
    std::vector<double> off(samples.size());
    parallel_for(0, samples.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) off[i] = std::abs(distance(samples[i]));
    });
    SurfaceDistance d;
    for (const double o : off) {
        d.mean += o;
        d.max = std::max(d.max, o);
    }
    d.mean /= static_cast<double>(off.size());
    return d;
}

}  // namespace myotet::quality
