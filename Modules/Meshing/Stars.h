// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Core/TetMesh.h"

namespace myotet::meshing {

/// What surrounds each node of a mesh whose connections do not change.
struct Stars {
    explicit Stars(const TetMesh& mesh);

    /// For each tetrahedron at v its other three nodes (p, q, r), in the order
    /// for which (q - p) x (r - p) . (v - p) is six times its volume.
    [[nodiscard]] std::span<const Triangle> opposite(std::int32_t v) const {
        return {opposite_.data() + start_[v], opposite_.data() + start_[v + 1]};
    }
    /// For each boundary face (v, a, b), outward, at v the nodes a and b; a runs
    /// over all boundary neighbours once.
    [[nodiscard]] std::span<const std::array<std::int32_t, 2>> fan(std::int32_t v) const {
        return {fan_.data() + fan_start_[v], fan_.data() + fan_start_[v + 1]};
    }
    [[nodiscard]] bool on_boundary(std::int32_t v) const {
        return fan_start_[v] != fan_start_[v + 1];
    }

    std::vector<double> scale;  ///< mean length of the edges at each node when built, mm

    /// Nodes by colour: no two of one colour share a tetrahedron. Within a colour
    /// in rising order; colour_start has one entry more than there are colours.
    std::vector<std::int32_t> by_colour;
    std::vector<std::size_t> colour_start;

private:
    void colour();

    std::vector<std::int32_t> start_, fan_start_;
    std::vector<Triangle> opposite_;
    std::vector<std::array<std::int32_t, 2>> fan_;
};

}  // namespace myotet::meshing
