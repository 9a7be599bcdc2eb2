// SPDX-License-Identifier: Apache-2.0
#include "Cage/Body.h"

#include <algorithm>

namespace myotet::cage {
namespace {

using Ids = std::vector<std::int32_t>;

// Takes out of `left` what hangs together by faces that hold the node.
Ids take_part(const std::vector<Tet>& tets, const std::vector<Tet>& neighbours, std::int32_t node,
              Ids& left) {
    Ids part{left.front()};
    left.erase(left.begin());
    for (std::size_t i = 0; i < part.size(); ++i)
        for (int f = 0; f < 4; ++f) {
            if (tets[part[i]][f] == node) continue;
            const auto at = std::ranges::find(left, neighbours[part[i]][f]);
            if (at == left.end()) continue;
            part.push_back(*at);
            left.erase(at);
        }
    return part;
}

std::vector<Ids> stars_of(const std::vector<Tet>& tets, std::size_t count) {
    std::vector<Ids> star(count);
    for (std::size_t t = 0; t < tets.size(); ++t)
        for (const std::int32_t n : tets[t]) star[n].push_back(static_cast<std::int32_t>(t));
    return star;
}

}  // namespace

void connect(Body& body) {
    Ids number(body.points.size(), -1);
    for (const Tet& t : body.tets)
        for (const std::int32_t n : t) number[n] = 0;
    std::int32_t used = 0;
    for (std::size_t n = 0; n < number.size(); ++n)
        if (number[n] == 0) {
            body.points[used] = body.points[n];
            number[n] = used++;
        }
    body.points.resize(used);
    for (Tet& t : body.tets)
        for (std::int32_t& n : t) n = number[n];
    body.star = stars_of(body.tets, body.points.size());
    body.faces = boundary_faces(body.tets);
    body.fan.assign(body.points.size(), {});
    for (std::size_t f = 0; f < body.faces.size(); ++f)
        for (const std::int32_t n : body.faces[f])
            body.fan[n].push_back(static_cast<std::int32_t>(f));
}

Body body_of(const Sculpture& sculpture, std::int64_t& split) {
    Body body;
    Ids number(sculpture.points.size(), -1);
    for (std::size_t t = 0; t < sculpture.tets.size(); ++t) {
        if (!sculpture.kept[t]) continue;
        Tet tet = sculpture.tets[t];
        for (std::int32_t& n : tet) {
            if (number[n] < 0) {
                number[n] = static_cast<std::int32_t>(body.points.size());
                body.points.push_back(sculpture.points[n]);
            }
            n = number[n];
        }
        body.tets.push_back(tet);
    }
    const std::vector<Tet> neighbours = face_neighbours(body.tets);
    const std::vector<Ids> touching = stars_of(body.tets, body.points.size());
    split = 0;
    for (std::size_t n = 0; n < touching.size(); ++n) {
        const auto node = static_cast<std::int32_t>(n);
        Ids left = touching[n];
        (void)take_part(body.tets, neighbours, node, left);
        while (!left.empty()) {
            const auto fresh = static_cast<std::int32_t>(body.points.size());
            body.points.push_back(body.points[n]);
            ++split;
            for (const std::int32_t t : take_part(body.tets, neighbours, node, left))
                std::ranges::replace(body.tets[t], node, fresh);
        }
    }
    connect(body);
    return body;
}

}  // namespace myotet::cage
