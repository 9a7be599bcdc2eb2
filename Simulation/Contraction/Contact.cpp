// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Contact.h"

#include <algorithm>
#include <map>
#include <string>

#include "Core/Errors.h"

namespace myotet::contraction {

void PenaltyLaw::validate() const {
    if (!(stiffness > 0))
        throw InputError("stiffness of contact is " + std::to_string(stiffness) +
                         " MPa/mm, but it must be positive; 1 suits muscle");
    if (!(gap >= 0))
        throw InputError("gap of contact is " + std::to_string(gap) +
                         " mm, but it must not be negative; 0 presses where surfaces meet");
}

ContactNodes contact_nodes(const std::vector<Vec3>& rest, const std::vector<Triangle>& surface,
                           std::span<const std::int32_t> left_out) {
    const auto count = static_cast<std::int32_t>(rest.size());
    std::map<std::int32_t, double> area;
    for (const Triangle& t : surface) {
        for (const std::int32_t n : t)
            if (n < 0 || n >= count)
                throw InputError("a triangle of a contact surface names node " + std::to_string(n) +
                                 ", but there are " + std::to_string(count) +
                                 "; give the surface of this mesh");
        const double third = (rest[t[1]] - rest[t[0]]).cross(rest[t[2]] - rest[t[0]]).norm() / 6;
        for (const std::int32_t n : t) area[n] += third;
    }
    for (const std::int32_t n : left_out) area.erase(n);
    ContactNodes nodes;
    for (const auto& [n, a] : area) {
        nodes.node.push_back(n);
        nodes.area.push_back(a);
    }
    return nodes;
}

std::vector<double> gaps_at_rest(const ContactNodes& nodes, const std::vector<Vec3>& rest,
                                 const ContactField& other, double gap) {
    if (!other.phi)
        throw InputError("contact has no level set of the other shape; make one of its surface");
    if (nodes.area.size() != nodes.node.size())
        throw InputError("contact has " + std::to_string(nodes.node.size()) + " nodes but " +
                         std::to_string(nodes.area.size()) + " areas; give one a node");
    std::vector<double> gaps(nodes.node.size(), gap);
    for (std::size_t i = 0; i < gaps.size(); ++i) {
        const std::int32_t n = nodes.node[i];
        if (!(n >= 0 && n < static_cast<std::int32_t>(rest.size())))
            throw InputError("contact names node " + std::to_string(n) + ", but there are " +
                             std::to_string(rest.size()) + "; give nodes of this mesh");
        if (!(nodes.area[i] > 0))
            throw InputError("node " + std::to_string(n) + " of a contact has the area " +
                             std::to_string(nodes.area[i]) +
                             " mm^2, but it must be positive; leave the node out");
        if (const auto s = other.sample_below(gap, rest[n])) gaps[i] = s->value;
    }
    return gaps;
}

std::vector<Tet> linear_pieces(const elasticity::QuadraticMesh& mesh) {
    // Four at the corners; the octahedron between them is cut along the edge from the middle
    // of 20 to that of 13. Middles are 01 12 20 03 13 23, numbers 4 to 9.
    constexpr int pieces[8][4] = {{0, 4, 6, 7}, {4, 1, 5, 8}, {6, 5, 2, 9}, {7, 8, 9, 3},
                                  {6, 8, 4, 5}, {6, 8, 5, 9}, {6, 8, 9, 7}, {6, 8, 7, 4}};
    std::vector<Tet> tets;
    tets.reserve(8 * mesh.tets.size());
    for (const auto& t : mesh.tets)
        for (const auto& p : pieces) tets.push_back({t[p[0]], t[p[1]], t[p[2]], t[p[3]]});
    return tets;
}

ContactReport report_of(std::span<const ContactTouch> touches, double stiffness) {
    ContactReport report;
    for (const ContactTouch& t : touches) {
        if (!(t.press > 0)) continue;
        const Vec3 force = stiffness * t.area * t.press * t.normal;
        ++report.nodes;
        report.area += t.area;
        report.max_depth = std::max(report.max_depth, t.depth);
        report.mean_depth += t.area * t.depth;
        report.max_pressure = std::max(report.max_pressure, stiffness * t.press);
        report.total += force.norm();
        report.force += force;
    }
    if (report.area > 0) report.mean_depth /= report.area;
    return report;
}

}  // namespace myotet::contraction
