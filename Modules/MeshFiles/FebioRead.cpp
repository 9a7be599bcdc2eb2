// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <pugixml.hpp>
#include <utility>

#include "Core/Errors.h"
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/RawSurface.h"

namespace myotet::meshfiles {
namespace {

class FebioReader {
public:
    FebioReader(std::string_view content, const std::filesystem::path& file)
        : content_(content), file_(file) {}

    RawMesh read() {
        const auto result = document_.load_buffer(content_.data(), content_.size(),
                                                  pugi::parse_default | pugi::parse_comments);
        if (!result)
            fail(result.offset, std::string("is not valid XML (") + result.description() + ")");
        const pugi::xml_node spec = document_.child("febio_spec");
        const std::string_view version = spec.attribute("version").value();
        if (version != "4.0" && version != "3.0")
            fail(spec.offset_debug(), "begins no febio_spec of version 3.0 or 4.0");
        for (const pugi::xml_node note : spec)
            if (note.type() == pugi::node_comment && mesh_.space.empty())
                mesh_.space = space_said_by(note.value());
        for (const pugi::xml_node node : spec.child("Mesh")) read_part(node);
        return std::move(mesh_);
    }

private:
    void read_part(const pugi::xml_node& node) {
        const std::string_view kind = node.name();
        if (kind == "Nodes")
            read_nodes(node);
        else if (kind == "Elements")
            read_elements(node);
        else if (kind == "NodeSet")
            mesh_.nodes.push_back({name_of(node), integers(node)});
        else if (kind == "Surface")
            read_surface(node);
        else if (node.type() == pugi::node_comment)
            remark_ = node.value();
    }

    void read_nodes(const pugi::xml_node& nodes) {
        for (const pugi::xml_node node : nodes.children("node")) {
            const auto x = numbers<double>(node);
            require(node, x.size() == 3, "has not three coordinates");
            mesh_.add_point(id_of(node), {x[0], x[1], x[2]});
        }
    }

    void read_elements(const pugi::xml_node& elements) {
        const std::string_view type = elements.attribute("type").value();
        if (type != "tet4")
            refuse(elements,
                   "holds elements of type '" + std::string(type) + "', but only tet4 is read");
        const std::int64_t label = number_in_remark("label ", next_label_);
        next_label_ = std::max(next_label_, label + 1);
        mesh_.names[label] = name_of(elements);
        for (const pugi::xml_node element : elements.children("elem")) {
            const auto c = numbers<std::int64_t>(element);
            require(element, c.size() == 4, "has not four nodes");
            mesh_.add_tet(id_of(element), label, {c[0], c[1], c[2], c[3]});
        }
    }

    void read_surface(const pugi::xml_node& surface) {
        RawMesh::Faces& faces = mesh_.faces.emplace_back(RawMesh::Faces{name_of(surface), 0, {}});
        faces.tag = number_in_remark("tag ", 0);
        for (const pugi::xml_node face : surface.children()) {
            if (face.type() != pugi::node_element) continue;
            const auto c = numbers<std::int64_t>(face);
            require(face, c.size() == 3, "is no triangle of three nodes");
            faces.triangles.push_back({c[0], c[1], c[2]});
        }
    }

    static std::string name_of(const pugi::xml_node& node) {
        return node.attribute("name").value();
    }
    std::int64_t id_of(const pugi::xml_node& node) const {
        const std::string_view said = node.attribute("id").value();
        std::int64_t id = 0;
        const auto [end, error] = std::from_chars(said.data(), said.data() + said.size(), id);
        require(node, error == std::errc{} && end == said.data() + said.size(),
                "has no number as id");
        return id;
    }
    std::vector<std::int64_t> integers(const pugi::xml_node& node) const {
        return numbers<std::int64_t>(node);
    }

    /// The numbers of an element's text, between commas or blanks.
    template <class Number>
    std::vector<Number> numbers(const pugi::xml_node& node) const {
        constexpr std::string_view kBetween = ", \t\r\n";
        std::vector<Number> found;
        std::string_view text = node.text().get();
        for (std::size_t from = text.find_first_not_of(kBetween); from != std::string_view::npos;
             from = text.find_first_not_of(kBetween)) {
            text.remove_prefix(from);
            const std::string_view word = text.substr(0, text.find_first_of(kBetween));
            Number value{};
            const auto [end, error] =
                std::from_chars(word.data(), word.data() + word.size(), value);
            if (error != std::errc{} || end != word.data() + word.size())
                refuse(node, "holds '" + std::string(word.substr(0, 40)) +
                                 "' where a number should stand");
            found.push_back(value);
            text.remove_prefix(word.size());
        }
        return found;
    }

    /// What the comment before a part says, as ` label 7 `; it serves once.
    std::int64_t number_in_remark(std::string_view what, std::int64_t otherwise) {
        const std::string remark = std::exchange(remark_, {});
        const std::size_t at = remark.find(what);
        if (at == std::string::npos) return otherwise;
        std::int64_t value = otherwise;
        std::from_chars(remark.data() + at + what.size(), remark.data() + remark.size(), value);
        return value;
    }

    void require(const pugi::xml_node& node, bool holds, const char* defect) const {
        if (!holds) refuse(node, defect);
    }
    [[noreturn]] void refuse(const pugi::xml_node& node, const std::string& defect) const {
        fail(node.offset_debug(), "(<" + std::string(node.name()) + ">) " + defect);
    }
    [[noreturn]] void fail(std::ptrdiff_t offset, const std::string& defect) const {
        throw InputError(file_.string() + ": line " + std::to_string(line_at(content_, offset)) +
                         " " + defect +
                         "; the file is damaged or of a kind that is not read, export it again");
    }

    std::string_view content_;
    const std::filesystem::path& file_;
    pugi::xml_document document_;
    RawMesh mesh_;
    std::string remark_;
    std::int64_t next_label_ = 1;
};

}  // namespace

RawMesh parse_febio(std::string_view content, const std::filesystem::path& file) {
    return FebioReader(content, file).read();
}

}  // namespace myotet::meshfiles
