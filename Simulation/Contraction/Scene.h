// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "Contraction/Curve.h"
#include "Contraction/Motion.h"
#include "LevelSet/FromLabels.h"
#include "Meshing/MeshLevelSet.h"
#include "Muscle/ForceVelocity.h"

namespace myotet::contraction {

/// A word of the scene's file and its line, for messages.
struct Named {
    std::string name;
    int line = 0;
};

/// A label volume, whose tissues become meshes first.
struct Labels {
    std::filesystem::path file;
    std::filesystem::path names;   ///< table of label names; empty: what the file itself says
    std::filesystem::path repair;  ///< recipe; empty: none
    double edge_length = 0;        ///< on the surface, mm; 0: from the voxels
    double close_gaps = 0;         ///< between tissues, up to this wide, mm; 0: none
    levelset::Smoothing smoothing = levelset::Smoothing::curvature;
    meshing::Compression compression = meshing::Compression::optimization;
    int line = 0;
};

/// Where the fibres of a body come from; `none`: it has none.
enum class FibreSource { none, laplace, bspline, image, constant };

struct Fibres {
    FibreSource from = FibreSource::none;
    double pennation_deg = 0;
    std::filesystem::path file;     ///< of an image or of a spline; empty: the spline is fitted
    Vec3 direction = Vec3::Zero();  ///< of constant fibres, unit
};

/// Tetrahedra by themselves, with the change of volume shared by patches of
/// them, or with nodes at their edges too.
enum class Elements { linear, patches, quadratic };

/// The material of a tissue; without a tissue, of the whole body.
struct MaterialOf {
    std::string tissue;
    Named material;
};

/// What deforms: a mesh of one piece of material or several, nodes shared.
struct Body {
    std::string name;
    std::filesystem::path mesh;  ///< of tetrahedra, or empty: made of
    std::vector<Named> tissues;  ///< these of the label volume, by name or value
    std::vector<MaterialOf> materials;
    Fibres fibres;
    Elements elements = Elements::patches;
    Curve activation = constant_curve(0);   ///< 0 to 1; what follows an excitation, too
    std::filesystem::path activation_file;  ///< it was read from; empty: the scene
    std::optional<muscle::ForceVelocity> force_velocity;  ///< none: speed does not matter
    int line = 0;
};

/// A constant of a material that a scene changes.
struct Constant {
    std::string name;
    double value = 0;
    int line = 0;
};

/// A material that the scene names, or a model that goes by its own name.
struct Material {
    std::string name;
    Named model;
    std::vector<Constant> constants;
    double density = 1.06e-9;  ///< t/mm^3; muscle: 1060 kg/m^3 (Mendez and Keys 1960)
    double viscosity = 0;      ///< MPa s
};

/// What does not deform. Of `mesh`, `surface` and `tissue` one is given.
struct Bone {
    std::string name;
    std::filesystem::path mesh;     ///< of tetrahedra, whose boundary is meant
    std::filesystem::path surface;  ///< closed
    Named tissue;                   ///< of the label volume, by name or value
    Named body;                     ///< of the skeleton, with which it goes; empty: none
    Motion motion;                  ///< its own, or the body's
    int line = 0;
};

/// Which nodes an attachment holds.
enum class Where { near_bone, node_set, plane };
/// Which end of a muscle it is; fibres run from origin to insertion.
enum class End { other, origin, insertion };

/// Nodes of a body that go with a bone, or stay.
struct Attachment {
    std::string body;
    std::string bone;  ///< empty: fixed in space
    Where where = Where::near_bone;
    double within = 0;                                  ///< of bone or plane, mm
    std::string node_set;                               ///< of the body's mesh
    Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();  ///< of the plane; mm, unit
    End end = End::other;
    int line = 0;
};

/// Two bodies, or a body and a bone, that push each other away.
struct Contact {
    std::string a, b;
    double gap = 0;        ///< kept between them, mm
    double stiffness = 1;  ///< pressure a depth, MPa/mm
    int line = 0;
};

/// A skeleton that moves bones.
struct MovingSkeleton {
    std::filesystem::path model;   ///< .osim; empty: there is none
    std::filesystem::path motion;  ///< .mot, .sto, .csv or .yaml; empty: keys of the scene
    int line = 0;
};

enum class Scheme { quasi_static, backward_euler, generalized_alpha };

struct Time {
    double end = 0;   ///< s, from 0
    double step = 0;  ///< s
    Scheme scheme = Scheme::quasi_static;
    double damping = 0;         ///< of all motion, 1/s: speeds fade as exp(-damping t)
    double rho_infinity = 0.9;  ///< of generalized alpha: what a step leaves of fast vibration
};

struct Output {
    double every = 0;  ///< s
};

/// What a simulation is told: of bodies, bones and time, nothing of its
/// solution. Lists are in the file's order; names are checked against each other.
struct Scene {
    std::filesystem::path file;
    std::string title;
    std::optional<Labels> labels;
    std::vector<Body> bodies;
    std::vector<Material> materials;  ///< the scene's, then models used by their own name
    std::vector<Bone> bones;
    MovingSkeleton skeleton;
    std::vector<Attachment> attachments;
    std::vector<Contact> contacts;
    Vec3 gravity = Vec3::Zero();  ///< mm/s^2
    Time time;
    Output output;
};

/// Reads a scene (YAML; keys, units and defaults in the README) and the
/// activations it names. Paths in it are relative to its folder. Throws IoError
/// when a file cannot be read, InputError "scene.yaml:12: ..." with the value,
/// the rule it breaks and the remedy. What only meshes can tell, such as a node
/// set's name, is not checked here, nor are models and their constants.
[[nodiscard]] Scene read_scene(const std::filesystem::path& file);

/// Throws InputError at a line of the scene: for what is found out later.
[[noreturn]] void refuse(const Scene& scene, int line, const std::string& why);

/// The label value that a tissue's word means: a name, or else a value that has
/// voxels or a name. Throws InputError that lists the names when there is none
/// or more than one.
[[nodiscard]] std::int32_t find_label(const Scene& scene, const Named& tissue,
                                      const std::map<std::int32_t, std::string>& names);

/// All files that a scene reads, itself first, each once; those that a recipe reads and
/// the sets of constants in `materials` too. Throws what read_recipe throws.
[[nodiscard]] std::vector<std::filesystem::path> input_files(
    const Scene& scene, const std::filesystem::path& materials);

/// SHA-256 of the contents of all these files, 64 hexadecimal digits: two scenes
/// of one fingerprint have the same results. Throws IoError.
[[nodiscard]] std::string fingerprint(const Scene& scene, const std::filesystem::path& materials);

}  // namespace myotet::contraction
