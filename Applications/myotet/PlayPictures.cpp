// SPDX-License-Identifier: Apache-2.0
#include "PlayPictures.h"

#include <algorithm>
#include <cmath>

#include "Core/Text.h"
#include "Report/Draw.h"

namespace myotet::app {
namespace {

constexpr double kTilt = 0.35;  // downwards, of the way one looks
constexpr double kRoom = 0.05;  // around the box, of its diagonal
// A plane farther from all bodies than this many diagonals is not shown.
constexpr double kFar = 2;
constexpr int kWidth = 640, kHeight = 640;  // pixels
constexpr report::Colour kObstacle{0.82, 0.82, 0.8}, kBall{0.25, 0.25, 0.28};
// Told apart also by who sees fewer colours [Okabe and Ito 2008], made lighter.
constexpr report::Colour kBodies[] = {{0.85, 0.45, 0.35}, {0.45, 0.70, 0.90}, {0.35, 0.70, 0.55},
                                      {0.95, 0.80, 0.40}, {0.80, 0.60, 0.75}, {0.40, 0.55, 0.80}};

Vec3 direction_of(const std::string& view) {
    Vec3 way = Vec3::UnitY();  // in LPS the front is -y, the patient's left +x
    if (view == "back") way = -Vec3::UnitY();
    if (view == "left") way = -Vec3::UnitX();
    if (view == "right") way = Vec3::UnitX();
    return (way - kTilt * Vec3::UnitZ()).normalized();
}

TriMesh rectangle(const Vec3& centre, const Vec3& a, const Vec3& b) {
    return {{centre - a - b, centre + a - b, centre + a + b, centre - a + b},
            {{0, 1, 2}, {0, 2, 3}}};
}

TriMesh surface_of_box(const Box& box) {
    TriMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.points.emplace_back(i & 1 ? box.max.x() : box.min.x(),
                                 i & 2 ? box.max.y() : box.min.y(),
                                 i & 4 ? box.max.z() : box.min.z());
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

// A plane across the box, or a bin's side, which has a box of its own.
TriMesh surface_of_plane(const play::Obstacle& plane, const Box& fit) {
    const Box& box = plane.box.empty() ? fit : plane.box;
    const Vec3 half = 0.5 * box.extent();
    int axis = 0;
    plane.normal.cwiseAbs().maxCoeff(&axis);
    Vec3 centre = box.centre();
    centre -= plane.normal.dot(centre - plane.point) * plane.normal;
    Vec3 a = half[(axis + 1) % 3] * Vec3::Unit((axis + 1) % 3),
         b = half[(axis + 2) % 3] * Vec3::Unit((axis + 2) % 3);
    a -= plane.normal.dot(a) * plane.normal;
    b -= plane.normal.dot(b) * plane.normal;
    return rectangle(centre, a, b);
}

Box around_bodies(const play::World& world) {
    Box box;
    for (const Vec3& p : world.rest) box.include(p);
    for (const play::Ball& ball : world.balls)
        for (const double r : {-ball.radius, ball.radius})
            box.include(world.rest[ball.node] + Vec3::Constant(r));
    return box;
}

}  // namespace

Box box_of_play(const play::PlayScene& scene, const play::World& world) {
    const Box bodies = around_bodies(world);
    Box box = bodies;
    for (const play::Obstacle& o : scene.obstacles) {
        if (!o.box.empty()) {
            box.include(o.box.min);
            box.include(o.box.max);
        } else if (o.form == play::Form::sphere) {
            box.include(o.point - Vec3::Constant(o.radius));
            box.include(o.point + Vec3::Constant(o.radius));
        } else {
            for (const Vec3& corner : {bodies.min, bodies.max}) {
                const double away = o.normal.dot(corner - o.point);
                if (std::abs(away) < kFar * bodies.diagonal())
                    box.include(corner - away * o.normal);
            }
        }
    }
    const Vec3 room = Vec3::Constant(kRoom * box.diagonal());
    box.min -= room;
    box.max += room;
    return box;
}

report::Picture play_picture(const play::PlayScene& scene, const play::PlayFrame& frame,
                             const Box& fit) {
    const Vec3 direction = direction_of(scene.view);
    std::vector<report::Shape> shapes;
    for (std::size_t b = 0; b < frame.details.size(); ++b)
        shapes.push_back({.surface = frame.details[b], .colour = kBodies[b % std::size(kBodies)]});
    for (const play::Ball& ball : frame.world.balls)
        shapes.push_back({.surface = play::surface_of_ball(frame.state.x[ball.node], ball.radius),
                          .colour = kBall});
    for (const play::Obstacle& o : frame.world.obstacles) {
        if (o.form == play::Form::plane && o.normal.dot(direction) > 0)
            continue;  // seen from behind
        report::Shape shape{.surface = o.form == play::Form::plane ? surface_of_plane(o, fit)
                                       : o.form == play::Form::box
                                           ? surface_of_box(o.box)
                                           : play::surface_of_ball(o.point, o.radius),
                            .colour = kObstacle};
        const Pose pose = contraction::pose_at(o.motion, frame.time);
        for (Vec3& p : shape.surface.points) p = pose(p);
        shapes.push_back(std::move(shape));
    }
    return report::draw(shapes, {.direction = direction,
                                 .width = kWidth,
                                 .height = kHeight,
                                 .title = formatted("t = %.3f s", frame.time),
                                 .fit = fit});
}

}  // namespace myotet::app
