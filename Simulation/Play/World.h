// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "Cage/Embedding.h"
#include "Contraction/Curve.h"
#include "Elasticity/Points.h"
#include "Muscle/TissueLaw.h"
#include "Play/Obstacle.h"
#include "Play/Proxy.h"
#include "Play/SoftBody.h"

namespace myotet::play {

/// A body: a mesh of tetrahedra that is simulated and collided with, and the detail in it.
struct Body {
    std::string name;
    std::int32_t first_node = 0;  ///< of its nodes among all
    std::int32_t nodes = 0;
    std::vector<Tet> tets;                         ///< over all nodes
    std::unique_ptr<dynamics::Potential> elastic;  ///< of a muscle: by make_muscles
    std::shared_ptr<muscle::TissueLaw> law;        ///< of a muscle; null: passive
    elasticity::Points points;                     ///< of a muscle, until it is made
    contraction::Curve activation = contraction::constant_curve(0);
    Proxy proxy;
    TriMesh detail;             ///< at rest; without points: the mesh's own surface is shown
    cage::Embedding embedding;  ///< of the detail, in the body's own nodes
    double mass = 0;            ///< t
    bool held = false;          ///< some of its nodes are
};

/// How surfaces keep apart.
struct ContactLaw {
    double gap = 0;        ///< at which they begin to push, mm
    double stiffness = 0;  ///< pressure a depth below it, MPa/mm
    double friction = 0;   ///< coefficient of Coulomb's
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// All that moves or is in the way. Nodes are those of the bodies in their order, then the
/// balls' centres.
struct World {
    std::vector<Body> bodies;
    std::vector<Ball> balls;
    std::vector<Obstacle> obstacles;
    std::vector<Vec3> rest;       ///< where nodes begin, mm; bodies are undeformed there
    std::vector<Vec3> velocity;   ///< at the beginning, mm/s
    std::vector<double> masses;   ///< t
    std::vector<char> held;       ///< nodes that stay
    Vec3 gravity = Vec3::Zero();  ///< mm/s^2
    ContactLaw contact;

    [[nodiscard]] double shortest_mean_edge() const;  ///< of the bodies, mm
};

/// A passive material.
struct SoftMaterial {
    double young = 0.05;    ///< MPa
    double poisson = 0.45;  ///< -1 to 0.5
    double density = 1e-9;  ///< t/mm^3
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// A muscle's law and its fibres at rest, |T| unit vectors.
struct MuscleMaterial {
    muscle::TissueMaterial tissue;
    std::vector<Vec3> fibres;
    double density = 1.06e-9;  ///< t/mm^3
    bool patches = true;       ///< free of locking, see elasticity::patch_points
};

/// A mesh that becomes a body: |T| `share`s, 0 to 1, of each tetrahedron are filled, of its
/// stiffness and mass only that much is taken; none: all is.
struct BodyShape {
    std::string name;
    TetMesh mesh;
    std::vector<double> share;
};

// Each adds nodes at the end of all, at rest and with their masses, and returns what it added,
// which stays where it is until the next is added. Bodies come before balls. Throw InputError
// where a material breaks a rule or shares are not one a tetrahedron, MeshError where a
// tetrahedron is not positive or a point belongs to none.

/// Neo-Hookean, linear tetrahedra.
Body& add_soft_body(World& world, BodyShape shape, const SoftMaterial& material);
/// Of a TissueLaw; complete after make_muscles.
Body& add_muscle_body(World& world, BodyShape shape, const MuscleMaterial& material);
/// A ball of a mass, t.
Ball& add_ball(World& world, Ball ball, const Vec3& centre, double mass);

/// Makes the elements of all muscles, once all nodes are there.
void make_muscles(World& world);

/// Holds nodes of a body, by their numbers in its mesh. Throws InputError when one is not there.
void hold(World& world, Body& body, std::span<const std::int32_t> nodes);

/// A body's mesh where its nodes are, and its detail there (its own surface where there is none).
[[nodiscard]] TetMesh mesh_of(const Body& body, const dynamics::NodeVectors& x);
[[nodiscard]] TriMesh detail_of(const Body& body, const dynamics::NodeVectors& x);

}  // namespace myotet::play
