// SPDX-License-Identifier: Apache-2.0
#include "Fibres/SurfaceDistance.h"

#include <algorithm>
#include <limits>

#include "Core/Parallel.h"

namespace myotet::fibres {
namespace {

constexpr std::size_t kGrain = 64;

double segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double square = along.squaredNorm();
    const double t = square > 0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
    return (p - a - t * along).norm();
}

struct Ball {
    Vec3 centre;
    double radius;
};

}  // namespace

double triangle_distance(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 normal = (b - a).cross(c - a);
    const auto left_of = [&](const Vec3& from, const Vec3& to) {
        return normal.dot((to - from).cross(point - from)) >= 0;
    };
    const double length = normal.norm();
    if (length > 0 && left_of(a, b) && left_of(b, c) && left_of(c, a))
        return std::abs(normal.dot(point - a)) / length;
    return std::min({segment_distance(point, a, b), segment_distance(point, b, c),
                     segment_distance(point, c, a)});
}

std::vector<double> surface_distances(const std::vector<Vec3>& points, const TriMesh& surface) {
    std::vector<Ball> balls;
    balls.reserve(surface.triangles.size());
    for (const Triangle& t : surface.triangles) {
        const Vec3 centre =
            (surface.points[t[0]] + surface.points[t[1]] + surface.points[t[2]]) / 3;
        double radius = 0;
        for (const std::int32_t node : t)
            radius = std::max(radius, (surface.points[node] - centre).norm());
        balls.push_back({centre, radius});
    }
    std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
    parallel_for(0, points.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
            for (std::size_t t = 0; t < balls.size(); ++t) {
                const double reach = distance[n] + balls[t].radius;
                if ((points[n] - balls[t].centre).squaredNorm() >= reach * reach) continue;
                const Triangle& f = surface.triangles[t];
                distance[n] = std::min(
                    distance[n], triangle_distance(points[n], surface.points[f[0]],
                                                   surface.points[f[1]], surface.points[f[2]]));
            }
    });
    return distance;
}

}  // namespace myotet::fibres
