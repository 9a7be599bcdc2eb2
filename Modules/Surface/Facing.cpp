// SPDX-License-Identifier: Apache-2.0
#include "Surface/Facing.h"

#include <algorithm>

namespace myotet::surface {
namespace {

constexpr double kFacing = 0.2;  // cosine of 78 degrees
constexpr double kFold = -0.5;   // of 120

}  // namespace

Facing facing(const Field& phi, const Corner& a, const Corner& b, const Corner& c) {
    const Vec3 n = double_area(a.point, b.point, c.point);
    const double at_a = n.dot(a.normal), at_b = n.dot(b.normal), at_c = n.dot(c.normal);
    const double least = kFacing * n.norm();
    if (at_a > least && at_b > least && at_c > least) return Facing::outward;
    const bool somewhere = at_a > 0 || at_b > 0 || at_c > 0;
    const Vec3 g = phi((a.point + b.point + c.point) / 3).gradient;
    if (somewhere && n.dot(g) > kFacing * n.norm() * g.norm()) return Facing::outward;
    return somewhere || n.dot(g) > 0 ? Facing::sideways : Facing::turned_over;
}

Facing facing(const Fans& fans, const Field& phi, const Triangle& t) {
    return facing(phi, corner_of(fans, t[0]), corner_of(fans, t[1]), corner_of(fans, t[2]));
}

bool faces_outward(const Fans& fans, const Field& phi, const Triangle& t) {
    return facing(fans, phi, t) == Facing::outward;
}

int weight(Facing facing) {
    return facing == Facing::outward ? 0 : facing == Facing::sideways ? 1 : kBroken;
}

void Umbrella::add(std::int32_t b, std::int32_t c, std::int32_t old) {
    const Corner cb = corner_of(fans_, b), cc = corner_of(fans_, c);
    faults_ += weight(facing(phi_, at_, cb, cc));
    made_.push_back({{v_, b, c}, {at_.point, cb.point, cc.point}});
    normals_.push_back(double_area(at_.point, cb.point, cc.point).normalized());
    old_.push_back(old);
}

int Umbrella::faults() const {
    int faults = faults_;
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = 0; i < made_.size(); ++i) {
        mean += normals_[i];
        for (std::size_t j = 0; j < made_.size(); ++j)
            faults +=
                made_[i].points[2] == made_[j].points[1] && normals_[i].dot(normals_[j]) < kFold;
    }
    return faults + !(mean.dot(at_.normal) > 0) + kBroken * count_crossings(fans_, made_, old_);
}

int faults_around(const Fans& fans, const Field& phi, std::int32_t v, const Corner& at) {
    Umbrella umbrella(fans, phi, v, at);
    for (const std::int32_t t : fans.around[v])
        umbrella.add(after(fans.triangles[t], v), before(fans.triangles[t], v), t);
    return umbrella.faults();
}

int count_crossings(const Fans& fans, std::span<const Placed> made,
                    std::span<const std::int32_t> old) {
    const auto watched = [&](const Placed& p) {
        return std::ranges::any_of(p.points, [&](std::int32_t v) {
            return static_cast<std::size_t>(v) < fans.watched.size() && fans.watched[v];
        });
    };
    if (std::ranges::none_of(made, watched)) return 0;
    int count = 0;
    Box box;
    std::vector<Box> boxes(made.size());
    for (std::size_t i = 0; i < made.size(); ++i)
        for (const Vec3& x : made[i].at) {
            box.include(x);
            boxes[i].include(x);
        }
    for (std::size_t i = 0; i < made.size(); ++i)
        for (std::size_t j = i + 1; j < made.size(); ++j) count += cross(made[i], made[j]);
    const auto against = [&](const Placed& other) {
        const auto& [a, b, c] = other.at;
        const Vec3 low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
        const auto meets = [&](const Box& x) {
            return (low.array() <= x.max.array()).all() && (high.array() >= x.min.array()).all();
        };
        if (!meets(box)) return;
        for (std::size_t i = 0; i < made.size(); ++i)
            if (meets(boxes[i])) count += cross(made[i], other);
    };
    const auto against_own = [&](std::int32_t t) {
        if (!fans.alive(t) || std::ranges::find(old, t) != old.end()) return;
        const Triangle& f = fans.triangles[t];
        against({f, {fans.points[f[0]], fans.points[f[1]], fans.points[f[2]]}});
    };
    for (const std::int32_t t : fans.beside) against_own(t);
    for (std::size_t t = fans.later; t < fans.triangles.size(); ++t)
        against_own(static_cast<std::int32_t>(t));
    for (const Placed& other : fans.others) against(other);
    return count;
}

bool may_move(const Fans& fans, const Field& phi, std::int32_t v, const Corner& at) {
    const int faults = faults_around(fans, phi, v, at);
    return faults == 0 || faults <= faults_around(fans, phi, v, corner_of(fans, v));
}

std::optional<Corner> landing(const Guide& guide, const Vec3& at, double reach, bool on_rim) {
    const std::optional<Vec3> point = on_rim && guide.trim
                                          ? project(guide.phi, guide.trim, at, reach)
                                          : project(guide.phi, at, reach);
    if (!point) return std::nullopt;
    return Corner{*point, guide.phi(*point).gradient.normalized()};
}

std::optional<Corner> landing(const Fans& fans, const Guide& guide, std::int32_t v,
                              const Vec3& at) {
    return landing(guide, at, fans.sizes[v], fans.rim[v] != 0);
}

}  // namespace myotet::surface
