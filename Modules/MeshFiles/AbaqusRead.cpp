// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <unordered_map>
#include <utility>

#include "MeshFiles/RawMesh.h"
#include "MeshFiles/RawSurface.h"
#include "MeshFiles/TextReader.h"

namespace myotet::meshfiles {
namespace {

/// C3D4's faces S1 to S4 are nodes 1-2-3, 1-4-2, 2-4-3 and 3-4-1, outward.
constexpr int kCorners[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

class AbaqusReader {
public:
    AbaqusReader(std::string_view content, const std::filesystem::path& file)
        : text_(content, file), file_(file) {}

    RawMesh read() {
        while (text_.next_line()) {
            const std::string_view line = text_.rest();
            if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
            if (line.starts_with("**"))
                remark_ = line;
            else if (line.starts_with('*'))
                begin_keyword(line);
            else
                read_data(line);
        }
        if (ours_ && !remark_.starts_with(kAbaqusEnd))
            throw IoError(file_.string() +
                          ": ends before its last line; the file is cut short, copy or export "
                          "it again");
        resolve_element_sets();
        resolve_surfaces();
        return std::move(mesh_);
    }

private:
    struct Side {
        std::string element_or_set;
        int face = 0;
    };

    /// Fields between commas, without blanks around them; a comma in quotes is none.
    void split(std::string_view line) {
        fields_.clear();
        std::string field;
        bool quoted = false;
        const auto end_field = [&] {
            while (!field.empty() &&
                   (field.back() == ' ' || field.back() == '\r' || field.back() == '\t'))
                field.pop_back();
            fields_.push_back(std::exchange(field, {}));
        };
        for (const char c : line) {
            if (c == '"') quoted = !quoted;
            if (c == ',' && !quoted)
                end_field();
            else if (!field.empty() || (c != ' ' && c != '\t'))
                field += c;
        }
        end_field();
    }
    static std::string upper(std::string text) {
        std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
        return text;
    }
    static std::string unquoted(std::string name) {
        std::erase(name, '"');
        return name;
    }
    /// The value of a keyword's parameter, or empty.
    [[nodiscard]] std::string parameter(const std::string& wanted) const {
        for (const std::string& field : fields_) {
            const std::size_t equals = field.find('=');
            std::string name = upper(field.substr(0, equals));
            while (!name.empty() && name.back() == ' ') name.pop_back();
            if (name != wanted) continue;
            if (equals == std::string::npos) return wanted;
            const std::size_t from = field.find_first_not_of(' ', equals + 1);
            return from == std::string::npos ? "" : unquoted(field.substr(from));
        }
        return "";
    }

    void begin_keyword(std::string_view line) {
        split(line);
        keyword_ = upper(fields_.front());
        generate_ = !parameter("GENERATE").empty();
        const std::string remark = std::exchange(remark_, {});
        if (keyword_ == "*ELEMENT") begin_elements(remark);
        if (keyword_ == "*ELSET") set_ = &element_sets_.emplace_back(parameter("ELSET"), Ids{});
        if (keyword_ == "*NSET") mesh_.nodes.push_back({parameter("NSET"), {}});
        if (keyword_ == "*SURFACE") {
            if (const std::string type = upper(parameter("TYPE"));
                type != "ELEMENT" && !type.empty())
                keyword_.clear();  // a surface of nodes
            else
                begin_surface(remark);
        }
    }
    void begin_elements(const std::string& remark) {
        const std::string type = upper(parameter("TYPE"));
        is_tet_ = type == "C3D4" || type == "C3D4H";
        if (!is_tet_ && type.starts_with("C3D"))
            text_.fail("begins elements of type " + type + ", but only C3D4 is read");
        const std::string set = parameter("ELSET");
        const auto known = label_of_.find(set);
        if (known != label_of_.end() && !set.empty()) {
            label_ = known->second;
            return;
        }
        label_ = number_in(remark, "label ", next_label_);
        next_label_ = std::max(next_label_, label_ + 1);
        if (is_tet_ && !set.empty()) {
            label_of_[set] = label_;
            mesh_.names[label_] = set;
        }
    }
    void begin_surface(const std::string& remark) {
        mesh_.faces.push_back({parameter("NAME"), number_in(remark, "tag ", 0), {}});
        sides_.emplace_back();
    }
    static std::int64_t number_in(std::string_view text, std::string_view what,
                                  std::int64_t otherwise) {
        const std::size_t at = text.find(what);
        if (at == std::string_view::npos) return otherwise;
        std::int64_t value = otherwise;
        std::from_chars(text.data() + at + what.size(), text.data() + text.size(), value);
        return value;
    }

    void read_data(std::string_view line) {
        if (keyword_ == "*HEADING" && line.starts_with("Myotet")) ours_ = true;
        if (keyword_ == "*HEADING" && mesh_.space.empty()) mesh_.space = space_said_by(line);
        const bool wanted = keyword_ == "*NODE" || (keyword_ == "*ELEMENT" && is_tet_) ||
                            keyword_ == "*ELSET" || keyword_ == "*NSET" || keyword_ == "*SURFACE";
        if (!wanted) return;
        split(line);
        if (keyword_ == "*NODE") read_node();
        if (keyword_ == "*ELEMENT") read_tet();
        if (keyword_ == "*ELSET") read_members(set_->second, set_->first);
        if (keyword_ == "*NSET") read_members(mesh_.nodes.back().nodes, mesh_.nodes.back().name);
        if (keyword_ == "*SURFACE") read_side();
    }
    std::int64_t integer(std::size_t field, const char* what) const {
        return text_.to_number<std::int64_t>(field < fields_.size() ? fields_[field] : "", what);
    }
    double real(std::size_t field) const {
        return text_.to_number<double>(field < fields_.size() ? fields_[field] : "",
                                       "a coordinate");
    }
    void read_node() {
        mesh_.add_point(integer(0, "a node's number"), {real(1), real(2), real(3)});
    }
    void read_tet() {
        constexpr const char* kNode = "a node's number";
        const std::int64_t id = integer(0, "an element's number");
        mesh_.add_tet(id, label_,
                      {integer(1, kNode), integer(2, kNode), integer(3, kNode), integer(4, kNode)});
        tet_at_[id] = mesh_.tets.size() - 1;
    }
    using Ids = std::vector<std::int64_t>;
    void read_members(Ids& ids, const std::string& name) {
        if (generate_) {
            const std::int64_t first = integer(0, "a number"), last = integer(1, "a number");
            const std::int64_t step = fields_.size() > 2 ? integer(2, "a step") : 1;
            const auto most = static_cast<std::int64_t>(mesh_.points.size() + mesh_.tets.size());
            if (step < 1 || last < first || (last - first) / step > most)
                text_.fail("generates no set of numbers ('" + name + "')");
            for (std::int64_t id = first; id <= last; id += step) ids.push_back(id);
            return;
        }
        for (std::size_t f = 0; f < fields_.size(); ++f)
            if (!fields_[f].empty()) ids.push_back(integer(f, "a number"));
    }
    void read_side() {
        const std::string face = fields_.size() > 1 ? upper(fields_[1]) : "";
        if (face.size() != 2 || face[0] != 'S' || face[1] < '1' || face[1] > '4')
            text_.fail("names no face S1 to S4 of an element");
        sides_.back().push_back({unquoted(fields_[0]), face[1] - '1'});
    }

    /// Element sets are parts where *ELEMENT names none.
    void resolve_element_sets() {
        if (!label_of_.empty() || element_sets_.empty()) return;
        std::ranges::fill(mesh_.labels, 0);
        next_label_ = 1;
        for (const auto& [name, ids] : element_sets_) {
            bool used = false;
            for (const std::int64_t id : ids)
                if (const auto found = tet_at_.find(id); found != tet_at_.end()) {
                    mesh_.labels[found->second] = next_label_;
                    used = true;
                }
            if (used) mesh_.names[next_label_++] = name;
        }
        std::ranges::replace(mesh_.labels, 0, next_label_);  // those of no set
    }
    void add_face(RawMesh::Faces& faces, std::int64_t element, int face) const {
        const auto found = tet_at_.find(element);
        if (found == tet_at_.end())
            text_.fail("ends a file whose surface '" + faces.name + "' names element " +
                       std::to_string(element) + ", which is not there");
        const auto& tet = mesh_.tets[found->second];
        const auto& c = kCorners[face];
        faces.triangles.push_back({tet[c[0]], tet[c[1]], tet[c[2]]});
    }
    void resolve_surfaces() {
        for (std::size_t s = 0; s < sides_.size(); ++s)
            for (const Side& side : sides_[s]) {
                const auto set = std::ranges::find(element_sets_, side.element_or_set,
                                                   &std::pair<std::string, Ids>::first);
                if (set == element_sets_.end())
                    add_face(
                        mesh_.faces[s],
                        text_.to_number<std::int64_t>(side.element_or_set, "an element's number"),
                        side.face);
                else
                    for (const std::int64_t id : set->second)
                        add_face(mesh_.faces[s], id, side.face);
            }
    }

    TextReader text_;
    const std::filesystem::path& file_;
    RawMesh mesh_;
    std::string keyword_, remark_;
    std::vector<std::string> fields_;
    bool ours_ = false, is_tet_ = false, generate_ = false;
    std::int64_t label_ = 1, next_label_ = 1;
    std::map<std::string, std::int64_t> label_of_;  ///< element set of *ELEMENT -> label
    std::vector<std::pair<std::string, Ids>> element_sets_;
    std::pair<std::string, Ids>* set_ = nullptr;
    std::vector<std::vector<Side>> sides_;  ///< one a face set
    std::unordered_map<std::int64_t, std::size_t> tet_at_;
};

}  // namespace

RawMesh parse_abaqus(std::string_view content, const std::filesystem::path& file) {
    return AbaqusReader(content, file).read();
}

}  // namespace myotet::meshfiles
