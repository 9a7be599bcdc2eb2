// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Butterfly.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace myotet::membrane {

namespace {

void add(Stencil& stencil, std::int32_t vertex, double weight) {
    const auto at = std::find(stencil.vertices.begin(), stencil.vertices.end(), vertex);
    if (at != stencil.vertices.end()) {
        stencil.weights[at - stencil.vertices.begin()] += weight;
        return;
    }
    stencil.vertices.push_back(vertex);
    stencil.weights.push_back(weight);
}

// What lies beyond half-edge h: the neighbour's apex, or the own one reflected
// through the middle of the rim's edge.
void add_beyond(Stencil& stencil, const HalfEdges& mesh, std::int32_t h, double weight) {
    if (mesh.twin[h] >= 0) {
        add(stencil, mesh.apex(mesh.twin[h]), weight);
        return;
    }
    add(stencil, mesh.from(h), weight);
    add(stencil, mesh.to(h), weight);
    add(stencil, mesh.apex(h), -weight);
}

// [Choi05, eq. 3]
void add_regular(Stencil& stencil, const HalfEdges& mesh, std::int32_t h) {
    for (const std::int32_t side : {h, mesh.twin[h]}) {
        add(stencil, mesh.from(side), 0.5);
        add(stencil, mesh.apex(side), 0.125);
        add_beyond(stencil, mesh, HalfEdges::next(side), -0.0625);
        add_beyond(stencil, mesh, HalfEdges::before(side), -0.0625);
    }
}

// [Choi05, eq. 4], with the vertex's own 3/4.
void add_extraordinary(Stencil& stencil, const HalfEdges& mesh, std::int32_t h, double share) {
    const auto around = fan(mesh, h);
    const auto weights = neighbour_weights(static_cast<int>(around.size()));
    add(stencil, mesh.from(h), 0.75 * share);
    for (std::size_t i = 0; i < around.size(); ++i)
        add(stencil, mesh.to(around[i]), share * weights[i]);
}

void add_rim(Stencil& stencil, const HalfEdges& mesh, std::int32_t h) {
    const std::int32_t after = mesh.leaving[mesh.to(h)];
    const std::int32_t before = HalfEdges::before(fan(mesh, h).back());
    add(stencil, mesh.from(h), 0.5625);
    add(stencil, mesh.to(h), 0.5625);
    add(stencil, mesh.from(before), -0.0625);
    add(stencil, mesh.to(after), -0.0625);
}

bool extraordinary(const HalfEdges& mesh, std::int32_t h) {
    constexpr std::size_t kRegularValence = 6;
    return !mesh.on_rim(mesh.from(h)) && fan(mesh, h).size() != kRegularValence;
}

}  // namespace

std::vector<double> neighbour_weights(int valence) {
    if (valence == 3) return {5.0 / 12, -1.0 / 12, -1.0 / 12};
    if (valence == 4) return {3.0 / 8, 0, -1.0 / 8, 0};
    std::vector<double> weights(valence);
    for (int i = 0; i < valence; ++i) {
        const double angle = 2 * std::numbers::pi * i / valence;
        weights[i] = (0.25 + std::cos(angle) + 0.5 * std::cos(2 * angle)) / valence;
    }
    return weights;
}

Stencil midpoint_stencil(const HalfEdges& mesh, std::int32_t edge) {
    const std::int32_t h = mesh.edges[edge], back = mesh.twin[h];
    Stencil stencil;
    if (back < 0) {
        add_rim(stencil, mesh, h);
        return stencil;
    }
    const bool first = extraordinary(mesh, h), second = extraordinary(mesh, back);
    if (!first && !second) add_regular(stencil, mesh, h);
    if (first) add_extraordinary(stencil, mesh, h, second ? 0.5 : 1);
    if (second) add_extraordinary(stencil, mesh, back, first ? 0.5 : 1);
    return stencil;
}

}  // namespace myotet::membrane
