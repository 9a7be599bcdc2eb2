// SPDX-License-Identifier: Apache-2.0
#include "Play/World.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "Core/Errors.h"
#include "Dynamics/ElasticBody.h"
#include "Elasticity/Masses.h"

namespace myotet::play {
namespace {

// What is empty still weighs and resists a little: its nodes must be somewhere.
constexpr double kLeastShare = 0.02;

void require(bool holds, const char* field, double value, const char* rule) {
    if (holds) return;
    std::ostringstream text;
    text << field << " is " << value << ", but " << rule;
    throw InputError(text.str());
}

std::vector<double> shares_of(const BodyShape& shape) {
    std::vector<double> share = shape.share;
    if (share.empty()) share.assign(shape.mesh.tets.size(), 1.0);
    if (share.size() != shape.mesh.tets.size())
        throw InputError(shape.name + " has " + std::to_string(shape.mesh.tets.size()) +
                         " tetrahedra, but shares of " + std::to_string(share.size()));
    for (double& s : share) {
        require(s >= 0 && s <= 1, "a share", s, "it must be from 0 to 1");
        s = std::max(s, kLeastShare);
    }
    return share;
}

void require_used(const BodyShape& shape) {
    std::vector<char> used(shape.mesh.points.size(), 0);
    for (const Tet& t : shape.mesh.tets)
        for (const std::int32_t n : t) used[n] = 1;
    const auto left = std::count(used.begin(), used.end(), 0);
    if (left > 0)
        throw MeshError(shape.name + " has " + std::to_string(left) +
                        " points of no tetrahedron; write it again without them (myotet convert "
                        "leaves them out)");
}

// Nodes, masses and surface of a body that is yet without a law.
Body& add_body(World& world, const BodyShape& shape, double density,
               std::span<const double> share) {
    MYOTET_CHECK(world.balls.empty(), "bodies come before balls");
    require_used(shape);
    const auto first = static_cast<std::int32_t>(world.rest.size());
    std::vector<Tet> tets = shape.mesh.tets;
    for (Tet& t : tets)
        for (std::int32_t& n : t) n += first;
    std::vector<double> densities;
    for (const double s : share) densities.push_back(s * density);
    const std::vector<double> masses = elasticity::nodal_masses(shape.mesh, densities);
    world.rest.insert(world.rest.end(), shape.mesh.points.begin(), shape.mesh.points.end());
    world.masses.insert(world.masses.end(), masses.begin(), masses.end());
    world.velocity.resize(world.rest.size(), Vec3::Zero());
    world.held.resize(world.rest.size(), 0);
    Proxy proxy(world.rest, tets);
    world.bodies.push_back({.name = shape.name,
                            .first_node = first,
                            .nodes = static_cast<std::int32_t>(shape.mesh.points.size()),
                            .tets = std::move(tets),
                            .elastic = nullptr,
                            .law = nullptr,
                            .points = {},
                            .proxy = std::move(proxy),
                            .detail = {},
                            .embedding = {}});
    for (const double m : masses) world.bodies.back().mass += m;
    return world.bodies.back();
}

}  // namespace

void ContactLaw::validate() const {
    require(gap >= 0 && std::isfinite(gap), "contact gap", gap,
            "it must be a length in mm of at least 0");
    require(stiffness > 0 && std::isfinite(stiffness), "contact stiffness", stiffness,
            "it must be a pressure a depth in MPa/mm above 0");
    require(friction >= 0 && friction <= 10, "friction", friction, "it must be from 0 to 10");
}

void SoftMaterial::validate() const {
    (void)elasticity::lame_from(young, poisson);
    require(density > 0 && std::isfinite(density), "density", density, "it must be above 0");
}

double World::shortest_mean_edge() const {
    double shortest = std::numeric_limits<double>::infinity();
    for (const Body& body : bodies) shortest = std::min(shortest, body.proxy.mean_edge());
    for (const Ball& ball : balls) shortest = std::min(shortest, ball.radius);
    return shortest;
}

Body& add_soft_body(World& world, BodyShape shape, const SoftMaterial& material) {
    material.validate();
    const std::vector<double> share = shares_of(shape);
    const elasticity::Lame lame = elasticity::lame_from(material.young, material.poisson);
    std::vector<elasticity::Lame> laws;
    for (const double s : share) laws.push_back({s * lame.mu, s * lame.lambda});
    Body& body = add_body(world, shape, material.density, share);
    body.elastic = std::make_unique<SoftBody>(world.rest, body.tets, laws);
    return body;
}

Body& add_muscle_body(World& world, BodyShape shape, const MuscleMaterial& material) {
    require(material.density > 0 && std::isfinite(material.density), "density", material.density,
            "it must be above 0");
    if (material.fibres.size() != shape.mesh.tets.size())
        throw InputError(shape.name + " has " + std::to_string(shape.mesh.tets.size()) +
                         " tetrahedra, but fibres of " + std::to_string(material.fibres.size()));
    const std::vector<double> share = shares_of(shape);
    elasticity::Points points = material.patches ? elasticity::patch_points(shape.mesh)
                                                 : elasticity::linear_points(shape.mesh);
    std::vector<Vec3> fibres;
    for (std::size_t q = 0; q < points.size(); ++q) {
        const Vec3& first = material.fibres[points.tets(q).front()];
        Vec3 sum = Vec3::Zero();
        double filled = 0;
        for (const std::int32_t t : points.tets(q)) {
            sum +=
                material.fibres[t].dot(first) < 0 ? Vec3(-material.fibres[t]) : material.fibres[t];
            filled += share[t];
        }
        fibres.push_back(sum.norm() > 0 ? Vec3(sum.normalized()) : first);
        points.volume[q] *= filled / static_cast<double>(points.tets(q).size());
    }
    for (std::size_t i = 0; i < points.groups.point.size(); ++i) {
        const auto tets = points.tets(points.groups.point[i]);
        points.groups.volume[i] *= share[tets.front()];
    }
    Body& body = add_body(world, shape, material.density, share);
    body.law = std::make_shared<muscle::TissueLaw>(
        std::span(&material.tissue, 1), std::vector<std::uint32_t>(points.size(), 0), fibres);
    for (std::int32_t& n : points.node) n += body.first_node;
    body.points = std::move(points);
    return body;
}

Ball& add_ball(World& world, Ball ball, const Vec3& centre, double mass) {
    require(ball.radius > 0 && std::isfinite(ball.radius), "a ball's radius", ball.radius,
            "it must be above 0");
    require(mass > 0 && std::isfinite(mass), "a ball's mass", mass, "it must be above 0");
    ball.node = static_cast<std::int32_t>(world.rest.size());
    world.rest.push_back(centre);
    world.masses.push_back(mass);
    world.velocity.push_back(Vec3::Zero());
    world.held.push_back(0);
    world.balls.push_back(std::move(ball));
    return world.balls.back();
}

void make_muscles(World& world) {
    for (Body& body : world.bodies)
        if (body.law && !body.elastic)
            body.elastic = std::make_unique<dynamics::ElasticBody>(std::move(body.points),
                                                                   world.rest.size(), body.law);
}

void hold(World& world, Body& body, std::span<const std::int32_t> nodes) {
    for (const std::int32_t n : nodes) {
        if (n < 0 || n >= body.nodes)
            throw InputError("node " + std::to_string(n) + " is to be held, but " + body.name +
                             " has " + std::to_string(body.nodes) + " nodes");
        world.held[body.first_node + n] = 1;
        body.held = true;
    }
}

TetMesh mesh_of(const Body& body, const dynamics::NodeVectors& x) {
    TetMesh mesh;
    mesh.points.assign(x.begin() + body.first_node, x.begin() + body.first_node + body.nodes);
    mesh.tets = body.tets;
    for (Tet& t : mesh.tets)
        for (std::int32_t& n : t) n -= body.first_node;
    return mesh;
}

TriMesh detail_of(const Body& body, const dynamics::NodeVectors& x) {
    if (body.detail.points.empty()) return boundary_surface(mesh_of(body, x));
    const std::span<const Vec3> nodes(x.data() + body.first_node,
                                      static_cast<std::size_t>(body.nodes));
    return {cage::deform(body.embedding, nodes), body.detail.triangles};
}

}  // namespace myotet::play
