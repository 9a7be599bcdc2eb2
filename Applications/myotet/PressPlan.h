// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "Membrane/Simulate.h"

namespace myotet::app {

/// A line along which something comes to the organ: parallel to `way`, through
/// `towards` or, when that is not said, through the middle of what the organ encloses.
struct Approach {
    Vec3 way = Vec3::UnitY();     ///< unit
    std::optional<Vec3> towards;  ///< LPS, mm
};

/// A tool as the file tells it. Where it has `depths`, or forces, the place at which it
/// first touches the organ is found, and it goes from there.
struct ToolPlan {
    std::string name;
    membrane::Tool tool;
    std::optional<Approach> approach;  ///< none: tool.places stand
    /// How far past the first touch, mm, at ascending times, s; negative: before it.
    std::vector<std::array<double, 2>> depths;
    int line = 0;
};

/// A force over a patch; the centre is said, or where the approach meets the organ.
struct PatchPlan {
    std::string name;
    membrane::PatchForce patch;
    std::optional<Approach> approach;
    int line = 0;
};

struct Ball {
    Vec3 centre = Vec3::Zero();  ///< LPS, mm
    double radius = 0;           ///< mm
};

/// What stays where it is.
struct HoldPlan {
    bool rims = false;
    std::vector<std::int32_t> points;  ///< of the given surface, from 0
    std::vector<Ball> balls;           ///< points inside
    std::vector<std::string> tissues;  ///< points within `within` of these labels
    double within = 0;                 ///< mm
    int line = 0;
};

/// What `--tool` says: all but the organ itself.
struct PressPlan {
    std::filesystem::path file;
    std::string title, material;
    membrane::Wall wall;
    bool thickness_stated = false;
    std::vector<ToolPlan> tools;
    std::vector<PatchPlan> patches;
    HoldPlan hold;
    Vec3 gravity = Vec3::Zero();    ///< mm/s^2
    double pressure = 0, bulk = 0;  ///< of the cavity, MPa
    double end = 0;                 ///< s
    double every = 0, history = 0;  ///< between frames, and lines of the history, s
    membrane::Criteria criteria;
};

/// Reads a tool's file; `walls` is the folder of the materials that it may name. Throws
/// IoError, InputError "file:line: ..." for all that is no YAML, not known, missing or out
/// of range.
[[nodiscard]] PressPlan read_press_plan(const std::filesystem::path& file,
                                        const std::filesystem::path& walls);

/// The loads of a plan on an organ: tools where they begin, patches where they press,
/// points that are held. `near` are points of the surface near the tissues to hold to.
/// Throws InputError at the plan's line where a tool or a patch passes the organ by, or
/// nothing is there to hold.
[[nodiscard]] membrane::Loads place_loads(const PressPlan& plan, const TriMesh& surface,
                                          const membrane::Levels& levels,
                                          std::span<const std::int32_t> near);

}  // namespace myotet::app
