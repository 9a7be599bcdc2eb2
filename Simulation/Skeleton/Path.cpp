// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Path.h"

#include <cmath>

#include "Core/Errors.h"
#include "Skeleton/PathFinder.h"

namespace myotet::skeleton {
namespace {

/// Unit direction of the straight piece between two nodes; exact where a contact begins or
/// ends however short the piece is.
Vec3 direction(const PathNode& begin, const PathNode& end) {
    if (begin.point < 0) return begin.along;
    if (end.point < 0) return end.along;
    const Vec3 way = end.at - begin.at;
    const double length = way.norm();
    return length > 0 ? Vec3(way / length) : Vec3(Vec3::Zero());
}

/// How a node moves with a coordinate.
Vec3 node_rate(const Muscle& muscle, const PathNode& node, std::span<const Pose> bodies,
               std::span<const double> values, int coordinate, const BodyRate& rate) {
    const Pose& body = bodies[node.body];
    Vec3 speed = rate.shift + rate.turning.cross(node.at - body.translation);
    if (node.point < 0 || !muscle.points[node.point].moving) return speed;
    for (int i = 0; i < 3; ++i) {
        const PathPoint::Moving& m = (*muscle.points[node.point].moving)[i];
        if (m.coordinate == coordinate)
            speed += body.rotation.col(i) * evaluate(m.location, values[coordinate]).slope;
    }
    return speed;
}

}  // namespace

Path find_path(const Model& model, const Muscle& muscle, std::span<const Pose> bodies,
               std::span<const double> values, PathMemory& memory) {
    MYOTET_CHECK(bodies.size() == model.bodies.size(), "a place for each body");
    PathFinder finder(model, muscle, bodies, values);
    finder.recall(memory);
    finder.find();
    finder.remember(memory);
    return finder.path();
}

std::vector<double> length_rates(const Model& model, const Muscle& muscle, const Path& path,
                                 std::span<const Pose> bodies, std::span<const double> values,
                                 std::span<const std::vector<BodyRate>> rates) {
    std::vector<double> sum(model.coordinates.size(), 0.0);
    MYOTET_CHECK(rates.size() == sum.size(), "rates for each coordinate");
    for (std::size_t n = 0; n + 1 < path.nodes.size(); ++n) {
        const PathNode &begin = path.nodes[n], &end = path.nodes[n + 1];
        if (begin.around >= 0) continue;
        const Vec3 along = direction(begin, end);
        for (std::size_t q = 0; q < sum.size(); ++q) {
            const int coordinate = static_cast<int>(q);
            const auto speed = [&](const PathNode& node) {
                return node_rate(muscle, node, bodies, values, coordinate, rates[q][node.body]);
            };
            sum[q] += along.dot(speed(end) - speed(begin));
        }
    }
    return sum;
}

std::vector<Vec3> drawn(const Model& model, const Path& path, std::span<const Pose> bodies,
                        double step) {
    if (!(step > 0))
        throw InputError("points along a path need a step above 0 mm, not " + std::to_string(step));
    std::vector<Vec3> points;
    for (const PathNode& node : path.nodes) {
        points.push_back(node.at);
        if (node.around < 0) continue;
        const WrapObject& object = model.wrap_objects[node.around];
        const WrapSurface surface(object);
        const Pose pose = bodies[object.body] * object.in_body;
        const GeodesicPoint start{pose.to_rest(node.at), pose.rotation.transpose() * node.along};
        const int pieces = static_cast<int>(std::ceil(node.curve / step));
        for (int i = 1; i < pieces; ++i)
            points.push_back(
                pose(follow_geodesic(surface, start, node.curve * i / pieces).point.at));
    }
    return points;
}

}  // namespace myotet::skeleton
