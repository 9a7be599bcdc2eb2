// SPDX-License-Identifier: Apache-2.0
#include "Surface/Guard.h"

#include <algorithm>

#include "Surface/Crossings.h"

namespace myotet::surface {
namespace {

constexpr int kTries = 4;
constexpr double kWider = 1.5;

/// Triangle t of a mesh, or by a higher number of the one beside it.
Placed placed(const Fans& fans, const TriMesh& beside, std::size_t t) {
    const std::size_t own = fans.triangles.size();
    const Triangle& f = t < own ? fans.triangles[t] : beside.triangles[t - own];
    const std::vector<Vec3>& x = t < own ? fans.points : beside.points;
    return {t < own ? f : Triangle{-1, -1, -1}, {x[f[0]], x[f[1]], x[f[2]]}};
}

struct Ball {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
};

using Pairs = std::vector<std::array<std::int32_t, 2>>;

/// About each pair of triangles that cross; `wider` radii about it.
std::vector<Ball> balls_about(const Fans& fans, const TriMesh& beside, const Pairs& pairs,
                              double wider) {
    std::vector<Ball> balls;
    for (const auto& pair : pairs) {
        Ball ball;
        std::vector<Vec3> corners;
        for (const std::int32_t t : pair)
            for (const Vec3& x : placed(fans, beside, t).at) corners.push_back(x);
        for (const Vec3& x : corners) ball.centre += x / 6;
        for (const Vec3& x : corners) ball.radius = std::max(ball.radius, (x - ball.centre).norm());
        ball.radius *= wider;
        balls.push_back(ball);
    }
    return balls;
}

bool in_any(const std::vector<Ball>& balls, const Vec3& p, double wider) {
    return std::ranges::any_of(balls, [&](const Ball& ball) {
        return (p - ball.centre).squaredNorm() < wider * wider * ball.radius * ball.radius;
    });
}

/// Watches the points in the balls; what lies in balls three times as wide can
/// come to be beside them.
void watch(Fans& fans, const TriMesh& beside, const std::vector<Ball>& balls) {
    constexpr double kBeside = 3;
    for (std::size_t v = 0; v < fans.points.size(); ++v)
        if (!fans.around[v].empty()) fans.watched[v] |= in_any(balls, fans.points[v], 1);
    std::vector<char> near(fans.points.size(), 0);
    for (std::size_t v = 0; v < fans.points.size(); ++v)
        near[v] = in_any(balls, fans.points[v], kBeside);
    for (std::size_t t = 0; t < fans.triangles.size(); ++t)
        if (fans.alive(t) &&
            std::ranges::any_of(fans.triangles[t], [&](std::int32_t v) { return near[v] != 0; }))
            fans.beside.push_back(static_cast<std::int32_t>(t));
    std::ranges::sort(fans.beside);
    fans.beside.erase(std::ranges::unique(fans.beside).begin(), fans.beside.end());
    fans.later = fans.triangles.size();
    fans.others.clear();
    for (std::size_t t = 0; t < beside.triangles.size(); ++t) {
        const Placed other = placed(fans, beside, fans.triangles.size() + t);
        if (std::ranges::any_of(other.at, [&](const Vec3& x) { return in_any(balls, x, kBeside); }))
            fans.others.push_back(other);
    }
}

void stop_watching(Fans& fans) {
    std::ranges::fill(fans.watched, 0);
    fans.beside.clear();
    fans.later = 0;
    fans.others.clear();
}

}  // namespace

CrossingGuard::CrossingGuard(Fans& fans, const TriMesh& beside)
    : fans_(fans), beside_(beside), there_(crossings(fans.points, fans.triangles, beside)) {}

void CrossingGuard::run(const std::function<void()>& act) {
    if (!there_.empty()) watch(fans_, beside_, balls_about(fans_, beside_, there_, kWider));
    Fans before = fans_;
    for (int i = 0; i < kTries; ++i) {
        act();
        Pairs pairs = crossings(fans_.points, fans_.triangles, beside_);
        if (pairs.size() <= there_.size()) {
            there_ = std::move(pairs);
            stop_watching(fans_);
            return;
        }
        watch(before, beside_, balls_about(fans_, beside_, pairs, kWider * (i + 1)));
        fans_ = before;
    }
    stop_watching(fans_);
}

}  // namespace myotet::surface
