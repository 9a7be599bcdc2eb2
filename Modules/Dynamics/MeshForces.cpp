// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/MeshForces.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "Core/Parallel.h"

namespace myotet::dynamics {

using elasticity::Altitude;
using elasticity::Corners;
using elasticity::corners_of;
using elasticity::RestTet;
using elasticity::Spring;

namespace {

constexpr std::size_t kGrain = 1024;
constexpr int kEdgeEnds[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

template <class Body>
void each_tet(std::size_t count, Body&& body) {
    parallel_for(0, count, kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) body(t);
    });
}

}  // namespace

CornerSums::CornerSums(const std::vector<Tet>& tets, std::size_t nodes)
    : start_(nodes + 1, 0), corner_(4 * tets.size()) {
    for (const Tet& tet : tets)
        for (const std::int32_t n : tet) ++start_[n + 1];
    for (std::size_t n = 0; n < nodes; ++n) start_[n + 1] += start_[n];
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t t = 0; t < tets.size(); ++t)
        for (int c = 0; c < 4; ++c)
            corner_[next[tets[t][c]]++] = static_cast<std::uint32_t>(4 * t + c);
}

void CornerSums::add(const std::vector<Corners>& corners, NodeVectors& to) const {
    parallel_for(0, to.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
            for (std::size_t i = start_[n]; i < start_[n + 1]; ++i)
                to[n] += corners[corner_[i] / 4][corner_[i] % 4];
    });
}

ElementForces::ElementForces(const TetMesh& rest, Law law, elasticity::Viscosity viscosity)
    : tets_(rest.tets),
      rest_(elasticity::rest_tets(rest)),
      now_(rest_),
      elastic_(tets_.size()),
      damping_(tets_.size()),
      law_(std::move(law)),
      viscosity_(viscosity),
      sums_(tets_, rest.points.size()) {
    move_to(rest.points);
}

void ElementForces::move_to(const NodeVectors& x) {
    each_tet(tets_.size(), [&](std::size_t t) {
        const Corners now = corners_of(tets_[t], x);
        elastic_[t] = rest_[t].forces(law_(rest_[t].gradient(now)));
        // Damping acts in the present shape; a flattened element keeps the sign.
        const Mat3 edges = elasticity::edges_of(now);
        now_[t] = {edges.inverse(), std::abs(edges.determinant()) / 6};
    });
}

void ElementForces::add_elastic(NodeVectors& forces) const { sums_.add(elastic_, forces); }

void ElementForces::add_damping(const NodeVectors& v, NodeVectors& forces) const {
    each_tet(tets_.size(), [&](std::size_t t) {
        const Mat3 rate = now_[t].gradient(corners_of(tets_[t], v));
        damping_[t] = now_[t].forces(viscosity_.stress(Mat3::Identity(), rate));
    });
    sums_.add(damping_, forces);
}

SpringForces::SpringForces(const TetMesh& rest, const std::vector<double>& masses,
                           const SpringOptions& options)
    : tets_(rest.tets),
      altitudes_(tets_.size()),
      chosen_(tets_.size()),
      elastic_(tets_.size()),
      damping_(tets_.size()),
      choice_(options.altitudes),
      sums_(tets_, rest.points.size()) {
    std::set<std::pair<std::int32_t, std::int32_t>> seen;
    for (std::size_t t = 0; t < tets_.size(); ++t) {
        first_edge_.push_back(edges_.size());
        for (const auto& [a, b] : kEdgeEnds) {
            const auto [low, high] = std::minmax(tets_[t][a], tets_[t][b]);
            if (!seen.emplace(low, high).second) continue;
            const double length = (rest.points[low] - rest.points[high]).norm();
            edges_.push_back({static_cast<std::uint32_t>(4 * t + a),
                              static_cast<std::uint32_t>(4 * t + b),
                              elasticity::make_spring(masses[low], masses[high], length,
                                                      options.sound_speed, options.damping_ratio)});
        }
        std::array<Spring, 4> springs;
        const auto altitudes = elasticity::altitudes_of(corners_of(tets_[t], rest.points));
        const double all =
            masses[tets_[t][0]] + masses[tets_[t][1]] + masses[tets_[t][2]] + masses[tets_[t][3]];
        for (const Altitude& h : altitudes) {
            const double apex = masses[tets_[t][h.apex]];
            Spring& s = springs[h.apex] = elasticity::make_spring(
                apex, all - apex, h.length, options.sound_speed, options.damping_ratio);
            s.stiffness *= options.altitude_share;
            s.damping *= options.altitude_share;
        }
        altitude_springs_.push_back(springs);
    }
    first_edge_.push_back(edges_.size());
    move_to(rest.points);
}

void SpringForces::move_to(const NodeVectors& x) {
    each_tet(tets_.size(), [&](std::size_t t) {
        const Corners now = corners_of(tets_[t], x);
        Corners& force = elastic_[t];
        force.fill(Vec3::Zero());
        for (std::size_t e = first_edge_[t]; e < first_edge_[t + 1]; ++e) {
            Edge& edge = edges_[e];
            const int a = edge.a % 4, b = edge.b % 4;
            edge.along = (now[b] - now[a]).normalized();
            const auto [fa, fb] = elasticity::edge_force(edge.spring, now[a], now[b]);
            force[a] += fa;
            force[b] += fb;
        }
        altitudes_[t] = elasticity::altitudes_of(now);
        chosen_[t] = elasticity::choose_altitudes(altitudes_[t], altitude_springs_[t], choice_);
        for (const Altitude& h : altitudes_[t]) {
            if (!(chosen_[t] >> h.apex & 1)) continue;
            const Spring& s = altitude_springs_[t][h.apex];
            const Corners f = h.spread(s.stiffness / s.rest_length * (h.length - s.rest_length));
            for (int i = 0; i < 4; ++i) force[i] += f[i];
        }
    });
}

void SpringForces::add_elastic(NodeVectors& forces) const { sums_.add(elastic_, forces); }

void SpringForces::add_damping(const NodeVectors& v, NodeVectors& forces) const {
    each_tet(tets_.size(), [&](std::size_t t) {
        const Corners now = corners_of(tets_[t], v);
        Corners& force = damping_[t];
        force.fill(Vec3::Zero());
        for (std::size_t e = first_edge_[t]; e < first_edge_[t + 1]; ++e) {
            const Edge& edge = edges_[e];
            const int a = edge.a % 4, b = edge.b % 4;
            const Vec3 pull = edge.spring.damping / edge.spring.rest_length *
                              (now[b] - now[a]).dot(edge.along) * edge.along;
            force[a] += pull;
            force[b] -= pull;
        }
        for (const Altitude& h : altitudes_[t]) {
            if (!(chosen_[t] >> h.apex & 1)) continue;
            const Spring& s = altitude_springs_[t][h.apex];
            const Corners f = h.spread(s.damping / s.rest_length * h.rate(now));
            for (int i = 0; i < 4; ++i) force[i] += f[i];
        }
    });
    sums_.add(damping_, forces);
}

}  // namespace myotet::dynamics
