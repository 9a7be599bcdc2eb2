// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "Core/Text.h"
#include "PressPlan.h"

namespace myotet::app {
namespace {

/// The middle of what a closed surface encloses; of an open one, of its points.
Vec3 middle_of(const TriMesh& surface, bool closed) {
    Vec3 sum = Vec3::Zero();
    double whole = 0;
    if (closed)
        for (const auto& [a, b, c] : surface.triangles) {
            const Vec3 &x = surface.points[a], &y = surface.points[b], &z = surface.points[c];
            const double part = signed_volume(Vec3::Zero(), x, y, z);
            sum += part * (x + y + z) / 4;
            whole += part;
        }
    if (whole != 0) return sum / whole;
    for (const Vec3& p : surface.points) sum += p;
    return sum / static_cast<double>(surface.points.size());
}

std::string point_text(const Vec3& p) {
    return "(" + rounded(p.x()) + ", " + rounded(p.y()) + ", " + rounded(p.z()) + ")";
}

[[noreturn]] void refuse_miss(const PressPlan& plan, int line, const std::string& name,
                              const Approach& approach, const Vec3& through) {
    refuse(plan.file, line,
           "'" + name + "' passes the organ by: it comes along " + point_text(approach.way) +
               " through " + point_text(through) + " mm (LPS); say another 'towards'");
}

membrane::Tool placed(const PressPlan& plan, const ToolPlan& wanted, const Vec3& middle,
                      std::span<const Vec3> points) {
    membrane::Tool tool = wanted.tool;
    if (!wanted.approach) return tool;
    const Approach& approach = *wanted.approach;
    const Vec3 through = approach.towards.value_or(middle);
    const auto first = membrane::first_touch(tool, through, approach.way, points);
    if (!first) refuse_miss(plan, wanted.line, wanted.name, approach, through);
    // Beside the first touch by what rounding may take.
    constexpr double kRounding = 1e-9;  // mm
    const auto at = [&](double depth) {
        return Vec3(through + (*first + depth - kRounding) * approach.way);
    };
    if (!tool.forces.empty()) tool.places = {{0, at(0)}};
    for (const auto& [time, depth] : wanted.depths) tool.places.push_back({time, at(depth)});
    return tool;
}

void hold(const PressPlan& plan, const TriMesh& surface, std::span<const std::int32_t> near,
          membrane::Loads& loads) {
    const HoldPlan& hold = plan.hold;
    const auto count = static_cast<std::int32_t>(surface.points.size());
    loads.hold_rims = hold.rims;
    for (const std::int32_t v : hold.points) {
        if (v >= count)
            refuse(plan.file, hold.line,
                   "'points' names point " + std::to_string(v) + ", but the surface has " +
                       std::to_string(count) + ", numbered from 0");
        loads.held.push_back(v);
    }
    for (const Ball& ball : hold.balls) {
        const std::size_t before = loads.held.size();
        for (std::int32_t v = 0; v < count; ++v)
            if ((surface.points[v] - ball.centre).norm() < ball.radius) loads.held.push_back(v);
        if (loads.held.size() == before)
            refuse(plan.file, hold.line,
                   "the ball at " + point_text(ball.centre) + " mm of radius " +
                       rounded(ball.radius) +
                       " mm holds no point of the surface; enlarge it or move it");
    }
    loads.held.insert(loads.held.end(), near.begin(), near.end());
    if (!hold.tissues.empty() && near.empty())
        refuse(plan.file, hold.line,
               "no point of the surface is within " + rounded(hold.within) + " mm of " +
                   list_of(hold.tissues) + "; make 'within' larger");
    std::ranges::sort(loads.held);
    loads.held.erase(std::unique(loads.held.begin(), loads.held.end()), loads.held.end());
}

}  // namespace

membrane::Loads place_loads(const PressPlan& plan, const TriMesh& surface,
                            const membrane::Levels& levels, std::span<const std::int32_t> near) {
    membrane::Loads loads;
    const Vec3 middle = middle_of(surface, levels.meshes.front().closed());
    for (const ToolPlan& tool : plan.tools)
        loads.tools.push_back(placed(plan, tool, middle, levels.rest));
    for (const PatchPlan& wanted : plan.patches) {
        membrane::PatchForce patch = wanted.patch;
        if (wanted.approach) {
            const Vec3 through = wanted.approach->towards.value_or(middle);
            const auto hit = membrane::first_hit(surface, through, wanted.approach->way);
            if (!hit) refuse_miss(plan, wanted.line, wanted.name, *wanted.approach, through);
            patch.centre = *hit;
        }
        loads.patches.push_back(patch);
    }
    hold(plan, surface, near, loads);
    loads.gravity = plan.gravity;
    loads.pressure = plan.pressure;
    loads.bulk = plan.bulk;
    return loads;
}

}  // namespace myotet::app
