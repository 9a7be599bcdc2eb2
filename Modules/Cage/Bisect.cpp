// SPDX-License-Identifier: Apache-2.0
#include "Cage/Bisect.h"

#include <algorithm>

namespace myotet::cage {
namespace {

bool has(const auto& simplex, std::int32_t n) {
    return std::ranges::find(simplex, n) != simplex.end();
}

Corners3 placed(const Body& body, const Triangle& f) {
    return {body.points[f[0]], body.points[f[1]], body.points[f[2]]};
}

// A rounded midpoint lies off the edge by a unit in the last place: the halves of its faces
// are looked at as any others.
bool bisect(Walls& walls, std::int32_t a, std::int32_t b) {
    Body& body = walls.body();
    const auto middle = static_cast<std::int32_t>(body.points.size());
    body.points.push_back(0.5 * (body.points[a] + body.points[b]));
    std::vector<Corners3> faces;
    for (const std::int32_t f : body.fan[a]) {
        if (!has(body.faces[f], b)) continue;
        for (const std::int32_t end : {a, b}) {
            Triangle half = body.faces[f];
            std::ranges::replace(half, end, middle);
            faces.push_back(placed(body, half));
        }
    }
    if (!walls.clear(faces)) {
        body.points.pop_back();
        return false;
    }
    for (const std::int32_t t : body.star[a]) {
        if (!has(body.tets[t], b)) continue;
        body.tets.push_back(body.tets[t]);
        std::ranges::replace(body.tets[t], b, middle);
        std::ranges::replace(body.tets.back(), a, middle);
    }
    connect(body);
    walls.start_anew();
    return true;
}

}  // namespace

int bisect_around(Walls& walls, std::int32_t node) {
    const Body& body = walls.body();
    std::vector<std::int32_t> ring;
    for (const std::int32_t f : body.fan[node])
        for (const std::int32_t n : body.faces[f])
            if (n != node && !has(ring, n)) ring.push_back(n);
    const auto length = [&](std::int32_t n) { return (body.points[n] - body.points[node]).norm(); };
    std::ranges::stable_sort(ring, std::greater{}, length);
    int done = 0;
    // Old nodes keep their numbers: all stay in use, and midpoints come after them.
    for (const std::int32_t n : ring) done += bisect(walls, node, n);
    return done;
}

}  // namespace myotet::cage
