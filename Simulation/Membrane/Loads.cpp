// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Loads.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Membrane/Require.h"

namespace myotet::membrane {

namespace {

// Winding number of a closed surface about a point, by solid angles
// (Van Oosterom, Strackee 1983).
double winding(const TriMesh& surface, const Vec3& point) {
    double sum = 0;
    for (const auto& [i, j, k] : surface.triangles) {
        const Vec3 a = surface.points[i] - point, b = surface.points[j] - point,
                   c = surface.points[k] - point;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        sum += std::atan2(a.dot(b.cross(c)),
                          la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum / (2 * std::numbers::pi);
}

// Of rows in ascending time, straight between two, the same before and after all.
template <class Row, class Value>
auto along(const std::vector<Row>& rows, double time, const Value& value) {
    if (time <= rows.front().time) return value(rows.front());
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (time > rows[i].time) continue;
        const double part = (time - rows[i - 1].time) / (rows[i].time - rows[i - 1].time);
        return decltype(value(rows[0]))((1 - part) * value(rows[i - 1]) + part * value(rows[i]));
    }
    return value(rows.back());
}

void check_patch(const PatchForce& patch, const Levels& levels) {
    require(std::isfinite(patch.radius) && patch.radius > 0, "patch.radius", patch.radius,
            "must be a length in mm above 0");
    require(patch.force.allFinite() && patch.centre.allFinite(), "patch.force", patch.force.norm(),
            "force and centre must be finite");
    require(patch.until >= patch.from, "patch.until", patch.until,
            "must be a time in s not before 'from'");
    require(std::isfinite(patch.ramp) && patch.ramp >= 0, "patch.ramp", patch.ramp,
            "must be a time in s, 0 or more");
    const bool found =
        std::any_of(levels.rest.begin(), levels.rest.begin() + levels.given(), [&](const Vec3& x) {
            return (x - patch.centre).squaredNorm() < patch.radius * patch.radius;
        });
    require(found, "patch.radius", patch.radius,
            "must reach at least one point of the surface; enlarge it or move the centre");
}

void check_forces(const Tool& tool) {
    if (tool.forces.empty()) return;
    require(tool.places.size() == 1, "tool.places", static_cast<double>(tool.places.size()),
            "must be one place, where the tool begins, as forces drive it");
    require(std::abs(tool.way.norm() - 1) < 1e-6, "tool.way", tool.way.norm(),
            "must be of length 1");
    for (std::size_t i = 0; i < tool.forces.size(); ++i)
        require(std::isfinite(tool.forces[i].force) && tool.forces[i].force >= 0 &&
                    std::isfinite(tool.forces[i].time) &&
                    (i == 0 || tool.forces[i].time > tool.forces[i - 1].time),
                "tool.forces", tool.forces[i].force,
                "must be in N, 0 or more, at ascending times in s");
    require(tool.shape == Tool::Shape::sphere || tool.normal.dot(tool.way) > 0, "tool.way",
            tool.normal.dot(tool.way), "must lead a plane towards where its normal points");
}

void check_tool(const Tool& tool, const Levels& levels, std::size_t number) {
    const bool sphere = tool.shape == Tool::Shape::sphere;
    require(!sphere || (std::isfinite(tool.radius) && tool.radius > 0), "tool.radius", tool.radius,
            "must be a length in mm above 0");
    require(sphere || std::abs(tool.normal.norm() - 1) < 1e-6, "tool.normal", tool.normal.norm(),
            "must be of length 1");
    require(std::isfinite(tool.stiffness) && tool.stiffness > 0, "tool.stiffness", tool.stiffness,
            "must be in MPa/mm above 0");
    require(!tool.places.empty(), "tool.places", 0, "must have at least one place");
    for (std::size_t i = 0; i < tool.places.size(); ++i)
        require(tool.places[i].position.allFinite() && std::isfinite(tool.places[i].time) &&
                    (i == 0 || tool.places[i].time > tool.places[i - 1].time),
                "tool.places", tool.places[i].time, "must be finite and at ascending times in s");
    check_forces(tool);
    const Vec3 at = place_at(tool, 0);
    const std::string who = "tool " + std::to_string(number);
    if (sphere && levels.meshes[0].closed() && std::abs(winding(levels.surface(0), at)) > 0.5)
        throw InputError(who + " is inside the organ at the start, but must be outside; move it");
    for (std::size_t v = 0; v < levels.rest.size(); ++v)
        if (depth_in(tool, at, levels.rest[v]).depth > 0)
            throw InputError(who + " is in the wall at the start, at point " + std::to_string(v) +
                             " of the refined surface, but must be clear of it; move it");
}

}  // namespace

void Loads::validate(const Levels& levels) const {
    for (const PatchForce& patch : patches) check_patch(patch, levels);
    for (std::size_t i = 0; i < tools.size(); ++i) check_tool(tools[i], levels, i);
    require(gravity.allFinite(), "gravity", gravity.norm(), "must be finite, in mm/s^2");
    require(std::isfinite(pressure), "pressure", pressure, "must be finite, in MPa");
    require(std::isfinite(bulk) && bulk >= 0, "bulk", bulk, "must be in MPa, 0 or more");
    require(bulk == 0 || levels.meshes[0].closed(), "bulk", bulk,
            "must be 0 for a surface that is not closed");
    for (const std::int32_t v : held)
        require(v >= 0 && v < levels.given(), "held", v, "must be a point of the surface");
}

Vec3 place_at(const Tool& tool, double time) {
    return along(tool.places, time, [](const ToolPlace& p) { return p.position; });
}

double force_at(const Tool& tool, double time) {
    if (tool.forces.empty()) return 0;
    return along(tool.forces, time, [](const ToolForce& f) { return f.force; });
}

std::optional<double> first_touch(const Tool& tool, const Vec3& from, const Vec3& way,
                                  std::span<const Vec3> points) {
    std::optional<double> first;
    for (const Vec3& x : points) {
        const Vec3 away = x - from;
        double far = 0;
        if (tool.shape == Tool::Shape::plane) {
            const double approach = tool.normal.dot(way);
            if (!(approach > 0)) return std::nullopt;
            far = tool.normal.dot(away) / approach;
        } else {
            const double ahead = away.dot(way), beside = away.squaredNorm() - ahead * ahead,
                         room = tool.radius * tool.radius - beside;
            if (!(room > 0)) continue;
            far = ahead - std::sqrt(room);
        }
        if (!first || far < *first) first = far;
    }
    return first;
}

std::optional<Vec3> first_hit(const TriMesh& surface, const Vec3& through, const Vec3& way) {
    std::optional<double> first;
    for (const auto& [i, j, k] : surface.triangles) {
        const Vec3 &a = surface.points[i], ab = surface.points[j] - a, ac = surface.points[k] - a,
                   n = ab.cross(ac);
        const double slope = n.dot(way);
        if (slope == 0) continue;
        const double far = n.dot(a - through) / slope;
        // Barycentric coordinates of the point in the triangle's plane.
        const Vec3 in = through + far * way - a;
        const double v = n.dot(in.cross(ac)) / n.squaredNorm(),
                     w = n.dot(ab.cross(in)) / n.squaredNorm();
        if (v >= 0 && w >= 0 && v + w <= 1 && (!first || far < *first)) first = far;
    }
    if (!first) return std::nullopt;
    return through + *first * way;
}

Depth depth_in(const Tool& tool, const Vec3& position, const Vec3& point) {
    const Vec3 away = point - position;
    if (tool.shape == Tool::Shape::plane) return {-tool.normal.dot(away), tool.normal};
    const double distance = away.norm();
    if (!(distance > 0)) return {tool.radius, Vec3::UnitZ()};
    return {tool.radius - distance, away / distance};
}

double strength_at(const PatchForce& patch, double time) {
    const double after_start = time - patch.from, after_end = time - patch.until;
    if (after_start < 0) return 0;
    const double came = patch.ramp > 0 ? std::min(1.0, after_start / patch.ramp) : 1;
    if (after_end <= 0) return came;
    return patch.ramp > 0 ? came * std::max(0.0, 1 - after_end / patch.ramp) : 0;
}

std::vector<char> fixed_vertices(const Levels& levels, const Loads& loads) {
    std::vector<char> fixed(levels.rest.size(), 0);
    for (const std::int32_t v : loads.held) fixed[v] = 1;
    for (std::int32_t v = 0; loads.hold_rims && v < levels.given(); ++v)
        if (levels.meshes[0].on_rim(v)) fixed[v] = 1;
    for (std::int32_t v = levels.given(); v < static_cast<std::int32_t>(fixed.size()); ++v) {
        const auto [a, b] = levels.ends_of(v);
        fixed[v] = static_cast<char>(fixed[a] && fixed[b]);
    }
    return fixed;
}

}  // namespace myotet::membrane
