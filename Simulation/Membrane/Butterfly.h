// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "Membrane/HalfEdges.h"

namespace myotet::membrane {

/// A place as a weighted sum of vertices; the weights sum to one.
struct Stencil {
    std::vector<std::int32_t> vertices;
    std::vector<double> weights;

    [[nodiscard]] Vec3 apply(std::span<const Vec3> points) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < vertices.size(); ++i) sum += weights[i] * points[vertices[i]];
        return sum;
    }
};

/// Weights of the N neighbours of a vertex in the rule for vertices of other
/// valence than 6 [Choi05, eq. 5], neighbour 0 being the edge's other end; they
/// sum to 1/4, the vertex itself has 3/4 (Zorin, Schroeder, Sweldens 1996).
[[nodiscard]] std::vector<double> neighbour_weights(int valence);

/// The midpoint of an edge by the modified butterfly scheme [Choi05, eq. 3 to 5]:
/// - both ends of valence 6: the eight-point rule,
/// - one end of another: its neighbours; both: the mean of the two,
/// - on a rim: the four-point rule (-1, 9, 9, -1) / 16 along it.
/// A vertex on a rim counts as one of valence 6; of its missing neighbours the
/// reflection through the rim's edge stands in, so that a plane stays a plane.
[[nodiscard]] Stencil midpoint_stencil(const HalfEdges& mesh, std::int32_t edge);

}  // namespace myotet::membrane
