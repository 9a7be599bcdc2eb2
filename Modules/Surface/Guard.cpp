// SPDX-License-Identifier: Apache-2.0
#include "Surface/Guard.h"

#include <algorithm>

#include "Surface/Crossings.h"

namespace myotet::surface {
namespace {

constexpr int kTries = 4;
constexpr double kWider = 1.5;

struct Ball {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
};

/// About each pair of triangles that cross; `wider` radii about it.
std::vector<Ball> balls_about(const Fans& fans,
                              const std::vector<std::array<std::int32_t, 2>>& pairs, double wider) {
    std::vector<Ball> balls;
    for (const auto& pair : pairs) {
        Ball ball;
        for (const std::int32_t t : pair)
            for (const std::int32_t v : fans.triangles[t]) ball.centre += fans.points[v] / 6;
        for (const std::int32_t t : pair)
            for (const std::int32_t v : fans.triangles[t])
                ball.radius = std::max(ball.radius, (fans.points[v] - ball.centre).norm());
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
void watch(Fans& fans, const std::vector<Ball>& balls) {
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
}

void stop_watching(Fans& fans) {
    std::ranges::fill(fans.watched, 0);
    fans.beside.clear();
    fans.later = 0;
}

}  // namespace

CrossingGuard::CrossingGuard(Fans& fans)
    : fans_(fans), there_(crossings(fans.points, fans.triangles)) {}

void CrossingGuard::run(const std::function<void()>& act) {
    if (!there_.empty()) watch(fans_, balls_about(fans_, there_, kWider));
    Fans before = fans_;
    for (int i = 0; i < kTries; ++i) {
        act();
        auto pairs = crossings(fans_.points, fans_.triangles);
        if (pairs.size() <= there_.size()) {
            there_ = std::move(pairs);
            stop_watching(fans_);
            return;
        }
        watch(before, balls_about(fans_, pairs, kWider * (i + 1)));
        fans_ = before;
    }
    stop_watching(fans_);
}

}  // namespace myotet::surface
