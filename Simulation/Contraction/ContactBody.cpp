// SPDX-License-Identifier: Apache-2.0
#include "Contraction/ContactBody.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "Contraction/ContactPairs.h"
#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Dynamics/SafeStep.h"

namespace myotet::contraction {

using dynamics::BlockMatrix;
using dynamics::Cliques;
using dynamics::NodeVectors;

namespace {

constexpr std::size_t kGrain = 128;
// Below this slope of a distance there is no normal to speak of: the middle of a body.
constexpr double kLeastSlope = 1e-3;

Mat3 edges(const std::array<std::int32_t, 5>& who, const std::vector<Vec3>& x) {
    Mat3 D;
    for (int c = 0; c < 3; ++c) D.col(c) = x[who[c + 2]] - x[who[1]];
    return D;
}

// How much a body of deformation F is stretched along a normal of its shape at rest.
double stretch_along(const Vec3& gradient, const Mat3& inverse) {
    const double slope = gradient.norm();
    return slope > kLeastSlope ? slope / (inverse.transpose() * gradient).norm() : 1;
}

// Nodes that are no corner of the tetrahedra.
ContactNodes without_own(const ContactNodes& nodes, const std::vector<Tet>& tets,
                         std::size_t count) {
    std::vector<char> own(count, 0);
    for (const Tet& t : tets)
        for (const std::int32_t n : t) own[n] = 1;
    ContactNodes others;
    for (std::size_t i = 0; i < nodes.node.size(); ++i) {
        const std::int32_t n = nodes.node[i];
        if (n >= 0 && n < static_cast<std::int32_t>(count) && own[n]) continue;
        others.node.push_back(n);
        others.area.push_back(nodes.area.at(i));
    }
    return others;
}

}  // namespace

void BodyContactOptions::validate() const {
    law.validate();
    if (!(reach > law.gap))
        throw InputError("reach of contact is " + std::to_string(reach) +
                         " mm, but it must exceed the gap of " + std::to_string(law.gap) +
                         " mm by what nodes move in a step");
}

BodyContact::BodyContact(const ContactNodes& nodes, const std::vector<Vec3>& rest, ContactBody body,
                         const BodyContactOptions& options)
    : rest_(rest), body_(std::move(body)), options_(options) {
    options_.validate();
    const auto count = static_cast<std::int32_t>(rest.size());
    for (const Tet& t : body_.tets) {
        for (const std::int32_t n : t)
            if (n < 0 || n >= count)
                throw InputError("a tetrahedron of a body in contact names node " +
                                 std::to_string(n) + ", but there are " + std::to_string(count) +
                                 "; give the tetrahedra of this mesh");
        if (!(signed_volume(rest[t[0]], rest[t[1]], rest[t[2]], rest[t[3]]) > 0))
            throw MeshError("the tetrahedron of nodes " + std::to_string(t[0]) + ", " +
                            std::to_string(t[1]) + ", " + std::to_string(t[2]) + ", " +
                            std::to_string(t[3]) +
                            " of a body in contact is not positive at rest; repair the mesh");
    }
    if (nodes.area.size() == nodes.node.size())
        nodes_ = without_own(nodes, body_.tets, rest.size());
    else
        nodes_ = nodes;  // gaps_at_rest refuses them
    gap_ = gaps_at_rest(nodes_, rest, body_.shape, options_.law.gap);
    settled_.assign(gap_.size(), 0);
}

Vec3 BodyContact::place(const Pair& pair, const Mat3& inverse, const NodeVectors& x) const {
    return rest_[pair.who[1]] + inverse * (x[pair.who[0]] - x[pair.who[1]]);
}

bool BodyContact::update_pairs(const NodeVectors& x) {
    const auto found = nearest_tets(x, nodes_.node, body_.tets, options_.reach);
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i] < 0) continue;
        const Tet& t = body_.tets[found[i]];
        pairs.push_back(
            {.index = i, .tet = found[i], .who = {nodes_.node[i], t[0], t[1], t[2], t[3]}});
    }
    const bool changed = !std::equal(
        pairs.begin(), pairs.end(), pair_.begin(), pair_.end(),
        [](const Pair& a, const Pair& b) { return a.index == b.index && a.tet == b.tet; });
    pair_ = std::move(pairs);
    parallel_for(0, pair_.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) {
            Pair& pair = pair_[p];
            pair.rest = edges(pair.who, rest_).inverse();
            const Mat3 inverse = (edges(pair.who, x) * pair.rest).inverse();
            const Vec3 X = place(pair, inverse, x);
            pair.stretch = stretch_along(body_.shape.sample(X).gradient, inverse);
        }
    });
    touch_.assign(pair_.size(), {});
    for (std::size_t p = 0; p < pair_.size(); ++p) touch_[p].area = nodes_.area[pair_[p].index];
    slopes_.resize(pair_.size());
    return changed;
}

// False where the tetrahedron is flat or inverted.
bool BodyContact::move_pair(std::size_t p, const NodeVectors& x) {
    const Pair& pair = pair_[p];
    ContactTouch& t = touch_[p];
    t.press = 0;
    const Mat3 F = edges(pair.who, x) * pair.rest;
    if (!(F.determinant() > 0)) return false;
    const Mat3 inverse = F.inverse();
    const Vec3 X = place(pair, inverse, x);
    const double gap = gap_[pair.index];
    const auto sample = body_.shape.sample_below(gap, X);
    if (!sample) return true;
    Slopes& s = slopes_[p];
    const Vec3 lambda = pair.rest * (X - rest_[pair.who[1]]);
    s.weight = {1, lambda.sum() - 1, -lambda[0], -lambda[1], -lambda[2]};
    const Mat3 g = inverse.transpose() * pair.rest.transpose();  // columns are g_1 to g_3
    s.gradient = {Vec3::Zero(), -g.rowwise().sum(), g.col(0), g.col(1), g.col(2)};
    s.u = inverse.transpose() * sample->gradient;
    s.curvature = inverse.transpose() * sample->curvature * inverse;
    t.press = pair.stretch * (gap - sample->value);
    t.depth = pair.stretch * std::max(0.0, std::min(gap, 0.0) - sample->value);
    t.normal = pair.stretch * s.u;
    return true;
}

double BodyContact::move_to(const NodeVectors& x) {
    std::vector<char> valid(pair_.size());
    parallel_for(0, pair_.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) valid[p] = move_pair(p, x);
    });
    if (std::find(valid.begin(), valid.end(), 0) != valid.end())
        return std::numeric_limits<double>::infinity();
    // E = sum k A (s (gap - phi))^2 / 2
    double energy = 0;
    for (const ContactTouch& t : touch_) energy += t.area * t.press * t.press;
    return 0.5 * options_.law.stiffness * energy;
}

void BodyContact::add_forces(NodeVectors& forces) const {
    // One pair after the other, since several share corners.
    for (std::size_t p = 0; p < pair_.size(); ++p) {
        const ContactTouch& t = touch_[p];
        if (!(t.press > 0)) continue;
        const Vec3 force = options_.law.stiffness * t.area * t.press * t.normal;
        for (int a = 0; a < 5; ++a) forces[pair_[p].who[a]] += slopes_[p].weight[a] * force;
    }
}

Cliques BodyContact::cliques() const {
    Cliques all;
    for (const Pair& pair : pair_) all.add(pair.who);
    return all;
}

void BodyContact::add_stiffness(BlockMatrix& K) const {
    for (std::size_t p = 0; p < pair_.size(); ++p) {
        const ContactTouch& t = touch_[p];
        const double settled = std::min(t.press, std::exchange(settled_[pair_[p].index], t.press));
        if (!(t.press > 0)) continue;
        const Slopes& s = slopes_[p];
        const double kA = options_.law.stiffness * t.area, bent = settled * pair_[p].stretch;
        // What all pairs of nodes share, times the weights of both; and what each adds.
        const Mat3 shared = kA * (t.normal * t.normal.transpose() - bent * s.curvature);
        std::array<Mat3, 5> turn;  // kA s g u g_a^T
        for (int a = 0; a < 5; ++a) turn[a] = kA * bent * s.u * s.gradient[a].transpose();
        for (int a = 0; a < 5; ++a)
            for (int b = 0; b < 5; ++b)
                K.value[K.at(pair_[p].who[a], pair_[p].who[b])] +=
                    s.weight[a] * s.weight[b] * shared + s.weight[b] * turn[a] +
                    s.weight[a] * turn[b].transpose();
    }
}

double BodyContact::largest_step(const NodeVectors& x, const NodeVectors& by) const {
    std::vector<double> step(pair_.size(), 1);
    parallel_for(0, pair_.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p)
            step[p] = dynamics::first_flat(edges(pair_[p].who, x), edges(pair_[p].who, by));
    });
    return step.empty() ? 1 : *std::min_element(step.begin(), step.end());
}

}  // namespace myotet::contraction
