// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "Contraction/Attach.h"
#include "Contraction/SceneContacts.h"
#include "Core/Progress.h"
#include "Dynamics/ElasticBody.h"
#include "Dynamics/NodalLoads.h"
#include "Elasticity/Viscous.h"
#include "Muscle/TissueLaw.h"

namespace myotet::contraction {

/// A body as it is simulated. Its nodes are a range of all bodies' nodes: the mesh's points,
/// then, for quadratic elements, the middles of its edges.
struct BodyModel {
    meshfiles::NamedMesh mesh;   ///< at rest; labels are the tissues' values
    std::size_t first_node = 0;  ///< of its range
    std::size_t nodes = 0;
    std::vector<Vec3> fibres;     ///< |T| unit, from origin to insertion; empty: none
    std::vector<double> volumes;  ///< |T| at rest, mm^3
    std::shared_ptr<muscle::TissueLaw> law;
    std::shared_ptr<elasticity::ViscousLaw> viscous;  ///< around it; null: no viscosity
    std::unique_ptr<dynamics::ElasticBody> elastic;
    double greatest_tension = 0;     ///< sigma_max of its muscle, MPa; 0: none
    std::vector<std::string> notes;  ///< what a user should know: a sentence each
};

/// Nodes that go with a bone, or stay.
struct HeldGroup {
    std::size_t attachment = 0;       ///< in Scene::attachments
    std::size_t body = 0;             ///< in Scene::bodies
    std::int32_t bone = -1;           ///< in Scene::bones; -1: fixed in space
    std::vector<std::int32_t> nodes;  ///< among all nodes
};

/// A scene ready to be solved.
struct Model {
    std::string fingerprint;        ///< of the scene and all that it reads
    std::vector<BodyModel> bodies;  ///< in the scene's order
    std::vector<HeldGroup> held;
    std::vector<Vec3> rest;                        ///< all nodes, mm
    std::vector<double> masses;                    ///< t
    std::unique_ptr<dynamics::NodalLoads> weight;  ///< null without gravity
    std::vector<ContactSide> contacts;
    std::vector<std::string> warnings;
    std::vector<elasticity::Points> sampled;  ///< of the bodies, while the model is built
};

/// Nodes that go with an attachment's: those at the middles of edges between them.
[[nodiscard]] std::vector<std::int32_t> with_middles(const Body& body, const TetMesh& mesh,
                                                     const std::vector<std::int32_t>& corners);

/// What a scene names, at rest and in the patient's frame.
struct SceneShapes {
    std::vector<meshfiles::NamedMesh> bodies;  ///< in the scene's order
    std::vector<BoneShape> bones;              ///< in the scene's order
    std::vector<TriMesh> bone_surfaces;        ///< closed, in the scene's order
};

/// Materials, fibres, elements and attachments of a scene whose shapes are known. Constants
/// are looked up in `materials`. Throws InputError at the scene's lines, MeshError where a
/// tetrahedron is not positive, and what the sources of fibres throw.
/// Cost: about 10 us a tetrahedron, most of it the fibres.
[[nodiscard]] Model build_model(const Scene& scene, SceneShapes shapes,
                                const std::filesystem::path& materials, ProgressSink& progress);

}  // namespace myotet::contraction
