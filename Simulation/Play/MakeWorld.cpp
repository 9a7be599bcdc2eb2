// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "Contraction/Materials.h"
#include "Contraction/Words.h"
#include "Core/Errors.h"
#include "Fibres/Laplace.h"
#include "MeshFiles/MeshFiles.h"
#include "Play/PlayScene.h"

namespace myotet::play {
namespace fs = std::filesystem;

namespace {

constexpr double kGapOfEdge = 0.05;
// Pressure by a depth of one edge, in moduli.
constexpr double kStiffness = 10;

// What a body's copies share.
struct Parts {
    TetMesh mesh;
    TriMesh surface;
    double volume = 0;  // of the surface, mm^3
    cage::Embedding embedding;
    std::optional<MuscleMaterial> muscle;
    double modulus = 0;  // MPa
};

std::vector<std::int32_t> nodes_near(const PlayScene& scene, const SceneBody& body,
                                     const TetMesh& mesh, const NearPlane& plane) {
    std::vector<std::int32_t> nodes;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
        const double away = std::abs(plane.normal.dot(mesh.points[n] - plane.point));
        nearest = std::min(nearest, away);
        if (away <= plane.within) nodes.push_back(static_cast<std::int32_t>(n));
    }
    if (nodes.empty())
        refuse(scene.file, plane.line,
               "no node of " + body.name + " is within " + shown(plane.within) +
                   " mm of the plane, the nearest is " + rounded(nearest) +
                   " mm away; write 'within' larger");
    return nodes;
}

muscle::TissueMaterial tissue_of(const PlayScene& scene, const SceneMuscle& muscle,
                                 const fs::path& materials) {
    contraction::Scene named;
    named.file = scene.file;
    return contraction::material_of(named, {.name = muscle.model.name, .model = muscle.model},
                                    materials);
}

MuscleMaterial material_of(const PlayScene& scene, const SceneBody& body, const TetMesh& mesh,
                           const fs::path& materials, std::vector<std::string>& notes) {
    const SceneMuscle& muscle = *body.muscle;
    MuscleMaterial material;
    material.tissue = tissue_of(scene, muscle, materials);
    material.density = body.density;
    material.patches = muscle.patches;
    fibres::FibreField field;
    if (muscle.direction.isZero(0)) {
        try {
            field = fibres::laplace_fibres(mesh, nodes_near(scene, body, mesh, muscle.origin),
                                           nodes_near(scene, body, mesh, muscle.insertion));
        } catch (const Error& error) {
            refuse(scene.file, body.line, "fibres of " + body.name + ": " + error.what());
        }
    } else {
        field = fibres::constant_fibres(mesh, muscle.direction);
    }
    for (const std::string& note : field.notes) notes.push_back(body.name + ": " + note);
    material.fibres = std::move(field.direction);
    return material;
}

void require_positive(const PlayScene& scene, const SceneBody& body, const TetMesh& mesh) {
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const Tet& n = mesh.tets[t];
        const auto& p = mesh.points;
        if (!(signed_volume(p[n[0]], p[n[1]], p[n[2]], p[n[3]]) > 0))
            refuse(scene.file, body.line,
                   "tetrahedron " + std::to_string(t) + " of " + body.cage.string() +
                       " is flat or inverted; mesh it again, myotet quality shows it");
    }
}

void read_surface(const PlayScene& scene, const SceneBody& body, Parts& parts,
                  std::vector<std::string>& notes) {
    if (body.surface.empty()) return;
    parts.surface = meshfiles::read_surface(body.surface);
    parts.volume = volume(parts.surface);
    parts.embedding = cage::embed(parts.mesh, parts.surface.points, cage::Outside::nearest);
    if (!(parts.volume > 0))
        refuse(scene.file, body.line,
               "the surface " + body.surface.string() + " encloses " + rounded(parts.volume) +
                   " mm^3, but must be closed and outward; turn or close it");
    if (parts.embedding.outside > 0)
        notes.push_back(body.name + ": " + std::to_string(parts.embedding.outside) + " of " +
                        std::to_string(parts.embedding.size()) +
                        " points of the surface lie outside of the cage, by up to " +
                        rounded(parts.embedding.farthest) +
                        " mm; they go with the nearest tetrahedron");
}

Parts read_parts(const PlayScene& scene, const SceneBody& body, const fs::path& materials,
                 std::vector<std::string>& notes) {
    Parts parts;
    parts.mesh = meshfiles::read_mesh(body.cage).mesh;
    parts.mesh.labels.clear();
    require_positive(scene, body, parts.mesh);
    read_surface(scene, body, parts, notes);
    if (body.soft) {
        parts.modulus = body.soft->young;
    } else {
        parts.muscle = material_of(scene, body, parts.mesh, materials, notes);
        const muscle::TissueMaterial& tissue = parts.muscle->tissue;
        parts.modulus = 6 * (tissue.C1 + tissue.C2) + tissue.sigma_max;
    }
    return parts;
}

// A cage is larger than what it encloses, and weighs and resists as much as that does.
std::vector<double> shares_of(const Parts& parts) {
    if (parts.volume == 0) return {};
    const double share = std::min(1.0, parts.volume / volume(parts.mesh));
    return std::vector<double>(parts.mesh.tets.size(), share);
}

void add_copy(World& world, const PlayScene& scene, const SceneBody& body, const Parts& parts,
              std::size_t copy) {
    const Place& place = body.places[copy];
    BodyShape shape{body.name, parts.mesh, shares_of(parts)};
    if (body.places.size() > 1) shape.name += "_" + std::to_string(copy + 1);
    for (Vec3& p : shape.mesh.points) p = place.pose(p);
    Body* made = nullptr;
    if (parts.muscle) {
        MuscleMaterial material = *parts.muscle;
        for (Vec3& fibre : material.fibres) fibre = place.pose.rotation * fibre;
        made = &add_muscle_body(world, std::move(shape), material);
        made->activation = body.muscle->activation;
    } else {
        made = &add_soft_body(world, std::move(shape), *body.soft);
    }
    made->detail = parts.surface;
    for (Vec3& p : made->detail.points) p = place.pose(p);
    made->embedding = parts.embedding;
    for (std::int32_t n = 0; n < made->nodes; ++n)
        world.velocity[made->first_node + n] = place.velocity;
    // Planes are of the mesh as its file has it.
    for (const NearPlane& plane : body.hold)
        hold(world, *made, nodes_near(scene, body, parts.mesh, plane));
    if (std::all_of(world.held.begin() + made->first_node, world.held.end(),
                    [](char held) { return held != 0; }))
        refuse(scene.file, body.line,
               "all nodes of " + made->name + " are held, but one must move; hold fewer");
}

}  // namespace

MadeWorld make_world(const PlayScene& scene, const fs::path& materials) {
    MadeWorld made;
    World& world = made.world;
    double modulus = 0;
    for (const SceneBody& body : scene.bodies) {
        const Parts parts = read_parts(scene, body, materials, made.notes);
        modulus = std::max(modulus, parts.modulus);
        for (std::size_t copy = 0; copy < body.places.size(); ++copy)
            add_copy(world, scene, body, parts, copy);
    }
    for (const SceneBall& ball : scene.balls) {
        (void)add_ball(world, {.name = ball.name, .radius = ball.radius}, ball.centre, ball.mass);
        world.velocity.back() = ball.velocity;
    }
    // What is held has no velocity.
    for (std::size_t n = 0; n < world.held.size(); ++n)
        if (world.held[n]) world.velocity[n].setZero();
    world.obstacles = scene.obstacles;
    world.gravity = scene.gravity;
    const double edge = world.shortest_mean_edge();
    world.contact = {.gap = scene.contact.gap.value_or(kGapOfEdge * edge),
                     .stiffness = scene.contact.stiffness.value_or(kStiffness * modulus / edge),
                     .friction = scene.contact.friction};
    make_muscles(world);
    return made;
}

}  // namespace myotet::play
