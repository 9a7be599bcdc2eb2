// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

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

/// A rigid tool that presses by penalty contact, without friction.
struct Tool {
    enum class Shape { sphere, plane } shape = Shape::sphere;
    double radius = 0;            ///< of a sphere, mm
    Vec3 normal = Vec3::UnitZ();  ///< of a plane, out of it towards the organ
    /// In ascending time; in between along a straight line, before and after at rest.
    std::vector<ToolPlace> places;
    double stiffness = 0.01;  ///< pressure over depth, MPa/mm
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

/// Where a tool is, mm.
[[nodiscard]] Vec3 place_at(const Tool& tool, double time);

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
