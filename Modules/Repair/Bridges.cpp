// SPDX-License-Identifier: Apache-2.0
#include "Repair/Bridges.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "LevelSet/CsgTable.h"
#include "LevelSet/Primitives.h"

namespace myotet::repair {

using levelset::Band;

namespace {

double length_of(const std::vector<Vec3>& path) {
    double length = 0;
    for (std::size_t i = 1; i < path.size(); ++i) length += (path[i] - path[i - 1]).norm();
    return length;
}

}  // namespace

Ball ball_near(const Band& solid, const Vec3& point, double reach) {
    constexpr double kThick = 8, kThickSamples = 10;
    const double width = std::max(kThick / solid.spacing, kThickSamples);
    // What is farther away than this changes neither the balls nor the climb.
    const Vec3 near = Vec3::Constant(reach + (width + 2) * solid.spacing);
    const Band wide =
        levelset::settle(levelset::cropped(solid, Box{point - near, point + near}), width);
    Ball best{point, 0};
    Vec3 p = point;
    const double step = 0.25 * solid.spacing;
    for (int i = 0; i < 400 && (p - point).norm() <= reach; ++i) {
        const levelset::Sample s = levelset::sample(wide, p);
        if (-s.value > best.radius) best = {p, -s.value};
        const double slope = s.gradient.norm();
        if (!(slope > 0.05)) break;  // on the ridge
        p -= step / slope * s.gradient;
    }
    return best;
}

Route smoothed(Route route, const RouteTask& task) {
    std::vector<Vec3>& path = route.points;
    const auto room = [&](const Vec3& p) {
        double least = std::numeric_limits<double>::infinity();
        for (const Band* wall : task.walls)
            least = std::min(least, levelset::sample(*wall, p).value);
        return least;
    };
    std::vector<double> free(path.size());
    for (std::size_t i = 0; i < path.size(); ++i) free[i] = room(path[i]);
    // Steps of one sample: n rounds level bends of sqrt(n) samples.
    if (path.empty()) return route;
    constexpr int kRounds = 60;
    for (int round = 0; round < kRounds; ++round) {
        std::vector<Vec3> next = path;
        for (std::size_t i = 1; i + 1 < path.size(); ++i) {
            const Vec3 p = 0.5 * path[i] + 0.25 * (path[i - 1] + path[i + 1]);
            const double d = room(p);
            if (!(d >= std::min(free[i], task.clearance))) continue;
            next[i] = p;
            free[i] = d;
        }
        path = std::move(next);
    }
    route.length = length_of(path);
    return route;
}

MiddleLine middle_line(const std::vector<Vec3>& path, const Ball& begin,
                       const std::array<double, 2>& radius, double depth) {
    MiddleLine line;
    line.points.push_back(begin.centre);
    constexpr std::size_t kEvery = 3;  // samples: short against any bend left by smoothing
    for (std::size_t i = 0; i < path.size(); i += kEvery) line.points.push_back(path[i]);
    if (path.size() % kEvery != 1) line.points.push_back(path.back());
    const double length = length_of(line.points);
    double so_far = 0;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        if (i > 0) so_far += (line.points[i] - line.points[i - 1]).norm();
        line.radius.push_back(length > 0 ? radius[0] + (radius[1] - radius[0]) * so_far / length
                                         : radius[1]);
    }
    // On in the direction of the last few samples, over which a path bends little.
    const std::size_t back = std::min<std::size_t>(path.size() - 1, 6);
    Vec3 ahead = path.back() - path[path.size() - 1 - back];
    if (!(ahead.norm() > 0)) ahead = path.back() - begin.centre;
    if (ahead.norm() > 0) {
        line.points.push_back(path.back() + depth * ahead.normalized());
        line.radius.push_back(radius[1]);
    }
    line.length = length_of(line.points);
    return line;
}

Band swept(const MiddleLine& line, const levelset::CsgLattice& lattice) {
    Box box;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
        box.include(line.points[i] - Vec3::Constant(line.radius[i]));
        box.include(line.points[i] + Vec3::Constant(line.radius[i]));
    }
    const auto distance = [&](const Vec3& p) {
        double nearest = (p - line.points[0]).norm() - line.radius[0];
        for (std::size_t i = 1; i < line.points.size(); ++i)
            nearest = std::min(
                nearest, levelset::round_cone_distance(p, {line.points[i - 1], line.points[i],
                                                           line.radius[i - 1], line.radius[i]}));
        return nearest;
    };
    return levelset::settle(levelset::sample_solid(distance, box, lattice));
}

}  // namespace myotet::repair
