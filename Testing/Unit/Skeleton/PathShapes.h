// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "Skeleton/Path.h"
#include "WrapShapes.h"

// A ground, an upper and a lower body on hinges, and muscles over them, placed by hand.
namespace myotet::skeleton {

/// Two coordinates turn the bodies: the first both about `hinge` through the origin, the
/// second the lower one about `lower_hinge` through `lower_centre` of the upper one.
class Arm {
public:
    Arm() {
        model.bodies.resize(3);
        model.coordinates.resize(2);
    }
    int add_object(WrapObject object, int body, const Pose& in_body) {
        object.body = body;
        object.in_body = in_body;
        model.wrap_objects.push_back(std::move(object));
        return static_cast<int>(model.wrap_objects.size()) - 1;
    }
    void place(double first, double second) {
        values = {first, second};
        const Mat3 upper = Eigen::AngleAxisd(first, hinge).toRotationMatrix();
        const Mat3 lower = Eigen::AngleAxisd(second, lower_hinge).toRotationMatrix();
        bodies = {Pose{}, Pose{upper, Vec3::Zero()},
                  Pose{upper * lower, upper * (lower_centre - lower * lower_centre)}};
    }
    [[nodiscard]] std::vector<std::vector<BodyRate>> rates() const {
        const Vec3 axis = bodies[1].rotation * lower_hinge, centre = bodies[1](lower_centre);
        std::vector<std::vector<BodyRate>> rates(2, std::vector<BodyRate>(3));
        rates[0][1] = {hinge, Vec3::Zero()};
        rates[0][2] = {hinge, hinge.cross(bodies[2].translation)};
        rates[1][2] = {axis, axis.cross(bodies[2].translation - centre)};
        return rates;
    }
    [[nodiscard]] Path find(PathMemory& memory) const {
        return find_path(model, muscle, bodies, values, memory);
    }
    [[nodiscard]] Path find() const {
        PathMemory memory;
        return find(memory);
    }
    [[nodiscard]] std::vector<double> rates_of(const Path& path) const {
        return length_rates(model, muscle, path, bodies, values, rates());
    }

    Model model;
    Muscle muscle;
    Vec3 hinge = Vec3::UnitZ(), lower_hinge = Vec3::UnitZ(), lower_centre = Vec3::Zero();
    std::vector<Pose> bodies;
    std::vector<double> values;
};

inline PathPoint point_on(int body, const Vec3& location) {
    PathPoint point;
    point.body = body;
    point.location = location;
    return point;
}

/// Rates by central differences along the path's own motion; the memory is that of the pose.
inline std::vector<double> differences(Arm arm, const PathMemory& memory, double step) {
    std::vector<double> rates;
    const std::vector<double> at = arm.values;
    for (int q = 0; q < 2; ++q) {
        double lengths[2];
        for (const int side : {0, 1}) {
            const double moved = side == 0 ? -step : step;
            arm.place(at[0] + (q == 0 ? moved : 0), at[1] + (q == 1 ? moved : 0));
            PathMemory own = memory;
            lengths[side] = arm.find(own).length;
        }
        rates.push_back((lengths[1] - lengths[0]) / (2 * step));
    }
    return rates;
}

/// How deep the straight piece between two points runs in an object, negative; in ground.
inline double depth_of(const Arm& arm, const WrapObject& object, const Vec3& begin,
                       const Vec3& end) {
    const WrapSurface surface(object);
    const Pose pose = arm.bodies[object.body] * object.in_body;
    double least = surface.height(pose.to_rest(begin));
    for (int i = 1; i <= 40; ++i)
        least = std::min(least, surface.height(pose.to_rest(begin + i / 40.0 * (end - begin))));
    return least;
}

/// No straight piece of the path enters an object, no curve its own; unless an end is inside.
inline void expect_outside(const Arm& arm, const Path& path, double depth) {
    if (!path.inside.empty()) return;
    for (std::size_t n = 1; n < path.nodes.size(); ++n) {
        const PathNode &begin = path.nodes[n - 1], &end = path.nodes[n];
        if (begin.around < 0) {
            for (const WrapObject& object : arm.model.wrap_objects)
                ASSERT_GT(depth_of(arm, object, begin.at, end.at), -depth);
            continue;
        }
        const WrapObject& own = arm.model.wrap_objects[begin.around];
        for (const Vec3& at : drawn(arm.model, {.nodes = {begin, end}}, arm.bodies, 0.5))
            ASSERT_GT(depth_of(arm, own, at, at), -depth);
    }
}

}  // namespace myotet::skeleton
