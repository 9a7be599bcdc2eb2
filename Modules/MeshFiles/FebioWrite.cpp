// SPDX-License-Identifier: Apache-2.0
// FEBio's .feb, version 4.0: FEBio user's manual, "Free format input".
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/TextWriter.h"

namespace myotet::meshfiles {
namespace {

using Names = std::map<std::int32_t, std::string>;

/// FEBio reads a solid only with a material, so each part has one to replace.
void write_materials(TextWriter& out, const Names& names) {
    out.line("  <!-- Placeholders, no property of any tissue: replace type, E and v. -->");
    out.line("  <Material>");
    int id = 0;
    for (const auto& [label, name] : names) {
        out.line("    <material id=\"", ++id, "\" name=\"", xml_escaped(name),
                 "\" type=\"neo-Hookean\">");
        out.line("      <density>1e-9</density>\n      <E>1</E>\n      <v>0.3</v>");
        out.line("    </material>");
    }
    out.line("  </Material>");
}

void write_elements(TextWriter& out, const NamedMesh& mesh, const Names& names) {
    for (const auto& [label, tets] : tets_by_label(mesh.mesh)) {
        out.line("    <!-- label ", label, " -->");
        out.line("    <Elements type=\"tet4\" name=\"", xml_escaped(names.at(label)), "\">");
        for (const std::int32_t t : tets) {
            const Tet& c = mesh.mesh.tets[t];
            out.line("      <elem id=\"", t + 1, "\">", c[0] + 1, ',', c[1] + 1, ',', c[2] + 1, ',',
                     c[3] + 1, "</elem>");
        }
        out.line("    </Elements>");
    }
}

void write_node_set(TextWriter& out, const NodeSet& set) {
    constexpr std::size_t kNodesPerLine = 16;
    out.add("    <NodeSet name=\"", xml_escaped(set.name), "\">");
    for (std::size_t i = 0; i < set.nodes.size(); ++i)
        out.add(i % kNodesPerLine == 0 ? "\n      " : "", set.nodes[i] + 1,
                i + 1 < set.nodes.size() ? "," : "");
    out.line("\n    </NodeSet>");
}

void write_surface(TextWriter& out, const FaceSet& set) {
    out.line("    <!-- tag ", set.tag, " -->");
    out.line("    <Surface name=\"", xml_escaped(set.name), "\">");
    int id = 0;
    for (const Triangle& t : set.triangles)
        out.line("      <tri3 id=\"", ++id, "\">", t[0] + 1, ',', t[1] + 1, ',', t[2] + 1,
                 "</tri3>");
    out.line("    </Surface>");
}

void write_mesh_section(TextWriter& out, const NamedMesh& mesh, const Names& names) {
    out.line("  <Mesh>\n    <Nodes name=\"nodes\">");
    for (std::size_t n = 0; n < mesh.mesh.points.size(); ++n) {
        const Vec3& p = mesh.mesh.points[n];
        out.line("      <node id=\"", n + 1, "\">", p[0], ',', p[1], ',', p[2], "</node>");
    }
    out.line("    </Nodes>");
    write_elements(out, mesh, names);
    for (const NodeSet& set : mesh.nodes) write_node_set(out, set);
    for (const FaceSet& set : mesh.faces) write_surface(out, set);
    out.line("  </Mesh>");
}

}  // namespace

std::string febio_text(const NamedMesh& mesh) {
    const Names names = part_names(mesh);
    TextWriter out;
    out.line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<febio_spec version=\"4.0\">");
    out.line("  <!-- ", kFacts, "; units mm, N, s, MPa, tonne -->");
    out.line("  <Module type=\"solid\">\n    <units>mm-N-s</units>\n  </Module>");
    write_materials(out, names);
    write_mesh_section(out, mesh, names);
    out.line("  <MeshDomains>");
    for (const auto& [label, name] : names)
        out.line("    <SolidDomain name=\"", xml_escaped(name), "\" mat=\"", xml_escaped(name),
                 "\"/>");
    out.line("  </MeshDomains>\n</febio_spec>");
    return out.text();
}

}  // namespace myotet::meshfiles
