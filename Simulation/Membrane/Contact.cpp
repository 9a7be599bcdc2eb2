// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Contact.h"

#include <cmath>

namespace myotet::membrane {

namespace {

// A node that a tool may touch, and its k A, N/mm.
struct Near {
    Vec3 x;
    double stiffness;
};

// Force along the tool's way, N.
double resistance(const Tool& tool, const Vec3& at, const std::vector<Near>& nodes) {
    double sum = 0;
    for (const Near& node : nodes) {
        const Depth d = depth_in(tool, at, node.x);
        if (d.depth > 0) sum += node.stiffness * d.depth * d.outward.dot(tool.way);
    }
    return sum;
}

// The root of a rising function between two places of different sign, by regula
// falsi that halves the value at an end that stays (Illinois).
template <class Function>
double root_between(double low, double at_low, double high, double at_high, const Function& f) {
    constexpr int kMost = 60;
    constexpr double kGood = 1e-14;  // mm, as far as places of some 100 mm are told
    for (int i = 0; i < kMost && high - low > kGood; ++i) {
        const double middle = (low * at_high - high * at_low) / (at_high - at_low);
        const double value = f(middle);
        if (value == 0) return middle;
        if (value < 0) {
            if (middle == low) break;
            low = middle;
            at_low = value;
            at_high /= 2;
        } else {
            if (middle == high) break;
            high = middle;
            at_high = value;
            at_low /= 2;
        }
    }
    return (low * at_high - high * at_low) / (at_high - at_low);
}

}  // namespace

Vec3 place_of(const Tool& tool, const Body& body, const Motion& motion, bool* sunk) {
    const Vec3 start = place_at(tool, motion.time);
    if (tool.forces.empty()) return start;
    const bool sphere = tool.shape == Tool::Shape::sphere;
    const double stiffness = tool.stiffness * area_of_mass(body.wall);
    std::vector<Near> near;
    std::vector<Vec3> points;
    for (const std::int32_t i : body.active.nodes) {
        const Vec3 away = motion.x[i] - start;
        if (sphere && !((away - away.dot(tool.way) * tool.way).norm() < tool.radius)) continue;
        near.push_back({motion.x[i], stiffness * body.active.mass[i]});
        points.push_back(motion.x[i]);
    }
    const auto first = first_touch(tool, start, tool.way, points);
    if (!first) return start;
    const double force = force_at(tool, motion.time);
    const auto excess = [&](double gone) {
        return resistance(tool, start + gone * tool.way, near) - force;
    };
    if (!(force > 0)) return start + std::max(0.0, *first) * tool.way;
    constexpr double kFirstTry = 0.01;  // mm
    double low = *first, at_low = -force;
    for (double sink = kFirstTry;; sink *= 2) {
        const bool last = sphere && sink >= kMostSunk * tool.radius;
        const double high = *first + (last ? kMostSunk * tool.radius : sink),
                     at_high = excess(high);
        if (at_high >= 0)
            return start +
                   std::max(0.0, root_between(low, at_low, high, at_high, excess)) * tool.way;
        if (!last) {
            low = high;
            at_low = at_high;
            continue;
        }
        if (sunk) *sunk = true;
        return start + std::max(0.0, high) * tool.way;
    }
}

void add_tools(const Body& body, const Motion& motion, std::vector<Vec3>& force) {
    for (const Tool& tool : body.loads.tools) {
        const Vec3 at = place_of(tool, body, motion);
        const double stiffness = tool.stiffness * area_of_mass(body.wall);
        for (const std::int32_t i : body.active.nodes) {
            const Depth d = depth_in(tool, at, motion.x[i]);
            if (d.depth > 0) force[i] += stiffness * d.depth * body.active.mass[i] * d.outward;
        }
    }
}

Touch touch_of(const Tool& tool, const Body& body, const Motion& motion) {
    Touch touch;
    touch.place = place_of(tool, body, motion, &touch.sunk);
    const double stiffness = tool.stiffness * area_of_mass(body.wall);
    double sizes = 0;
    for (const std::int32_t i : body.active.nodes) {
        const Depth d = depth_in(tool, touch.place, motion.x[i]);
        if (!(d.depth > 0)) continue;
        const double size = stiffness * body.active.mass[i] * d.depth;
        touch.force -= size * d.outward;
        touch.displacement += size * (motion.x[i] - body.levels.rest[i]).norm();
        sizes += size;
        ++touch.nodes;
    }
    if (sizes > 0) touch.displacement /= sizes;
    return touch;
}

}  // namespace myotet::membrane
