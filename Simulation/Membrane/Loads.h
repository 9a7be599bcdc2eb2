// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "Membrane/Wall.h"

namespace myotet::membrane {

/// A force over a round patch of the wall.
struct PatchForce {
    Vec3 centre = Vec3::Zero();  ///< of the nodes within `radius` at rest, mm
    double radius = 0;           ///< mm; must be positive
    /// Sum over the patch, N; shared out by mass times 1 - (r / radius)^2, so that
    /// it is the same at every level.
    Vec3 force = Vec3::Zero();
    double from = 0, until = 0;  ///< s
    double ramp = 0;             ///< over which it comes at `from` and goes after `until`, s
};

/// Where a tool is at a time.
struct ToolPlace {
    double time = 0;               ///< s
    Vec3 position = Vec3::Zero();  ///< a sphere's centre or a point of a plane, mm
};

/// How hard a tool presses at a time.
struct ToolForce {
    double time = 0;   ///< s
    double force = 0;  ///< along the tool's way, N
};

/// A rigid tool that presses by penalty contact, without friction. It goes from
/// place to place; or it begins at its only place and goes along `way`, as far as
/// the wall bears the force of the moment: it has no mass, and where the force is
/// none it rests where it began or where it just touches the wall.
struct Tool {
    enum class Shape { sphere, plane } shape = Shape::sphere;
    double radius = 0;            ///< of a sphere, mm
    Vec3 normal = Vec3::UnitZ();  ///< of a plane, out of it towards the organ
    /// In ascending time; in between along a straight line, before and after at rest.
    std::vector<ToolPlace> places;
    std::vector<ToolForce> forces;  ///< the same; none: it goes from place to place
    Vec3 way = Vec3::UnitZ();       ///< unit; of a tool that is driven by forces
    double stiffness = 0.01;        ///< pressure over depth, MPa/mm
};

struct Loads {
    std::vector<PatchForce> patches;
    std::vector<Tool> tools;
    Vec3 gravity = Vec3::Zero();  ///< acceleration, mm/s^2
    double pressure = 0;          ///< of the cavity against outside, MPa
    /// A sealed filling: the pressure grows by `bulk` (1 - volume / volume at rest),
    /// MPa. Needs a closed surface.
    double bulk = 0;
    bool hold_rims = false;          ///< fixes rims where they are
    std::vector<std::int32_t> held;  ///< fixed points of the given surface

    /// Throws InputError naming the field, its value and the rule; also for a tool
    /// that at the start touches the organ or is inside it, a patch without a
    /// point of the given surface, and a bulk modulus for an open surface.
    void validate(const Levels& levels) const;
};

/// Where a tool that goes from place to place is, or where one driven by forces
/// begins, mm.
[[nodiscard]] Vec3 place_at(const Tool& tool, double time);

/// The force that drives a tool, N; 0 for one that goes from place to place.
[[nodiscard]] double force_at(const Tool& tool, double time);

/// How far (mm) a tool at `from` has to go along a unit vector until it first
/// touches one of the points; negative where it lies behind. Nothing when it
/// passes all of them.
[[nodiscard]] std::optional<double> first_touch(const Tool& tool, const Vec3& from, const Vec3& way,
                                                std::span<const Vec3> points);

/// Where a straight line along `way` through `through` first meets a surface,
/// coming from far away; nothing when it misses.
[[nodiscard]] std::optional<Vec3> first_hit(const TriMesh& surface, const Vec3& through,
                                            const Vec3& way);

/// How deep a point is in the tool, mm, and the unit vector out of it; negative
/// depth outside.
struct Depth {
    double depth = 0;
    Vec3 outward = Vec3::Zero();
};
[[nodiscard]] Depth depth_in(const Tool& tool, const Vec3& position, const Vec3& point);

/// The part of a patch's force that acts at a time, 0 to 1.
[[nodiscard]] double strength_at(const PatchForce& patch, double time);

/// Vertices of the finest level that are fixed: those named, rims if these are
/// held, and midpoints of edges between two fixed ends.
[[nodiscard]] std::vector<char> fixed_vertices(const Levels& levels, const Loads& loads);

}  // namespace myotet::membrane
