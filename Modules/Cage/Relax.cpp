// SPDX-License-Identifier: Apache-2.0
#include "Cage/Relax.h"

#include <algorithm>
#include <limits>

namespace myotet::cage {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Steps, in cells.
constexpr double kFirstStep = 0.05, kLongest = 0.2, kShortest = 1e-4, kAgain = 0.02,
                 kDifference = 1e-5;
// The level is so far above the worst score, degrees; no higher than this while nodes are
// still on their way to the surface.
constexpr double kAbove = 2, kOnTheWay = 22;
// A star with less badness is at rest.
constexpr double kRest = 0.02;
// Growth of the pull on nodes beyond the offset, a round, and its end.
constexpr double kGrowth = 1.12, kStrongest = 1e6;
// What a jump must leave, degrees; how many places it tries, and how far away, in cells.
constexpr double kJumpScore = 4, kJumpReach = 0.9;
constexpr int kJumpPlaces = 120;

}  // namespace

Relaxation::Relaxation(Walls& walls, const RelaxOptions& options)
    : walls_(walls), body_(walls.body()), options_(options), random_(options.seed) {
    step_.assign(body_.points.size(), kFirstStep * options.cell);
    shape_.resize(body_.tets.size());
    for (std::size_t t = 0; t < shape_.size(); ++t)
        shape_[t] = score_deg(body_.corners(t), options_.scale);
    within_.resize(body_.points.size());
    for (std::size_t n = 0; n < within_.size(); ++n) {
        const auto node = static_cast<std::int32_t>(n);
        within_[n] = !body_.on_boundary(node) || walls_.nearest(node).distance <= options_.offset;
    }
}

double Relaxation::worst() const { return *std::ranges::min_element(shape_); }

bool Relaxation::all_within() const {
    return std::ranges::all_of(within_, [](std::uint8_t w) { return w != 0; });
}

std::vector<std::int32_t> Relaxation::beyond() const {
    std::vector<std::int32_t> nodes;
    for (std::size_t n = 0; n < within_.size(); ++n)
        if (!within_[n]) nodes.push_back(static_cast<std::int32_t>(n));
    return nodes;
}

void Relaxation::round() {
    const double above = worst() + kAbove;
    const double most = all_within() ? options_.goal + options_.above : kOnTheWay;
    level_ = level_of(std::min(above, most), options_.scale);
    for (std::size_t n = 0; n < body_.points.size(); ++n) visit(static_cast<std::int32_t>(n));
    pull_ = std::min(kGrowth * pull_, kStrongest);
}

void Relaxation::gather(std::int32_t node) {
    star_.tets.clear();
    star_.corner.clear();
    for (const std::int32_t t : body_.star[node]) {
        star_.tets.push_back(body_.corners(t));
        star_.corner.push_back(
            static_cast<int>(std::ranges::find(body_.tets[t], node) - body_.tets[t].begin()));
    }
}

double Relaxation::shape_energy(const Vec3& x) {
    double sum = 0;
    for (std::size_t i = 0; i < star_.tets.size() && sum < kInfinity; ++i) {
        star_.tets[i][star_.corner[i]] = x;
        sum += badness(star_.tets[i], level_);
    }
    return sum;
}

double Relaxation::star_score(const Vec3& x) {
    double least = 90;
    for (std::size_t i = 0; i < star_.tets.size(); ++i) {
        star_.tets[i][star_.corner[i]] = x;
        least = std::min(least, score_deg(star_.tets[i], options_.scale));
    }
    return least;
}

double Relaxation::energy(std::int32_t node, const Vec3& x) {
    double sum = shape_energy(x);
    if (!(sum < kInfinity) || !body_.on_boundary(node)) return sum;
    if (!within_[node]) {
        const double distance = (x - walls_.nearest(node).point).norm();
        sum += pull_ * std::max(0.0, distance - options_.offset) / options_.cell;
    }
    if (options_.close > 0) {
        double room = 0;
        for (const Corners4& c : star_.tets) room += signed_volume(c[0], c[1], c[2], c[3]);
        sum += options_.close * room / std::pow(options_.cell, 3);
    }
    return sum;
}

void Relaxation::settle(std::int32_t node, const Vec3& x) {
    walls_.move(node, x);
    for (const std::int32_t t : body_.star[node])
        shape_[t] = score_deg(body_.corners(t), options_.scale);
    if (!within_[node]) within_[node] = walls_.nearest(node).distance <= options_.offset;
}

bool Relaxation::falls(std::int32_t node, const Vec3& x) {
    if (!(options_.floor > 0)) return false;
    double now = options_.floor;
    for (const std::int32_t t : body_.star[node]) now = std::min(now, shape_[t]);
    return star_score(x) < now;
}

bool Relaxation::accept(std::int32_t node, const Vec3& x, double before, Vec3& wall) {
    wall.setZero();
    if (!(energy(node, x) < before)) return false;
    if (within_[node] && body_.on_boundary(node) && !walls_.within(node, x, options_.offset)) {
        wall = (walls_.nearest(node).point - x).normalized();
        return false;
    }
    if (falls(node, x) || !walls_.allows(node, x, wall)) return false;
    settle(node, x);
    return true;
}

bool Relaxation::descend(std::int32_t node, double before) {
    const Vec3 at = body_.points[node];
    const double eps = kDifference * options_.cell;
    Vec3 slope;
    for (int i = 0; i < 3; ++i) {
        Vec3 x = at;
        x[i] += eps;
        slope[i] = (energy(node, x) - before) / eps;
    }
    if (!slope.allFinite() || !(slope.norm() > 0)) return false;
    Vec3 way = -slope.normalized();
    for (int walls_met = 0; walls_met < 4; ++walls_met) {
        Vec3 wall;
        if (accept(node, at + step_[node] * way, before, wall)) {
            step_[node] = std::min(1.5 * step_[node], kLongest * options_.cell);
            return true;
        }
        const double into = way.dot(wall);
        if (!(into < 0)) return false;
        way -= into * wall;
        if (way.norm() < 0.05) return false;
    }
    return false;
}

void Relaxation::visit(std::int32_t node) {
    gather(node);
    const Vec3 at = body_.points[node];
    const double before = energy(node, at);
    const bool still = !(options_.close > 0) || !body_.on_boundary(node);
    if ((before < kRest && within_[node] && still) || descend(node, before)) return;
    for (int attempt = 0; attempt < 2; ++attempt) {
        const Vec3 way = step_[node] * random_direction();
        Vec3 wall;
        if (accept(node, at + way, before, wall) || accept(node, at - way, before, wall)) return;
    }
    step_[node] *= 0.5;
    if (step_[node] < kShortest * options_.cell) step_[node] = kAgain * options_.cell;
}

void Relaxation::raise_ring(std::int32_t node) {
    std::vector<std::int32_t> ring;
    for (const std::int32_t f : body_.fan[node])
        for (const std::int32_t n : body_.faces[f])
            if (n != node && std::ranges::find(ring, n) == ring.end()) ring.push_back(n);
    for (const std::int32_t n : ring) {
        const Nearest& near = walls_.nearest(n);
        if (!(near.distance > 0) || near.distance > options_.offset) continue;
        gather(n);
        for (double part = 0.98; part > 0.2; part *= 0.6) {
            const double rise = part * (options_.offset - near.distance) / near.distance;
            const Vec3 x = body_.points[n] + rise * (body_.points[n] - near.point);
            Vec3 wall;
            if (star_score(x) < kJumpScore || !walls_.within(n, x, options_.offset) ||
                !walls_.allows(n, x, wall))
                continue;
            settle(n, x);
            break;
        }
    }
}

bool Relaxation::jump(std::int32_t node) {
    raise_ring(node);
    gather(node);
    const Vec3 at = body_.points[node];
    Vec3 best = at;
    double least = kInfinity;
    for (int k = 1; k <= kJumpPlaces; ++k) {
        const Vec3 there = at + kJumpReach * options_.cell * k / kJumpPlaces * random_direction();
        const double part = 0.5 + 0.49 * random_part();
        const Nearest near = walls_.nearest_to(there);
        if (!(near.distance > 0)) continue;
        const Vec3 x = near.point +
                       std::min(1.0, part * options_.offset / near.distance) * (there - near.point);
        const double here = shape_energy(x);
        Vec3 wall;
        if (!(here < least) || star_score(x) < kJumpScore || !walls_.allows(node, x, wall))
            continue;
        least = here;
        best = x;
    }
    if (best == at) return false;
    settle(node, best);
    step_[node] = kFirstStep * options_.cell;
    return within_[node] != 0;
}

double Relaxation::random_part() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

Vec3 Relaxation::random_direction() {
    for (;;) {
        Vec3 v;
        for (int i = 0; i < 3; ++i) v[i] = 2 * random_part() - 1;
        const double square = v.squaredNorm();
        if (square > 1e-4 && square <= 1) return v / std::sqrt(square);
    }
}

}  // namespace myotet::cage
