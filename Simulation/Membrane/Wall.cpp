// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Wall.h"

#include <cmath>

#include "Membrane/Require.h"

namespace myotet::membrane {

void Wall::validate() const {
    const auto positive = [](const char* field, double value, const char* rule) {
        require(std::isfinite(value) && value > 0, field, value, rule);
    };
    positive("wall.thickness", thickness, "must be a length in mm above 0");
    positive("wall.young", young, "must be a modulus in MPa above 0");
    positive("wall.density", density, "must be a density in t/mm^3 above 0");
    const auto not_negative = [](const char* field, double value, const char* rule) {
        require(std::isfinite(value) && value >= 0, field, value, rule);
    };
    not_negative("wall.damping_time", damping_time, "must be a time in s, 0 or more");
    not_negative("wall.shape_stiffness", shape_stiffness, "must be in MPa/mm, 0 or more");
    not_negative("wall.shape_damping_time", shape_damping_time, "must be a time in s, 0 or more");
    not_negative("wall.drag", drag, "must be in 1/s, 0 or more");
    not_negative("wall.contact_stiffness", contact_stiffness, "must be in MPa/mm, 0 or more");
}

double area(const TriMesh& surface) {
    double sum = 0;
    for (const auto& [a, b, c] : surface.triangles)
        sum += (surface.points[b] - surface.points[a])
                   .cross(surface.points[c] - surface.points[a])
                   .norm() /
               2;
    return sum;
}

std::vector<LevelProperties> level_properties(const Levels& levels, const Wall& wall) {
    const double total = area(levels.surface(0)) * wall.thickness * wall.density;
    const double given = std::sqrt(3.0) / 2 * wall.young * wall.thickness;
    std::vector<LevelProperties> properties;
    for (int l = 0; l <= levels.finest(); ++l) {
        LevelProperties p;
        p.mass = total / levels.meshes[l].vertex_count;  // [Choi05, eq. 6]
        p.stiffness = given;
        if (wall.stiffening == Stiffening::by_mass && l > 0)  // [Choi05, eq. 8]
            p.stiffness = std::ldexp(given, l) * p.mass / properties.front().mass;
        p.damping = wall.damping_time * p.stiffness;
        properties.push_back(p);
    }
    return properties;
}

}  // namespace myotet::membrane
