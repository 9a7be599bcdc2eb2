// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "MeshFiles/RawMesh.h"
#include "MeshFiles/RawSurface.h"
#include "MeshFiles/TextWriter.h"

namespace myotet::meshfiles {
namespace {

template <class Number>
void put(TextWriter& out, Number number) {
    out.add(std::string_view(reinterpret_cast<const char*>(&number), sizeof number));
}

}  // namespace

TaggedSurface tagged_surface(const NamedMesh& mesh) {
    const std::vector<FaceSet> sets =
        mesh.faces.empty() ? faces_by_neighbour(mesh.mesh, mesh.names) : mesh.faces;
    TaggedSurface tagged;
    std::vector<std::int32_t> number(mesh.mesh.points.size(), -1);
    for (const FaceSet& set : sets) {
        tagged.names.emplace(set.tag, set.name);
        for (Triangle face : set.triangles) {
            for (std::int32_t& n : face) {
                if (number[n] < 0) {
                    number[n] = static_cast<std::int32_t>(tagged.surface.points.size());
                    tagged.surface.points.push_back(mesh.mesh.points[n]);
                }
                n = number[n];
            }
            tagged.surface.triangles.push_back(face);
            tagged.tags.push_back(set.tag);
        }
    }
    return tagged;
}

std::string ply_bytes(const NamedMesh& mesh) {
    const auto [surface, tags, names] = tagged_surface(mesh);
    TextWriter out;
    out.line("ply\nformat binary_little_endian 1.0\ncomment ", kFacts);
    for (const auto& [tag, name] : names) out.line("comment faces ", tag, '=', name);
    out.line("element vertex ", surface.points.size());
    out.line("property double x\nproperty double y\nproperty double z");
    out.line("element face ", surface.triangles.size());
    // meshio takes no other property beside the list; one name needs none.
    const bool tagged = names.size() > 1;
    out.line("property list uchar int vertex_indices\n", tagged ? "property int tag\n" : "",
             "end_header");
    for (const Vec3& p : surface.points)
        for (int a = 0; a < 3; ++a) put(out, p[a]);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        put(out, std::uint8_t{3});
        for (const std::int32_t corner : surface.triangles[t]) put(out, corner);
        if (tagged) put(out, tags[t]);
    }
    return out.text();
}

std::string obj_text(const NamedMesh& mesh) {
    const auto [surface, tags, names] = tagged_surface(mesh);
    TextWriter out;
    out.line("# ", kFacts);
    for (const auto& [tag, name] : names) out.line("# faces ", tag, '=', name);
    for (const Vec3& p : surface.points) out.line("v ", p[0], ' ', p[1], ' ', p[2]);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        if (t == 0 || tags[t] != tags[t - 1]) out.line("g ", obj_group(names.at(tags[t])));
        const Triangle& c = surface.triangles[t];
        out.line("f ", c[0] + 1, ' ', c[1] + 1, ' ', c[2] + 1);
    }
    return out.text();
}

}  // namespace myotet::meshfiles
