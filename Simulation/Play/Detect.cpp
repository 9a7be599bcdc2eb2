// SPDX-License-Identifier: Apache-2.0
#include "Play/Detect.h"

#include <algorithm>
#include <cmath>

#include "Core/Parallel.h"

namespace myotet::play {
namespace {

// A surface is looked for as deep as this many mean edges, however slow things are.
constexpr double kDeepest = 2;
// Points on the way of a ball, a radius.
constexpr double kLooks = 2;

// What has an own surface point: a sample of a body, or a ball.
struct Mover {
    Touch touch;  // nodes and weights, and who it is
    Vec3 from, to;
    double radius = 0, area = 0;
};

Mover mover_of(const Sample& sample, const Course& course, std::array<std::int32_t, 3> who) {
    Mover mover;
    mover.touch.who = who;
    for (int i = 0; i < sample.count; ++i) mover.touch.add(sample.node[i], 1.0 / sample.count);
    mover.from = sample.at(course.x);
    mover.to = sample.at(course.ahead);
    mover.area = sample.area;
    return mover;
}

Mover mover_of(const Ball& ball, const Course& course, std::array<std::int32_t, 3> who) {
    Mover mover;
    mover.touch.who = who;
    mover.touch.add(ball.node, 1);
    mover.from = course.x[ball.node];
    mover.to = course.ahead[ball.node];
    mover.radius = ball.radius;
    mover.area = M_PI * ball.radius * ball.radius;
    return mover;
}

class Finder {
public:
    Finder(const World& world, const Course& course) : world_(world), course_(course) {
        for (const Obstacle& obstacle : world.obstacles)
            poses_.push_back({contraction::pose_at(obstacle.motion, course.time),
                              contraction::pose_at(obstacle.motion, course.time + course.step)});
    }

    void against_obstacles(const Mover& mover) {
        for (std::size_t o = 0; o < poses_.size(); ++o) against(mover, o);
    }
    void against_ball(const Mover& mover, std::size_t ball);
    void against_body(const Mover& mover, std::size_t body, double reach);
    void ball_against_body(const Mover& mover, std::size_t body);

    Touches found;

private:
    struct Poses {
        Pose before, after;
    };
    void against(const Mover& mover, std::size_t obstacle);
    void keep(const Mover& mover, const Vec3& normal, double offset, const Vec3& start,
              Touch touch);
    // Obstacles come first, then balls, then bodies.
    [[nodiscard]] std::int32_t number_of_body(std::size_t b) const {
        return static_cast<std::int32_t>(poses_.size() + world_.balls.size() + b);
    }
    void deepen(double distance) { found.deepest = std::max(found.deepest, -distance); }

    const World& world_;
    const Course& course_;
    std::vector<Poses> poses_;  // of the obstacles, where the step begins and ends
};

void Finder::keep(const Mover& mover, const Vec3& normal, double offset, const Vec3& start,
                  Touch touch) {
    const ContactLaw& law = world_.contact;
    touch.normal = normal;
    touch.offset = offset;
    touch.gap = law.gap;
    touch.stiffness = law.stiffness * mover.area;
    touch.friction = law.friction;
    touch.start = start;
    touch.apart = normal.dot(touch.sum(course_.x)) - offset;
    found.all.push_back(touch);
}

// In the obstacle's own frame, from where it is to where it will be.
void Finder::against(const Mover& mover, std::size_t o) {
    const Obstacle& obstacle = world_.obstacles[o];
    const auto& [before, after] = poses_[o];
    const Vec3 from = before.to_rest(mover.from), by = after.to_rest(mover.to) - from;
    Apart at = apart(obstacle, from);
    deepen(at.distance - mover.radius);
    if (at.distance - mover.radius > world_.contact.gap + by.norm()) return;
    Vec3 surface = from - at.distance * at.away;
    if (obstacle.form == Form::sphere) {
        const double whole = obstacle.radius + mover.radius + world_.contact.gap;
        const double s = first_reach(from - obstacle.point, by, whole);
        at = apart(obstacle, from + (s < 0 ? 1 : s) * by);
        surface = obstacle.point + obstacle.radius * at.away;
    }
    const Vec3 normal = after.rotation * at.away;
    Touch touch = mover.touch;
    touch.who[2] = static_cast<std::int32_t>(o);
    keep(mover, normal, normal.dot(after(surface)) + mover.radius, after(from), touch);
}

void Finder::against_ball(const Mover& mover, std::size_t b) {
    const Ball& ball = world_.balls[b];
    const Vec3& centre = course_.x[ball.node];
    const Vec3 from = mover.from - centre, by = mover.to - course_.ahead[ball.node] - from;
    const double both = ball.radius + mover.radius, far = from.norm();
    deepen(far - both);
    if (far - both > world_.contact.gap + by.norm()) return;
    const double s = first_reach(from, by, both + world_.contact.gap);
    const Vec3 normal = (from + (s < 0 ? 1 : s) * by).normalized();
    Touch touch = mover.touch;
    touch.add(ball.node, -1);
    touch.who[2] = static_cast<std::int32_t>(poses_.size() + b);
    keep(mover, normal, both, from, touch);
}

void Finder::against_body(const Mover& mover, std::size_t b, double reach) {
    const Body& body = world_.bodies[b];
    const Box& box = body.proxy.box();
    const double away = (mover.from - mover.from.cwiseMax(box.min).cwiseMin(box.max)).norm();
    if (away > reach) return;
    const double deep = kDeepest * body.proxy.mean_edge();
    const Closest at = body.proxy.closest(course_.x, mover.from, std::max(reach, deep));
    if (at.triangle < 0) return;
    deepen(at.distance);
    if (at.distance > reach) return;
    const Vec3 from = mover.from - at.point;
    // On the surface itself the way there is no direction.
    const double far = std::abs(at.distance);
    const Vec3 normal = far > 1e-6 * body.proxy.mean_edge() ? Vec3(from / at.distance) : at.outward;
    Touch touch = mover.touch;
    const Triangle& n = body.proxy.triangles()[at.triangle];
    for (int c = 0; c < 3; ++c) touch.add(n[c], -at.weight[c]);
    touch.who[2] = number_of_body(b);
    keep(mover, normal, 0, from, touch);
}

// A ball may be smaller than a triangle: its centre against the surface, where on its way it
// first comes near.
void Finder::ball_against_body(const Mover& mover, std::size_t b) {
    const Body& body = world_.bodies[b];
    Vec3 shift = Vec3::Zero();  // of the body, in the mean
    for (const std::int32_t n : body.proxy.nodes()) shift += course_.ahead[n] - course_.x[n];
    shift /= static_cast<double>(body.proxy.nodes().size());
    const Vec3 by = mover.to - mover.from - shift;
    const double near = mover.radius + world_.contact.gap;
    const Box& box = body.proxy.box();
    const double away = (mover.from - mover.from.cwiseMax(box.min).cwiseMin(box.max)).norm();
    if (away > near + by.norm()) return;
    const int looks = 1 + static_cast<int>(std::ceil(kLooks * by.norm() / mover.radius));
    for (int i = 0; i <= looks; ++i) {
        const Vec3 there = mover.from + static_cast<double>(i) / looks * by;
        const Closest at =
            body.proxy.closest(course_.x, there, near + kDeepest * body.proxy.mean_edge());
        if (at.triangle < 0) continue;
        if (i == 0) deepen(at.distance - mover.radius);
        if (at.distance > near && i < looks) continue;
        const double far = std::abs(at.distance);
        const Vec3 normal =
            far > 1e-6 * mover.radius ? Vec3((there - at.point) / at.distance) : at.outward;
        Touch touch = mover.touch;
        const Triangle& n = body.proxy.triangles()[at.triangle];
        for (int c = 0; c < 3; ++c) touch.add(n[c], -at.weight[c]);
        touch.who[2] = number_of_body(b);
        keep(mover, normal, mover.radius, mover.from - at.point, touch);
        return;
    }
}

// How a body is about to move: in the mean, and how far nodes stray from that.
struct Drift {
    Vec3 mean = Vec3::Zero();
    double stray = 0;
};

Drift drift_of(const Body& body, const Course& course) {
    Drift drift;
    const auto& nodes = body.proxy.nodes();
    for (const std::int32_t n : nodes) drift.mean += course.ahead[n] - course.x[n];
    drift.mean /= static_cast<double>(nodes.size());
    for (const std::int32_t n : nodes)
        drift.stray = std::max(drift.stray, (course.ahead[n] - course.x[n] - drift.mean).norm());
    return drift;
}

bool near(const Box& a, const Box& b, double reach) {
    return ((a.min.array() - reach) <= b.max.array()).all() &&
           ((b.min.array() - reach) <= a.max.array()).all();
}

}  // namespace

Touches find_touches(World& world, const Course& course) {
    std::vector<Drift> drifts(world.bodies.size());
    parallel_for(0, world.bodies.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            world.bodies[b].proxy.follow(course.x);
            drifts[b] = drift_of(world.bodies[b], course);
        }
    });
    // Each body's samples by themselves, put together in their order.
    std::vector<Touches> parts(world.bodies.size());
    parallel_for(0, world.bodies.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t a = first; a < last; ++a) {
            Finder find(world, course);
            const Proxy& proxy = world.bodies[a].proxy;
            std::vector<std::pair<std::size_t, double>> others;
            for (std::size_t b = 0; b < world.bodies.size(); ++b) {
                const double reach = world.contact.gap + (drifts[a].mean - drifts[b].mean).norm() +
                                     drifts[a].stray + drifts[b].stray;
                if (b != a && near(proxy.box(), world.bodies[b].proxy.box(), reach))
                    others.emplace_back(b, reach);
            }
            for (std::size_t s = 0; s < proxy.samples().size(); ++s) {
                const Mover mover =
                    mover_of(proxy.samples()[s], course,
                             {static_cast<std::int32_t>(a), static_cast<std::int32_t>(s), 0});
                find.against_obstacles(mover);
                for (std::size_t b = 0; b < world.balls.size(); ++b) find.against_ball(mover, b);
                for (const auto& [body, reach] : others) find.against_body(mover, body, reach);
            }
            parts[a] = std::move(find.found);
        }
    });
    Finder find(world, course);
    for (std::size_t i = 0; i < world.balls.size(); ++i) {
        const Mover mover = mover_of(world.balls[i], course,
                                     {static_cast<std::int32_t>(world.bodies.size() + i), 0, 0});
        find.against_obstacles(mover);
        for (std::size_t j = i + 1; j < world.balls.size(); ++j) find.against_ball(mover, j);
        for (std::size_t b = 0; b < world.bodies.size(); ++b) find.ball_against_body(mover, b);
    }
    parts.push_back(std::move(find.found));
    Touches all;
    for (const Touches& part : parts) {
        all.all.insert(all.all.end(), part.all.begin(), part.all.end());
        all.deepest = std::max(all.deepest, part.deepest);
    }
    return all;
}

}  // namespace myotet::play
