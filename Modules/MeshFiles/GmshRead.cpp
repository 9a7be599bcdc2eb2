// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/RawSurface.h"
#include "MeshFiles/TokenReader.h"

namespace myotet::meshfiles {
namespace {

class GmshReader {
public:
    GmshReader(std::string_view content, const std::filesystem::path& file) : in_(content, file) {}

    RawMesh read() {
        for (std::string_view section = in_.word(); !section.empty(); section = in_.word()) {
            if (!section.starts_with('$')) in_.fail("begins no section");
            if (version_ == 0 && section != "$MeshFormat") in_.fail("is not $MeshFormat");
            read_section(section);
        }
        if (!complete_) in_.fail_short();
        return std::move(mesh_);
    }

private:
    using Key = std::pair<int, std::int64_t>;  ///< dimension, tag

    void read_section(std::string_view section) {
        const std::string end = "$End" + std::string(section.substr(1));
        if (section == "$MeshFormat") return read_format();
        if (section == "$PhysicalNames")
            read_names();
        else if (section == "$Entities")
            read_entities();
        else if (section == "$Nodes")
            read_nodes();
        else if (section == "$Elements")
            read_elements();
        else {
            const std::string_view said = in_.up_to(end);
            if (section == "$Comments") mesh_.space = space_said_by(said);
            return;
        }
        if (in_.word() != end) in_.fail("is not " + end);
    }

    void read_format() {
        version_ = in_.number<double>("the version");
        const int kind = in_.number<int>("the kind of file");
        const int bytes = in_.number<int>("the size of a number");
        if (version_ != 4.1 || bytes != 8 || kind < 0 || kind > 1)
            in_.fail("is not of version 4.1 with 8-byte numbers; save it as msh41");
        binary_ = kind == 1;
        in_.end_line();
        if (binary_ && in_.raw<std::int32_t>() != 1) in_.fail("has the other byte order");
        if (in_.word() != "$EndMeshFormat") in_.fail("is not $EndMeshFormat");
    }

    void read_names() {
        const auto count = in_.number<std::int64_t>("the number of names");
        for (std::int64_t i = 0; i < count; ++i) {
            const int dimension = in_.number<int>("a dimension");
            const auto tag = in_.number<std::int64_t>("a tag");
            const std::string_view rest = in_.rest_of_line();
            const std::size_t first = rest.find('"'), last = rest.rfind('"');
            if (first == last) in_.fail("has no name between quotes");
            names_[{dimension, tag}] = rest.substr(first + 1, last - first - 1);
        }
    }

    std::int64_t integer(const char* what) {
        return binary_ ? in_.raw<std::int32_t>() : in_.number<std::int64_t>(what);
    }
    std::int64_t size(const char* what) {
        return binary_ ? in_.raw<std::int64_t>() : in_.number<std::int64_t>(what);
    }
    double real() { return binary_ ? in_.raw<double>() : in_.number<double>("a coordinate"); }
    /// The end of the line before the numbers of a section.
    void begin_numbers() {
        if (binary_) in_.end_line();
    }

    void read_entities() {
        begin_numbers();
        std::int64_t counts[4];
        for (std::int64_t& count : counts) count = size("a number of entities");
        for (int dimension = 0; dimension < 4; ++dimension)
            for (std::int64_t i = 0; i < counts[dimension]; ++i) read_entity(dimension);
    }

    void read_entity(int dimension) {
        const std::int64_t tag = integer("a tag");
        for (int x = 0; x < (dimension == 0 ? 3 : 6); ++x) (void)real();
        const std::int64_t groups = in_.require_room(size("a number of groups"), 2);
        for (std::int64_t g = 0; g < groups; ++g) {
            const std::int64_t group = integer("a group");
            if (g == 0) group_[{dimension, tag}] = std::abs(group);
        }
        if (dimension == 0) return;
        const std::int64_t around = in_.require_room(size("a number of tags"), 2);
        for (std::int64_t b = 0; b < around; ++b) (void)integer("a tag");
    }

    void read_nodes() {
        begin_numbers();
        const std::int64_t blocks = size("a number of blocks");
        for (int i = 0; i < 3; ++i) (void)size("a number");
        std::vector<std::int64_t> ids;
        for (std::int64_t b = 0; b < blocks; ++b) {
            const auto dimension = integer("a dimension");
            (void)integer("a tag");
            const bool parametric = integer("0 or 1") != 0;
            ids.resize(static_cast<std::size_t>(in_.require_room(size("a number of nodes"), 8)));
            for (std::int64_t& id : ids) id = size("a node's number");
            for (const std::int64_t id : ids) {
                const double x = real(), y = real(), z = real();
                mesh_.add_point(id, {x, y, z});
                for (int u = 0; parametric && u < dimension; ++u) (void)real();
            }
        }
    }

    void read_elements() {
        begin_numbers();
        const std::int64_t blocks = size("a number of blocks");
        for (int i = 0; i < 3; ++i) (void)size("a number");
        for (std::int64_t b = 0; b < blocks; ++b) {
            const auto dimension = static_cast<int>(integer("a dimension"));
            const std::int64_t entity = integer("a tag");
            const std::int64_t type = integer("a type");
            const std::int64_t count = in_.require_room(size("a number of elements"), 4);
            const auto group = group_.find({dimension, entity});
            read_block(type, count, group == group_.end() ? entity : group->second);
        }
        complete_ = true;
    }

    void read_block(std::int64_t type, std::int64_t count, std::int64_t group) {
        const int corners = type == 15 ? 1 : type == 1 ? 2 : type == 2 ? 3 : type == 4 ? 4 : 0;
        if (corners == 0)
            in_.fail("begins elements of gmsh's type " + std::to_string(type) +
                     ", but only linear triangles (2) and tetrahedra (4) are read");
        if (type == 4) name_label(group);
        RawMesh::Faces* faces = type == 2 ? &named_faces(group) : nullptr;
        for (std::int64_t e = 0; e < count; ++e) {
            const std::int64_t id = size("an element's number");
            std::array<std::int64_t, 4> nodes{};
            for (int i = 0; i < corners; ++i) nodes[i] = size("a node's number");
            if (type == 4) mesh_.add_tet(id, group, nodes);
            if (faces) faces->triangles.push_back({nodes[0], nodes[1], nodes[2]});
        }
    }

    void name_label(std::int64_t label) {
        if (const auto name = names_.find({3, label}); name != names_.end())
            mesh_.names[label] = name->second;
    }
    RawMesh::Faces& named_faces(std::int64_t tag) {
        RawMesh::Faces& faces = mesh_.faces_tagged(tag);
        if (const auto name = names_.find({2, tag}); name != names_.end())
            faces.name = name->second;
        return faces;
    }

    TokenReader in_;
    RawMesh mesh_;
    double version_ = 0;
    bool binary_ = false, complete_ = false;
    std::map<Key, std::string> names_;
    std::map<Key, std::int64_t> group_;
};

}  // namespace

RawMesh parse_gmsh(std::string_view content, const std::filesystem::path& file) {
    return GmshReader(content, file).read();
}

}  // namespace myotet::meshfiles
