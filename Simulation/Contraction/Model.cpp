// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Model.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "Contraction/BodyFibres.h"
#include "Contraction/Materials.h"
#include "Contraction/Words.h"
#include "Core/Errors.h"
#include "Elasticity/Masses.h"
#include "LevelSet/FromSurface.h"

namespace myotet::contraction {
namespace {

using elasticity::Points;
using muscle::TissueMaterial;

// The material of each tetrahedron, as an index into the body's materials.
struct BodyMaterials {
    std::vector<TissueMaterial> materials;
    std::vector<double> density;    // of each, t/mm^3
    std::vector<double> viscosity;  // of each, MPa s
    std::vector<std::uint32_t> of_tet;
};

const Material& find_material(const Scene& scene, const std::string& name) {
    return *std::ranges::find(scene.materials, name, &Material::name);
}

BodyMaterials materials_of(const Scene& scene, const Body& body, const meshfiles::NamedMesh& mesh,
                           const std::filesystem::path& folder, Model& model) {
    BodyMaterials made;
    std::map<std::int32_t, std::uint32_t> of_label;
    for (const MaterialOf& material : body.materials) {
        const auto index = static_cast<std::uint32_t>(made.materials.size());
        const Material& known = find_material(scene, material.material.name);
        made.materials.push_back(material_of(scene, known, folder));
        made.density.push_back(known.density);
        made.viscosity.push_back(known.viscosity);
        const std::string why = muscle::ill_posed(made.materials.back());
        if (!why.empty())
            model.warnings.push_back("material '" + known.name + "' of " + body.name + ": " + why);
        if (material.tissue.empty()) {
            made.of_tet.assign(mesh.mesh.tets.size(), index);
            return made;
        }
        const Named tissue{material.tissue, material.material.line};
        of_label[find_label(scene, tissue, mesh.names)] = index;
    }
    for (const std::int32_t label : mesh.mesh.labels) {
        const auto found = of_label.find(label);
        if (found == of_label.end()) {
            const auto name = mesh.names.find(label);
            refuse(scene, body.line,
                   "no material is named for the tissue " +
                       (name == mesh.names.end() ? std::to_string(label) : name->second) + " of " +
                       body.name + "; name one in 'material'");
        }
        made.of_tet.push_back(found->second);
    }
    return made;
}

// Elements of a body, and where its nodes are.
struct Sampled {
    Points points;
    std::vector<Vec3> rest;
    std::vector<double> masses;
};

Sampled sample(const Body& body, const TetMesh& mesh, const BodyMaterials& materials) {
    // Patches are of one material.
    TetMesh by_material{mesh.points, mesh.tets, {}};
    std::vector<double> density;
    for (const std::uint32_t m : materials.of_tet) {
        by_material.labels.push_back(static_cast<std::int32_t>(m));
        density.push_back(materials.density[m]);
    }
    if (body.elements == Elements::quadratic) {
        const elasticity::QuadraticMesh quadratic = elasticity::quadratic_mesh(mesh);
        return {elasticity::quadratic_points(quadratic), quadratic.points,
                elasticity::nodal_masses(quadratic, density)};
    }
    Points points = body.elements == Elements::linear ? elasticity::linear_points(by_material)
                                                      : elasticity::patch_points(by_material);
    return {std::move(points), mesh.points, elasticity::nodal_masses(mesh, density)};
}

void shift(std::size_t by, Points& points) {
    for (std::int32_t& node : points.node) node += static_cast<std::int32_t>(by);
}

// Rest nodes of no tetrahedron would have neither mass nor stiffness.
void require_used(const Scene& scene, const Body& body, const TetMesh& mesh) {
    std::vector<char> used(mesh.points.size(), 0);
    for (const Tet& tet : mesh.tets)
        for (const std::int32_t n : tet) used[n] = 1;
    const auto left = std::ranges::count(used, 0);
    if (left > 0)
        refuse(scene, body.line,
               "the mesh of " + body.name + " has " + std::to_string(left) +
                   " points of no tetrahedron; write it again without them (myotet convert "
                   "leaves them out)");
}

void require_positive(const Scene& scene, const Body& body, const TetMesh& mesh) {
    std::size_t inverted = 0, first = 0;
    for (std::size_t t = mesh.tets.size(); t-- > 0;) {
        const Tet& n = mesh.tets[t];
        const auto& p = mesh.points;
        if (signed_volume(p[n[0]], p[n[1]], p[n[2]], p[n[3]]) > 0) continue;
        ++inverted;
        first = t;
    }
    if (inverted > 0)
        refuse(scene, body.line,
               "the mesh of " + body.name + " has " + std::to_string(inverted) +
                   " inverted or flat tetrahedra, the first is number " + std::to_string(first) +
                   " (from 0); mesh it again, myotet quality shows them");
}

// Fibre directions at the points: means over their tetrahedra.
std::vector<Vec3> fibres_of_points(const Points& points, const std::vector<Vec3>& of_tets) {
    std::vector<Vec3> fibres(points.size(), Vec3::Zero());
    if (of_tets.empty()) return fibres;
    for (std::size_t q = 0; q < points.size(); ++q) {
        const Vec3& first = of_tets[points.tets(q).front()];
        Vec3 sum = Vec3::Zero();
        for (const std::int32_t t : points.tets(q))
            sum += of_tets[t].dot(first) < 0 ? Vec3(-of_tets[t]) : of_tets[t];
        fibres[q] = sum.norm() > 0 ? Vec3(sum.normalized()) : first;
    }
    return fibres;
}

void require_fibres(const Scene& scene, const Body& body, const BodyMaterials& materials) {
    if (body.fibres.from != FibreSource::none) return;
    for (const TissueMaterial& material : materials.materials)
        if (material.fibres != muscle::FibreCurve::none)
            refuse(scene, body.line,
                   body.name +
                       " is of a material with fibres, but 'fibres' does not say where "
                       "they run; add 'fibres: {from: laplace}', for one");
}

void add_body(const Scene& scene, std::size_t b, meshfiles::NamedMesh mesh,
              std::span<const BoneShape> bones, const std::filesystem::path& folder, Model& model) {
    const Body& body = scene.bodies[b];
    require_used(scene, body, mesh.mesh);
    require_positive(scene, body, mesh.mesh);
    const BodyMaterials materials = materials_of(scene, body, mesh, folder, model);
    require_fibres(scene, body, materials);
    const std::vector<HeldNodes> held = find_held_nodes(scene, body, mesh, bones);

    BodyModel made;
    made.fibres = find_fibres(scene, body, mesh.mesh, held, made.notes);
    Sampled sampled = sample(body, mesh.mesh, materials);
    std::vector<std::uint32_t> material;
    for (std::size_t q = 0; q < sampled.points.size(); ++q)
        material.push_back(materials.of_tet[sampled.points.tets(q).front()]);
    made.law = std::make_shared<muscle::TissueLaw>(materials.materials, material,
                                                   fibres_of_points(sampled.points, made.fibres));
    if (body.force_velocity) made.law->set_force_velocity(*body.force_velocity);
    std::vector<double> viscosity;
    for (const std::uint32_t m : material) viscosity.push_back(materials.viscosity[m]);
    if (std::ranges::any_of(viscosity, [](double eta) { return eta > 0; }))
        made.viscous = std::make_shared<elasticity::ViscousLaw>(made.law, std::move(viscosity));
    for (const TissueMaterial& m : materials.materials)
        made.greatest_tension = std::max(made.greatest_tension, m.sigma_max);
    for (const Tet& n : mesh.mesh.tets)
        made.volumes.push_back(signed_volume(mesh.mesh.points[n[0]], mesh.mesh.points[n[1]],
                                             mesh.mesh.points[n[2]], mesh.mesh.points[n[3]]));

    made.first_node = model.rest.size();
    made.nodes = sampled.rest.size();
    shift(made.first_node, sampled.points);
    model.rest.insert(model.rest.end(), sampled.rest.begin(), sampled.rest.end());
    model.masses.insert(model.masses.end(), sampled.masses.begin(), sampled.masses.end());
    for (const HeldNodes& nodes : held) {
        HeldGroup group{nodes.attachment, b, -1, with_middles(body, mesh.mesh, nodes.nodes)};
        const std::string& bone = scene.attachments[nodes.attachment].bone;
        if (!bone.empty())
            group.bone = static_cast<std::int32_t>(
                std::ranges::find(scene.bones, bone, &Bone::name) - scene.bones.begin());
        for (std::int32_t& n : group.nodes) n += static_cast<std::int32_t>(made.first_node);
        model.held.push_back(std::move(group));
    }
    made.mesh = std::move(mesh);
    model.bodies.push_back(std::move(made));
    // The elements are made when the number of all nodes is known.
    model.bodies.back().elastic = nullptr;
    model.sampled.push_back(std::move(sampled.points));
}

}  // namespace

std::vector<std::int32_t> with_middles(const Body& body, const TetMesh& mesh,
                                       const std::vector<std::int32_t>& corners) {
    if (body.elements != Elements::quadratic) return corners;
    std::vector<char> held(mesh.points.size(), 0);
    for (const std::int32_t n : corners) held[n] = 1;
    constexpr int ends[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    std::vector<std::int32_t> all = corners;
    const elasticity::QuadraticMesh quadratic = elasticity::quadratic_mesh(mesh);
    for (const auto& ten : quadratic.tets)
        for (int e = 0; e < 6; ++e)
            if (held[ten[ends[e][0]]] && held[ten[ends[e][1]]]) all.push_back(ten[4 + e]);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

namespace {

// Samples of a shape's level set along the square root of its surface's area.
constexpr double kSamplesAcross = 150;

ContactField field_of(const Scene& scene, const Contact& contact, const std::string& name,
                      const TriMesh& surface) {
    double area = 0;
    for (const Triangle& t : surface.triangles)
        area += 0.5 * (surface.points[t[1]] - surface.points[t[0]])
                          .cross(surface.points[t[2]] - surface.points[t[0]])
                          .norm();
    SilentProgress silent;
    try {
        return {std::make_shared<const levelset::LevelSet>(levelset::from_surface(
                    surface, {.spacing = std::sqrt(area) / kSamplesAcross}, silent, nullptr)),
                Frame{}};
    } catch (const InputError& error) {
        refuse(scene, contact.line,
               "the surface of " + name + " cannot be touched: " + error.what());
    }
}

// Linear tetrahedra of a body among all nodes, as contact sees it.
std::vector<Tet> tets_of(const Body& body, const BodyModel& model) {
    std::vector<Tet> tets = body.elements == Elements::quadratic
                                ? linear_pieces(elasticity::quadratic_mesh(model.mesh.mesh))
                                : model.mesh.mesh.tets;
    for (Tet& tet : tets)
        for (std::int32_t& n : tet) n += static_cast<std::int32_t>(model.first_node);
    return tets;
}

// Nodes of body `a` against `name`, a bone or a body.
ContactSide side_of(const Scene& scene, std::size_t c, std::size_t a, const std::string& name,
                    std::span<const TriMesh> bones, const Model& model) {
    ContactSide side;
    side.contact = c;
    std::vector<std::int32_t> held;
    for (const HeldGroup& group : model.held)
        held.insert(held.end(), group.nodes.begin(), group.nodes.end());
    std::sort(held.begin(), held.end());
    side.nodes =
        contact_nodes(model.rest, boundary_faces(tets_of(scene.bodies[a], model.bodies[a])), held);
    const auto bone = std::ranges::find(scene.bones, name, &Bone::name);
    if (bone != scene.bones.end()) {
        side.bone = static_cast<std::int32_t>(bone - scene.bones.begin());
        side.other = field_of(scene, scene.contacts[c], name, bones[side.bone]);
        return side;
    }
    const auto b = static_cast<std::size_t>(std::ranges::find(scene.bodies, name, &Body::name) -
                                            scene.bodies.begin());
    side.tets = tets_of(scene.bodies[b], model.bodies[b]);
    side.other =
        field_of(scene, scene.contacts[c], name, boundary_surface(model.bodies[b].mesh.mesh));
    return side;
}

void add_contacts(const Scene& scene, std::span<const TriMesh> bones, Model& model) {
    const auto body_of = [&](const std::string& name) {
        return std::ranges::find(scene.bodies, name, &Body::name);
    };
    for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
        const Contact& contact = scene.contacts[c];
        for (const auto& [one, other] :
             {std::pair{contact.a, contact.b}, std::pair{contact.b, contact.a}})
            if (const auto body = body_of(one); body != scene.bodies.end())
                model.contacts.push_back(
                    side_of(scene, c, static_cast<std::size_t>(body - scene.bodies.begin()), other,
                            bones, model));
    }
}

}  // namespace

Model build_model(const Scene& scene, SceneShapes shapes, const std::filesystem::path& materials,
                  ProgressSink& progress) {
    Model model;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        progress.report("preparing",
                        static_cast<double>(b) / static_cast<double>(scene.bodies.size()));
        add_body(scene, b, std::move(shapes.bodies[b]), shapes.bones, materials, model);
    }
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        BodyModel& body = model.bodies[b];
        std::shared_ptr<const elasticity::PointLaw> law = body.law;
        if (body.viscous) law = body.viscous;
        body.elastic = std::make_unique<dynamics::ElasticBody>(std::move(model.sampled[b]),
                                                               model.rest.size(), law);
    }
    model.sampled.clear();
    add_contacts(scene, shapes.bone_surfaces, model);
    if (!scene.gravity.isZero()) {
        model.weight = std::make_unique<dynamics::NodalLoads>(model.rest.size());
        for (std::size_t n = 0; n < model.rest.size(); ++n)
            model.weight->forces()[n] = model.masses[n] * scene.gravity;
    }
    model.fingerprint = fingerprint(scene, materials);
    progress.report("preparing", 1);
    return model;
}

}  // namespace myotet::contraction
