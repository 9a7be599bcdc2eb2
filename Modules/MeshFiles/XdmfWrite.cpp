// SPDX-License-Identifier: Apache-2.0
// XDMF 3: the .xdmf describes, the .h5 beside it holds the numbers.
#include "Core/AtomicFile.h"
#include "MeshFiles/Hdf5.h"
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/TextWriter.h"

namespace myotet::meshfiles {
namespace {

/// Numbers of one kind of grid: elements of some nodes, each with a number.
struct Elements {
    std::vector<std::int32_t> corners, numbers;
};

Elements tets_of(const TetMesh& mesh) {
    Elements elements;
    for (const Tet& t : mesh.tets)
        elements.corners.insert(elements.corners.end(), t.begin(), t.end());
    elements.numbers = mesh.labels;
    elements.numbers.resize(mesh.tets.size(), 1);
    return elements;
}

Elements triangles_of(const std::vector<FaceSet>& sets) {
    Elements elements;
    for (const FaceSet& set : sets)
        for (const Triangle& t : set.triangles) {
            elements.corners.insert(elements.corners.end(), t.begin(), t.end());
            elements.numbers.push_back(set.tag);
        }
    return elements;
}

/// Node sets are numbered from 1 in their order.
Elements nodes_of(const std::vector<NodeSet>& sets) {
    Elements elements;
    for (std::size_t s = 0; s < sets.size(); ++s)
        for (const std::int32_t node : sets[s].nodes) {
            elements.corners.push_back(node);
            elements.numbers.push_back(static_cast<std::int32_t>(s) + 1);
        }
    return elements;
}

class XdmfText {
public:
    XdmfText(std::string heavy, std::size_t points) : heavy_(std::move(heavy)), points_(points) {
        out_.line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n  <!-- ",
                  kFacts, " -->\n  <Domain>");
    }
    void begin_grid(std::string_view name) {
        out_.line("    <Grid Name=\"", name, "\" GridType=\"Uniform\">");
    }
    void name(std::int32_t number, const std::string& name) {
        out_.line("      <Information Name=\"", number, "\" Value=\"", xml_escaped(name), "\"/>");
    }
    void end_grid(std::string_view type, int nodes, std::string_view number, std::string_view data,
                  std::size_t count) {
        out_.line("      <Topology TopologyType=\"", type, "\" NumberOfElements=\"", count,
                  "\" NodesPerElement=\"", nodes, "\">");
        item(count, nodes, "Int", data);
        out_.line("      </Topology>\n      <Geometry GeometryType=\"XYZ\">");
        item(points_, 3, "Float", "points");
        out_.line("      </Geometry>\n      <Attribute Name=\"", number,
                  "\" AttributeType=\"Scalar\" Center=\"Cell\">");
        item(count, 1, "Int", number);
        out_.line("      </Attribute>\n    </Grid>");
    }
    [[nodiscard]] std::string finish() {
        out_.line("  </Domain>\n</Xdmf>");
        return out_.text();
    }

private:
    void item(std::size_t rows, int columns, std::string_view type, std::string_view dataset) {
        out_.add("        <DataItem Dimensions=\"", rows);
        if (columns > 1) out_.add(' ', columns);
        out_.line("\" NumberType=\"", type, "\" Precision=\"", type == "Int" ? 4 : 8,
                  "\" Format=\"HDF\">", xml_escaped(heavy_), ":/", dataset, "</DataItem>");
    }
    TextWriter out_;
    std::string heavy_;
    std::size_t points_;
};

}  // namespace

void write_xdmf(const NamedMesh& mesh, const std::filesystem::path& file) {
    std::vector<double> points;
    for (const Vec3& p : mesh.mesh.points) points.insert(points.end(), p.begin(), p.end());
    const Elements tets = tets_of(mesh.mesh), triangles = triangles_of(mesh.faces),
                   nodes = nodes_of(mesh.nodes);
    std::vector<Table> tables = {
        {"points", 3, points, {}}, {"tets", 4, {}, tets.corners}, {"label", 1, {}, tets.numbers}};
    std::filesystem::path heavy = file;
    heavy.replace_extension(".h5");
    XdmfText text(heavy.filename().string(), mesh.mesh.points.size());
    text.begin_grid("mesh");
    for (const auto& [label, name] : part_names(mesh)) text.name(label, name);
    text.end_grid("Tetrahedron", 4, "label", "tets", tets.numbers.size());
    if (!mesh.faces.empty()) {
        tables.push_back({"triangles", 3, {}, triangles.corners});
        tables.push_back({"tag", 1, {}, triangles.numbers});
        text.begin_grid("faces");
        for (const FaceSet& set : mesh.faces) text.name(set.tag, set.name);
        text.end_grid("Triangle", 3, "tag", "triangles", triangles.numbers.size());
    }
    if (!mesh.nodes.empty()) {
        tables.push_back({"nodes", 1, {}, nodes.corners});
        tables.push_back({"node_set", 1, {}, nodes.numbers});
        text.begin_grid("nodes");
        for (std::size_t s = 0; s < mesh.nodes.size(); ++s)
            text.name(static_cast<std::int32_t>(s) + 1, mesh.nodes[s].name);
        text.end_grid("Polyvertex", 1, "node_set", "nodes", nodes.numbers.size());
    }
    write_hdf5(tables, heavy);
    write_atomically(file, text.finish());
}

}  // namespace myotet::meshfiles
