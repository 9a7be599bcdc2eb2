// SPDX-License-Identifier: Apache-2.0
#include "Cage/Enclosure.h"

#include <algorithm>

#include "Cage/Parts.h"
#include "Core/Text.h"

namespace myotet::cage {
namespace {

Corners4 corners(const TetMesh& mesh, const Tet& t) {
    return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]};
}

Corners3 corners(const TetMesh& mesh, const Triangle& f) {
    return {mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]};
}

void say(Enclosure& e, const std::string& sentence) {
    if (e.where.empty()) e.where = sentence;
}

std::string place(const Vec3& p) {
    return "(" + shown(p[0]) + ", " + shown(p[1]) + ", " + shown(p[2]) + ")";
}

void check_faces(const TetMesh& mesh, const std::vector<Triangle>& faces, const SurfaceTree& tree,
                 Enclosure& e) {
    for (const Triangle& f : faces) {
        const Corners3 c = corners(mesh, f);
        const std::int32_t met = tree.meets(c);
        if (met < 0) continue;
        ++e.faces_that_meet;
        say(e, "a boundary face at " + place((c[0] + c[1] + c[2]) / 3) + " meets triangle " +
                   std::to_string(met) + " of the surface");
    }
}

void check_itself(const TetMesh& mesh, const std::vector<Triangle>& faces, Enclosure& e) {
    TriMesh boundary;
    boundary.points = mesh.points;
    boundary.triangles = faces;
    for (const auto& [a, b] : pairs_that_meet(boundary)) {
        ++e.faces_that_cross;
        say(e, "boundary faces at " + place(mesh.points[faces[a][0]]) + " and " +
                   place(mesh.points[faces[b][0]]) + " meet");
    }
}

}  // namespace

Enclosure prove_enclosure(const TetMesh& mesh, const TriMesh& surface, const SurfaceTree& tree) {
    Enclosure e;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const Corners4 c = corners(mesh, mesh.tets[t]);
        if (orient3d(c[0], c[1], c[2], c[3]) > 0) continue;
        ++e.tets_not_positive;
        say(e, "tetrahedron " + std::to_string(t) + " is flat or inverted");
    }
    const std::vector<Triangle> faces = boundary_faces(mesh.tets);
    check_faces(mesh, faces, tree, e);
    check_itself(mesh, faces, e);
    if (e.tets_not_positive > 0) return e;
    for (const Part& part : parts_of(surface)) {
        const bool in = std::ranges::any_of(
            mesh.tets, [&](const Tet& t) { return holds(corners(mesh, t), part.point); });
        if (in) continue;
        ++e.parts_outside;
        say(e, "the part of the surface with the point " + place(part.point) + " lies outside");
    }
    return e;
}

}  // namespace myotet::cage
