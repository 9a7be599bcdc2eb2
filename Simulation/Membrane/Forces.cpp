// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Forces.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "Membrane/Contact.h"

namespace myotet::membrane {

namespace {

// Returns what they hold, N mm; so does add_shape.
double add_springs(const Active& active, const Motion& motion, std::vector<Vec3>& force) {
    double held = 0;
    for (const Spring& s : active.springs) {
        const Vec3 dx = motion.x[s.a] - motion.x[s.b];
        const double length = dx.norm();
        if (!(length > 0)) continue;
        // g = -[k_s (|dx| - r) + k_d dv . dx / |dx|] dx / |dx|  [Choi05, eq. 2]
        const double tension = s.stiffness * (length - s.rest);
        const double pull = tension + s.damping * (motion.v[s.a] - motion.v[s.b]).dot(dx) / length;
        const Vec3 g = (-pull / length) * dx;
        force[s.a] += g;
        force[s.b] -= g;
        held += tension * (length - s.rest);
    }
    return held / 2;
}

double add_shape(const Body& body, const Motion& motion, std::vector<Vec3>& force) {
    const Wall& wall = body.wall;
    const double per_mass = wall.shape_stiffness * area_of_mass(wall);
    double held = 0;
    for (const std::int32_t i : body.active.nodes) {
        const double mass = body.active.mass[i], stiffness = per_mass * mass;
        const Vec3 dx = motion.x[i] - body.levels.rest[i];
        // g = -[k' |dx| + k_d' v . dx / |dx|] dx / |dx|  [Choi05, eq. 10]
        const double square = dx.squaredNorm();
        const double along = square > 0 ? motion.v[i].dot(dx) / square : 0;
        force[i] -=
            stiffness * (1 + wall.shape_damping_time * along) * dx + wall.drag * mass * motion.v[i];
        held += stiffness * square;
    }
    return held / 2;
}

void add_patches(const Body& body, double time, std::vector<Vec3>& force) {
    const Loads& loads = body.loads;
    for (std::size_t p = 0; p < loads.patches.size(); ++p) {
        const double strength = strength_at(loads.patches[p], time);
        if (strength == 0) continue;
        for (const auto& [node, share] : body.patches[p])
            force[node] += strength * share * loads.patches[p].force;
    }
}

// Gravity, and pressure times the gradient of the volume.
void add_fields(const Body& body, const Motion& motion, std::vector<Vec3>& force) {
    const Loads& loads = body.loads;
    if (loads.gravity.squaredNorm() > 0)
        for (const std::int32_t i : body.active.nodes)
            force[i] += body.active.mass[i] * loads.gravity;
    if (loads.pressure == 0 && loads.bulk == 0) return;
    const double sixth = cavity_pressure(body, cavity_volume(body, motion.x)) / 6;
    for (const auto& [a, b, c] : body.active.drawn) {
        const Vec3 g = sixth * (motion.x[b] - motion.x[a]).cross(motion.x[c] - motion.x[a]);
        force[a] += g;
        force[b] += g;
        force[c] += g;
    }
}

void share_patches(Body& body) {
    body.patches.clear();
    for (const PatchForce& patch : body.loads.patches) {
        auto& shares = body.patches.emplace_back();
        double sum = 0;
        for (const std::int32_t i : body.active.nodes) {
            const double part =
                (body.levels.rest[i] - patch.centre).squaredNorm() / (patch.radius * patch.radius);
            if (!(part < 1)) continue;
            shares.emplace_back(i, body.active.mass[i] * (1 - part));
            sum += shares.back().second;
        }
        for (auto& [node, share] : shares) share /= sum;
    }
}

double drawn_volume(const Active& active, std::span<const Vec3> x) {
    double six = 0;
    for (const auto& [a, b, c] : active.drawn) six += x[a].dot(x[b].cross(x[c]));
    return six / 6;
}

// The wall against itself: (u - sum w v)^2 <= 2 u^2 + 2 sum w v^2, the weights w of corners
// being one together; as if one node stood on each corner.
void add_facing(const Body& body, std::vector<Mat3>& stiffness) {
    const double per_mass = 2 * body.wall.contact_stiffness * area_of_mass(body.wall);
    std::vector<double> most(body.facing.nodes.empty() ? 0 : stiffness.size(), 0);
    for (const Facing& facing : body.facing.nodes) {
        const double here = per_mass * body.active.mass[facing.node];
        stiffness[facing.node].diagonal().array() += here;
        for (std::size_t p = facing.first; p < facing.last; ++p)
            for (const std::int32_t v : body.facing.parts[p].corners)
                most[v] = std::max(most[v], here);
    }
    for (std::size_t v = 0; v < most.size(); ++v) stiffness[v].diagonal().array() += most[v];
}

}  // namespace

void prepare(Body& body) {
    share_patches(body);
    if (!body.levels.meshes[0].closed()) return;
    if (body.rest_volume == 0) body.rest_volume = volume(body.levels.surface(body.levels.finest()));
    body.drawn_rest_volume = drawn_volume(body.active, body.levels.rest);
}

double cavity_volume(const Body& body, std::span<const Vec3> x) {
    if (!body.levels.meshes[0].closed()) return 0;
    return body.rest_volume + drawn_volume(body.active, x) - body.drawn_rest_volume;
}

double cavity_pressure(const Body& body, double volume) {
    if (body.loads.bulk == 0) return body.loads.pressure;
    return body.loads.pressure + body.loads.bulk * (1 - volume / body.rest_volume);
}

void follow(const Active& active, Motion& motion) {
    for (const Hanging& h : active.hanging) {
        const Vec3 edge = motion.x[h.b] - motion.x[h.a];
        motion.x[h.node] = 0.5 * (motion.x[h.a] + motion.x[h.b]) + turned_offset(h, edge);
        motion.v[h.node] = 0.5 * (motion.v[h.a] + motion.v[h.b]) +
                           turned_by(h, edge, motion.v[h.b] - motion.v[h.a]);
    }
}

double find_forces(const Body& body, const Motion& motion, NodeForces& forces) {
    for (const std::int32_t i : body.active.nodes) forces.pressing[i].setZero();
    add_patches(body, motion.time, forces.pressing);
    add_tools(body, motion, forces.pressing);
    for (const std::int32_t i : body.active.nodes) forces.external[i] = forces.pressing[i];
    add_fields(body, motion, forces.external);
    for (const std::int32_t i : body.active.nodes) forces.total[i] = forces.external[i];
    const double held =
        add_springs(body.active, motion, forces.total) + add_shape(body, motion, forces.total) +
        add_self_contact(body.facing, body.wall, body.active, motion.x, forces.total);
    for (std::size_t k = body.active.hanging.size(); k-- > 0;) {
        const Hanging& h = body.active.hanging[k];
        const Vec3 force = forces.total[h.node],
                   couple = couple_of(h, motion.x[h.b] - motion.x[h.a], force);
        forces.total[h.a] += 0.5 * force - couple;
        forces.total[h.b] += 0.5 * force + couple;
    }
    return held;
}

double kinetic_energy(const Body& body, const Motion& motion) {
    double sum = 0;
    for (const std::int32_t i : body.active.nodes)
        sum += 0.5 * body.active.inertia[i] * motion.v[i].squaredNorm();
    return sum;
}

double stable_step(const Body& body) {
    constexpr double kReach = 2.5;
    const Wall& wall = body.wall;
    const Active& active = body.active;
    const double per_mass = area_of_mass(wall);
    double same = wall.shape_stiffness, mass = 0;  // what all nodes have, by area
    for (const Tool& tool : body.loads.tools) same += tool.stiffness;
    for (const std::int32_t i : active.nodes) mass += active.mass[i];
    const double filling =
        body.rest_volume > 0 ? body.loads.bulk * mass * per_mass / body.rest_volume : 0;
    std::vector<Mat3> stiffness(active.mass.size(), Mat3::Zero()), damping = stiffness;
    for (const std::int32_t i : active.nodes) {
        const double area = per_mass * active.mass[i];
        stiffness[i].diagonal().setConstant((same + filling) * area);
        damping[i].diagonal().setConstant(wall.shape_stiffness * wall.shape_damping_time * area +
                                          wall.drag * active.mass[i]);
    }
    for (const Spring& s : active.springs) {
        const Vec3 n = (body.levels.rest[s.a] - body.levels.rest[s.b]).normalized();
        for (const std::int32_t i : {s.a, s.b}) {
            stiffness[i] += 2 * s.stiffness * n * n.transpose();
            damping[i] += 2 * s.damping * n * n.transpose();
        }
    }
    add_facing(body, stiffness);
    for (std::size_t k = active.hanging.size(); k-- > 0;)
        for (const std::int32_t i : {active.hanging[k].a, active.hanging[k].b}) {
            stiffness[i] += stiffness[active.hanging[k].node] / 2;
            damping[i] += damping[active.hanging[k].node] / 2;
        }
    const auto largest = [](const Mat3& m) {
        return Eigen::SelfAdjointEigenSolver<Mat3>(m, Eigen::EigenvaluesOnly).eigenvalues()[2];
    };
    double rate = 0;
    for (const std::int32_t i : active.nodes)
        if (active.inertia[i] > 0)
            rate = std::max({rate, std::sqrt(largest(stiffness[i]) / active.inertia[i]),
                             largest(damping[i]) / active.inertia[i]});
    return kReach / rate;
}

}  // namespace myotet::membrane
