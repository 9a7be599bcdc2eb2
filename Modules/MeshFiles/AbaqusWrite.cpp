// SPDX-License-Identifier: Apache-2.0
// Abaqus keywords: *NODE, *ELEMENT, *ELSET, *NSET, *SURFACE (TYPE=ELEMENT).
#include <algorithm>
#include <cctype>

#include "MeshFiles/RawMesh.h"
#include "MeshFiles/TextWriter.h"

namespace myotet::meshfiles {
namespace {

/// C3D4's faces S1 to S4 are nodes 1-2-3, 1-4-2, 2-4-3 and 3-4-1; face_of
/// counts them by the node that they lack: the one without node 1 is S3.
constexpr int kNumberOfFaceLacking[4] = {3, 4, 2, 1};

/// Names of letters, digits, '_' and '-' that begin with a letter stand as they
/// are; others stand in quotes.
std::string label_text(std::string name) {
    const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
    if (std::isalpha(static_cast<unsigned char>(name.front())) && std::ranges::all_of(name, plain))
        return name;
    std::ranges::replace(name, '"', '\'');  // the format has no way to write it
    return '"' + name + '"';
}

void write_members(TextWriter& out, const std::vector<std::int32_t>& indices) {
    constexpr std::size_t kMostPerLine = 16;
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const bool last = i % kMostPerLine == kMostPerLine - 1 || i + 1 == indices.size();
        out.add(indices[i] + 1, last ? "\n" : ", ");
    }
}

}  // namespace

std::string abaqus_text(const NamedMesh& mesh) {
    TextWriter out;
    out.line("*HEADING\n", kFacts, "; units mm, N, s, MPa, tonne\n*NODE");
    for (std::size_t n = 0; n < mesh.mesh.points.size(); ++n) {
        const Vec3& p = mesh.mesh.points[n];
        out.line(n + 1, ", ", p[0], ", ", p[1], ", ", p[2]);
    }
    const auto names = part_names(mesh);
    for (const auto& [label, tets] : tets_by_label(mesh.mesh)) {
        out.line("** label ", label);
        out.line("*ELEMENT, TYPE=C3D4, ELSET=", label_text(names.at(label)));
        for (const std::int32_t t : tets) {
            const Tet& c = mesh.mesh.tets[t];
            out.line(t + 1, ", ", c[0] + 1, ", ", c[1] + 1, ", ", c[2] + 1, ", ", c[3] + 1);
        }
    }
    for (const NodeSet& set : mesh.nodes) {
        out.line("*NSET, NSET=", label_text(set.name));
        write_members(out, set.nodes);
    }
    const auto sides = sides_of(mesh);
    for (std::size_t s = 0; s < sides.size(); ++s) {
        out.line("** tag ", mesh.faces[s].tag);
        out.line("*SURFACE, TYPE=ELEMENT, NAME=", label_text(mesh.faces[s].name));
        for (const FaceSides& side : sides[s]) {
            const std::int32_t slot = side.inside >= 0 ? side.inside : side.behind;
            out.line(slot / 4 + 1, ", S", kNumberOfFaceLacking[slot % 4]);
        }
    }
    out.line(kAbaqusEnd);
    return out.text();
}

}  // namespace myotet::meshfiles
