// SPDX-License-Identifier: Apache-2.0
#include "Cage/Adjust.h"

#include <algorithm>

#include "Cage/StarShape.h"

namespace myotet::cage {
namespace {

constexpr double kFloor = 8;  // degrees of score_deg that a step must leave

Corners4 corners(const Body& b, const Tet& t) {
    return {b.points[t[0]], b.points[t[1]], b.points[t[2]], b.points[t[3]]};
}

Vec3 target(const Body& body, std::int32_t node) {
    Vec3 sum = Vec3::Zero();
    double weight = 0;
    for (const std::int32_t t : body.star[node]) {
        const Corners4 c = corners(body, body.tets[t]);
        const double volume = signed_volume(c[0], c[1], c[2], c[3]);
        sum += volume * circumcentre(c);
        weight += volume;
    }
    return sum / weight;
}

bool well_shaped(const Body& body, std::int32_t node, const Vec3& x) {
    for (const std::int32_t t : body.star[node]) {
        Corners4 c = corners(body, body.tets[t]);
        const double before = score_deg(c);
        for (int i = 0; i < 4; ++i)
            if (body.tets[t][i] == node) c[i] = x;
        const double after = score_deg(c);
        if (after < kFloor && !(after > before)) return false;
    }
    return true;
}

bool step(Walls& walls, std::int32_t node, double part) {
    Body& body = walls.body();
    const Vec3 at = body.points[node];
    Vec3 way = part * (target(body, node) - at);
    for (int attempt = 0; attempt < 5; ++attempt) {
        Vec3 wall = Vec3::Zero();
        const Vec3 x = at + way;
        if (!well_shaped(body, node, x)) {
            way *= 0.5;
            continue;
        }
        if (walls.allows(node, x, wall)) {
            walls.move(node, x);
            return true;
        }
        const double into = way.dot(wall);
        way = into < 0 ? Vec3(way - into * wall) : Vec3(0.5 * way);
    }
    return false;
}

}  // namespace

double farthest(Walls& walls) {
    double most = 0;
    for (std::size_t n = 0; n < walls.body().points.size(); ++n)
        if (walls.body().on_boundary(static_cast<std::int32_t>(n)))
            most = std::max(most, walls.nearest(static_cast<std::int32_t>(n)).distance);
    return most;
}

int adjust(Walls& walls, const AdjustOptions& options) {
    int done = 0;
    double before = std::numeric_limits<double>::infinity(), now = farthest(walls);
    for (int idle = 0; done < options.iterations && now > options.offset && idle < 3; ++done) {
        idle = now > 0.99 * before ? idle + 1 : 0;
        before = std::min(now, before);
        for (std::size_t n = 0; n < walls.body().points.size(); ++n)
            (void)step(walls, static_cast<std::int32_t>(n), options.step);
        now = farthest(walls);
    }
    return done;
}

}  // namespace myotet::cage
