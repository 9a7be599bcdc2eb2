// SPDX-License-Identifier: Apache-2.0
#include "Surface/Faults.h"

#include <algorithm>
#include <cmath>

#include "Surface/Change.h"
#include "Surface/Measure.h"

namespace myotet::surface {
namespace {

constexpr double kOff = 1e-3;  // of the reach: ten times where landing ends

Vec3 centre_of(const Fans& fans, std::int32_t t) {
    const Triangle& f = fans.triangles[t];
    return (fans.points[f[0]] + fans.points[f[1]] + fans.points[f[2]]) / 3;
}

void add_crossings(const Fans& fans, const TriMesh& beside, std::vector<Vec3>& places) {
    const auto own = static_cast<std::int32_t>(fans.triangles.size());
    for (const auto& pair : crossings(fans.points, fans.triangles, beside))
        for (const std::int32_t t : pair)
            if (t < own) places.push_back(centre_of(fans, t));
}

bool has_bad_angle(const Fans& fans, const Triangle& t) {
    const auto angles = angles_deg(fans.points[t[0]], fans.points[t[1]], fans.points[t[2]]);
    return !(std::ranges::min(angles) >= kSmallestAngle &&
             std::ranges::max(angles) <= kLargestAngle);
}

}  // namespace

std::vector<Vec3> start_faults(const TriMesh& start, const Guide& guide, double reach) {
    Fans fans = make_fans(start);
    std::ranges::fill(fans.sizes, reach);
    place_all(fans, {.phi = guide.phi, .trim = {}, .beside = {}});
    std::vector<Vec3> places;
    for (const Vec3& p : fans.points)
        if (!(std::abs(guide.phi(p).value) <= kOff * reach)) places.push_back(p);
    add_crossings(fans, guide.beside.mesh, places);
    return places;
}

std::vector<Vec3> faults(const TriMesh& mesh, const Guide& guide) {
    Fans fans = make_fans(mesh);
    const double off = kPointsOff * median_edge(mesh);
    std::vector<Vec3> places;
    for (std::size_t v = 0; v < fans.points.size(); ++v) {
        const FieldSample s = guide.phi(fans.points[v]);
        fans.normals[v] = s.gradient.normalized();
        if (!fans.rim[v] && !(std::abs(s.value) <= off)) places.push_back(fans.points[v]);
    }
    for (std::size_t t = 0; t < fans.triangles.size(); ++t) {
        const Triangle& f = fans.triangles[t];
        const bool beside_rim =
            std::ranges::any_of(f, [&](std::int32_t v) { return fans.rim[v] != 0; });
        if (!beside_rim &&
            (has_bad_angle(fans, f) || facing(fans, guide.phi, f) == Facing::turned_over))
            places.push_back(centre_of(fans, static_cast<std::int32_t>(t)));
    }
    add_crossings(fans, guide.beside.mesh, places);
    return places;
}

}  // namespace myotet::surface
