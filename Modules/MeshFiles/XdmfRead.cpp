// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <pugixml.hpp>

#include "Core/Errors.h"
#include "MeshFiles/Hdf5.h"
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/RawSurface.h"

namespace myotet::meshfiles {
namespace {

/// Reads files of the layout that XdmfWrite.cpp writes.
class XdmfReader {
public:
    XdmfReader(std::string_view content, const std::filesystem::path& file)
        : content_(content), file_(file) {}

    RawMesh read() {
        const auto result = document_.load_buffer(content_.data(), content_.size(),
                                                  pugi::parse_default | pugi::parse_comments);
        if (!result)
            fail(result.offset, std::string("is not valid XML (") + result.description() + ")");
        const pugi::xml_node root = document_.child("Xdmf");
        for (const pugi::xml_node note : root)
            if (note.type() == pugi::node_comment && mesh_.space.empty())
                mesh_.space = space_said_by(note.value());
        domain_ = root.child("Domain");
        read_mesh(grid("mesh"));
        if (const pugi::xml_node faces = grid("faces")) read_faces(faces);
        if (const pugi::xml_node nodes = grid("nodes")) read_nodes(nodes);
        return std::move(mesh_);
    }

private:
    struct Source {
        std::filesystem::path file;
        std::string dataset;
    };

    pugi::xml_node grid(const char* name) const {
        return domain_.find_child_by_attribute("Grid", "Name", name);
    }

    void read_mesh(const pugi::xml_node& grid) {
        if (!grid) fail(domain_.offset_debug(), "begins no domain with a grid named 'mesh'");
        const auto points = reals(grid.child("Geometry"), 3);
        const auto corners = integers(grid.child("Topology"), 4);
        const auto labels = integers(attribute(grid, "label"), 1);
        require(grid, labels.size() * 4 == corners.size(), "has not one label a tetrahedron");
        for (std::size_t p = 0; p < points.size() / 3; ++p)
            mesh_.add_point(static_cast<std::int64_t>(p),
                            {points[3 * p], points[3 * p + 1], points[3 * p + 2]});
        for (std::size_t t = 0; t < labels.size(); ++t)
            mesh_.add_tet(
                static_cast<std::int64_t>(t), labels[t],
                {corners[4 * t], corners[4 * t + 1], corners[4 * t + 2], corners[4 * t + 3]});
        mesh_.names = names_of(grid);
    }
    void read_faces(const pugi::xml_node& grid) {
        const auto corners = integers(grid.child("Topology"), 3);
        const auto tags = integers(attribute(grid, "tag"), 1);
        require(grid, tags.size() * 3 == corners.size(), "has not one tag a triangle");
        const auto names = names_of(grid);
        for (std::size_t t = 0; t < tags.size(); ++t) {
            RawMesh::Faces& set = mesh_.faces_tagged(tags[t]);
            if (const auto name = names.find(tags[t]); set.triangles.empty() && name != names.end())
                set.name = name->second;
            set.triangles.push_back({corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]});
        }
    }
    void read_nodes(const pugi::xml_node& grid) {
        const auto nodes = integers(grid.child("Topology"), 1);
        const auto sets = integers(attribute(grid, "node_set"), 1);
        require(grid, sets.size() == nodes.size(), "has not one set a node");
        for (const auto& [number, name] : names_of(grid)) {
            RawMesh::Nodes& set = mesh_.nodes.emplace_back(RawMesh::Nodes{name, {}});
            for (std::size_t n = 0; n < nodes.size(); ++n)
                if (sets[n] == number) set.nodes.push_back(nodes[n]);
        }
    }

    static pugi::xml_node attribute(const pugi::xml_node& grid, const char* name) {
        return grid.find_child_by_attribute("Attribute", "Name", name);
    }
    std::map<std::int64_t, std::string> names_of(const pugi::xml_node& grid) const {
        std::map<std::int64_t, std::string> names;
        for (const pugi::xml_node node : grid.children("Information"))
            names[node.attribute("Name").as_llong()] = node.attribute("Value").value();
        return names;
    }
    std::vector<double> reals(const pugi::xml_node& holder, std::int64_t columns) const {
        const Source source = source_of(holder);
        return read_reals(source.file, source.dataset, columns);
    }
    std::vector<std::int64_t> integers(const pugi::xml_node& holder, std::int64_t columns) const {
        const Source source = source_of(holder);
        return read_integers(source.file, source.dataset, columns);
    }
    /// `name.h5:/dataset`, beside the .xdmf.
    Source source_of(const pugi::xml_node& holder) const {
        const pugi::xml_node item = holder.child("DataItem");
        std::string said = item.text().get();
        const std::size_t from = said.find_first_not_of(" \t\r\n");
        if (from != std::string::npos)
            said = said.substr(from, said.find_last_not_of(" \t\r\n") - from + 1);
        const std::size_t colon = said.rfind(":/");
        require(holder,
                std::string_view(item.attribute("Format").value()) == "HDF" &&
                    colon != std::string::npos,
                "names no HDF5 dataset as file.h5:/name, the only kind that is read");
        return {file_.parent_path() / said.substr(0, colon), said.substr(colon + 1)};
    }
    void require(const pugi::xml_node& node, bool holds, const std::string& defect) const {
        if (!holds) fail(node.offset_debug(), "(<" + std::string(node.name()) + ">) " + defect);
    }
    [[noreturn]] void fail(std::ptrdiff_t offset, const std::string& defect) const {
        throw InputError(file_.string() + ": line " + std::to_string(line_at(content_, offset)) +
                         " " + defect +
                         "; the file is damaged or of a kind that is not read, export it again");
    }

    std::string_view content_;
    const std::filesystem::path& file_;
    pugi::xml_document document_;
    pugi::xml_node domain_;
    RawMesh mesh_;
};

}  // namespace

RawMesh parse_xdmf(std::string_view content, const std::filesystem::path& file) {
    return XdmfReader(content, file).read();
}

}  // namespace myotet::meshfiles
