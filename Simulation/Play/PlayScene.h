// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>

#include "Contraction/Scene.h"
#include "Play/World.h"

namespace myotet::play {

using contraction::Named;

/// Nodes so near a plane on either side.
struct NearPlane {
    Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();  ///< mm, unit
    double within = 0;                                  ///< mm
    int line = 0;
};

/// A muscle's law by its name, and what drives it.
struct SceneMuscle {
    Named model;
    Vec3 direction = Vec3::Zero();  ///< of constant fibres; zero: from a Laplace field between
    NearPlane origin, insertion;    ///< these ends
    contraction::Curve activation = contraction::constant_curve(0);
    std::filesystem::path activation_file;  ///< it was read from; empty: the scene
    bool patches = true;
};

/// Where a body is put: its mesh, turned and then shifted.
struct Place {
    Pose pose;
    Vec3 velocity = Vec3::Zero();  ///< mm/s
};

struct SceneBody {
    std::string name;
    std::filesystem::path cage;     ///< of tetrahedra
    std::filesystem::path surface;  ///< that rides in it; empty: none
    std::optional<SoftMaterial> soft;
    std::optional<SceneMuscle> muscle;
    double density = 1e-9;  ///< t/mm^3
    std::vector<Place> places{Place{}};
    std::vector<NearPlane> hold;
    int line = 0;
};

struct SceneBall {
    std::string name;
    Vec3 centre = Vec3::Zero(), velocity = Vec3::Zero();  ///< mm, mm/s
    double radius = 0, mass = 0;                          ///< mm, t
};

/// What is not given follows from the bodies: see make_world.
struct SceneContact {
    std::optional<double> gap, stiffness;
    double friction = 0.3;
};

/// What is played: lists are in the file's order.
struct PlayScene {
    std::filesystem::path file;
    std::string title;
    std::vector<SceneBody> bodies;
    std::vector<Obstacle> obstacles;
    std::vector<SceneBall> balls;
    SceneContact contact;
    Vec3 gravity{0, 0, -9810};                   ///< mm/s^2
    double end = 0, step = 1.0 / 60, every = 0;  ///< s
    int iterations = 8;                          ///< of Newton's method in a step, at most
    std::string view = "front";  ///< from where pictures look: front, left, right, back
};

/// Reads a scene (YAML; keys, units and defaults in the README). Paths in it are relative to
/// its folder. Throws IoError when a file cannot be read, InputError "scene.yaml:12: ..."
/// with the value, the rule it breaks and the remedy.
[[nodiscard]] PlayScene read_play_scene(const std::filesystem::path& file);

/// A scene with the meshes it names, ready to be stepped.
struct MadeWorld {
    World world;
    std::vector<std::string> notes;  ///< what a user should know: a sentence each
};

/// Reads the meshes and puts bodies, balls and obstacles together. Constants of muscles are
/// looked up in `materials`. Gap and stiffness that the scene does not give are 5 % of the
/// shortest mean edge, and ten times the stiffest body's modulus by that edge (of a muscle 6 (C1 +
/// C2) + sigma_max). Throws IoError, InputError at the scene's lines, MeshError.
[[nodiscard]] MadeWorld make_world(const PlayScene& scene, const std::filesystem::path& materials);

}  // namespace myotet::play
