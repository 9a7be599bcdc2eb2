// SPDX-License-Identifier: Apache-2.0
#include "Meshing/Stars.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace myotet::meshing {

Stars::Stars(const TetMesh& mesh)
    : scale(mesh.points.size(), 0),
      start_(mesh.points.size() + 1, 0),
      fan_start_(mesh.points.size() + 1, 0) {
    for (const Tet& t : mesh.tets)
        for (const std::int32_t n : t) ++start_[n + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    opposite_.resize(4 * mesh.tets.size());
    std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
    for (const Tet& t : mesh.tets)
        for (int i = 0; i < 4; ++i) {
            // face_of is outward, seen from inside it turns the other way.
            const Triangle f = face_of(t, i);
            opposite_[next[t[i]]++] = {f[0], f[2], f[1]};
        }
    const std::vector<Triangle> faces = boundary_faces(mesh.tets);
    for (const Triangle& f : faces)
        for (const std::int32_t n : f) ++fan_start_[n + 1];
    std::partial_sum(fan_start_.begin(), fan_start_.end(), fan_start_.begin());
    fan_.resize(3 * faces.size());
    next.assign(fan_start_.begin(), fan_start_.end() - 1);
    for (const Triangle& f : faces)
        for (int i = 0; i < 3; ++i) fan_[next[f[i]]++] = {f[(i + 1) % 3], f[(i + 2) % 3]};

    for (std::size_t v = 0; v < scale.size(); ++v) {
        double sum = 0;
        for (const Triangle& f : opposite(static_cast<std::int32_t>(v)))
            for (const std::int32_t n : f) sum += (mesh.points[n] - mesh.points[v]).norm();
        const auto count = 3.0 * static_cast<double>(start_[v + 1] - start_[v]);
        scale[v] = count > 0 ? sum / count : 0;
    }
    colour();
}

void Stars::colour() {
    // Greedy, in the order of the nodes: the smallest colour no neighbour has.
    const std::size_t nodes = scale.size();
    std::vector<std::uint8_t> colour_of(nodes, 255);
    std::size_t colours = 0;
    for (std::size_t v = 0; v < nodes; ++v) {
        std::uint64_t used = 0;
        for (const Triangle& f : opposite(static_cast<std::int32_t>(v)))
            for (const std::int32_t n : f)
                if (colour_of[n] < 64) used |= std::uint64_t{1} << colour_of[n];
        colour_of[v] = static_cast<std::uint8_t>(std::countr_one(used));
        colours = std::max<std::size_t>(colours, colour_of[v] + 1u);
    }
    colour_start.assign(colours + 1, 0);
    for (const std::uint8_t c : colour_of) ++colour_start[c + 1];
    std::partial_sum(colour_start.begin(), colour_start.end(), colour_start.begin());
    by_colour.resize(nodes);
    std::vector<std::size_t> next(colour_start.begin(), colour_start.end() - 1);
    for (std::size_t v = 0; v < nodes; ++v)
        by_colour[next[colour_of[v]]++] = static_cast<std::int32_t>(v);
}

}  // namespace myotet::meshing
