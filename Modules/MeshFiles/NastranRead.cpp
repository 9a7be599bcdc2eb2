// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>

#include "Core/Errors.h"
#include "MeshFiles/NamedComments.h"
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/TextReader.h"

namespace myotet::meshfiles {
namespace {

std::string trimmed(std::string_view text) {
    const std::size_t from = text.find_first_not_of(" \t\r");
    if (from == std::string_view::npos) return "";
    return std::string(text.substr(from, text.find_last_not_of(" \t\r") - from + 1));
}

/// Reads bulk data in small, large and free fields, with continuation lines.
class NastranReader {
public:
    NastranReader(std::string_view content, const std::filesystem::path& file)
        : text_(content, file), file_(file), said_(read_comments(content, '$')) {
        mesh_.space = said_.space;
        mesh_.names.insert(said_.labels.begin(), said_.labels.end());
    }

    RawMesh read() {
        while (text_.next_line()) {
            const std::string_view line = text_.rest().substr(0, text_.rest().find('$'));
            if (trimmed(line).empty()) continue;
            if (line.starts_with("BEGIN BULK")) whole_ = false;
            if (line.starts_with("ENDDATA")) {
                whole_ = true;
                break;
            }
            if (continues(line)) {
                if (!name_.empty()) add_fields(line);
                continue;
            }
            take_card();
            begin_card(line);
        }
        take_card();
        if (!whole_)
            throw IoError(file_.string() +
                          ": ends without ENDDATA; the file is cut short, copy or export it again");
        return std::move(mesh_);
    }

private:
    static bool continues(std::string_view line) {
        return line[0] == '+' || line[0] == '*' || line[0] == ',' || line[0] == ' ';
    }
    void begin_card(std::string_view line) {
        fields_.clear();
        name_ = trimmed(line.substr(0, std::min<std::size_t>(line.find(','), 8)));
        if (!name_.empty() && name_.back() == '*') name_.pop_back();
        std::ranges::transform(name_, name_.begin(),
                               [](unsigned char c) { return std::toupper(c); });
        static constexpr std::string_view kWanted[] = {"GRID", "CTETRA", "CTRIA3", "BSURFS",
                                                       "SET1", "CHEXA",  "CPENTA", "CPYRAM"};
        if (std::ranges::find(kWanted, name_) == std::end(kWanted)) name_.clear();
        if (!name_.empty()) add_fields(line);
    }
    /// The fields of one line, without its first (name) and its tenth.
    void add_fields(std::string_view line) {
        if (line.find(',') != std::string_view::npos) return add_free_fields(line);
        const bool large = line.substr(0, 8).find('*') != std::string_view::npos;
        const std::size_t width = large ? 16 : 8, count = large ? 4 : 8;
        for (std::size_t f = 0; f < count; ++f) {
            const std::size_t from = 8 + f * width;
            fields_.push_back(from < line.size() ? trimmed(line.substr(from, width)) : "");
        }
    }
    void add_free_fields(std::string_view line) {
        const bool large = line.substr(0, line.find(',')).find('*') != std::string_view::npos;
        std::size_t at = line.find(',');
        for (int f = 0; f < (large ? 4 : 8); ++f) {
            if (at == std::string_view::npos) {
                fields_.emplace_back();
                continue;
            }
            const std::size_t end = line.find(',', at + 1);
            fields_.push_back(trimmed(line.substr(at + 1, end - at - 1)));
            at = end;
        }
    }

    void take_card() {
        if (name_ == "GRID") take_grid();
        if (name_ == "CTETRA") take_tet();
        if (name_ == "CTRIA3")
            faces(integer(1)).triangles.push_back({integer(2), integer(3), integer(4)});
        if (name_ == "BSURFS") take_surface();
        if (name_ == "SET1") take_set();
        if (name_ == "CHEXA" || name_ == "CPENTA" || name_ == "CPYRAM")
            text_.fail("ends a " + name_ + ", but of solids only CTETRA is read");
        name_.clear();
    }
    [[nodiscard]] std::string field(std::size_t f) const {
        return f < fields_.size() ? fields_[f] : "";
    }
    [[nodiscard]] std::int64_t integer(std::size_t f) const {
        return text_.to_number<std::int64_t>(field(f), "a number of " + name_);
    }
    /// Nastran may leave the letter of the exponent out: 1.5-3.
    [[nodiscard]] double real(std::size_t f) const {
        std::string said = field(f);
        for (std::size_t i = 1; i < said.size(); ++i) {
            if (said[i] == 'D' || said[i] == 'd') said[i] = 'e';
            if ((said[i] == '-' || said[i] == '+') && said[i - 1] != 'e' && said[i - 1] != 'E')
                said.insert(i++, "e");
        }
        return said.empty() ? 0 : text_.to_number<double>(said, "a coordinate");
    }
    void take_grid() {
        if (!field(1).empty() && field(1) != "0")
            text_.fail("ends a GRID in coordinate system " + field(1) +
                       ", but only the basic one is read");
        mesh_.add_point(integer(0), {real(2), real(3), real(4)});
    }
    void take_tet() {
        if (!field(6).empty())
            text_.fail("ends a CTETRA of more than four nodes, but only linear ones are read");
        mesh_.add_tet(integer(0), integer(1), {integer(2), integer(3), integer(4), integer(5)});
    }
    RawMesh::Faces& faces(std::int64_t tag) {
        RawMesh::Faces& set = mesh_.faces_tagged(tag);
        if (const auto name = said_.faces.find(tag); name != said_.faces.end())
            set.name = name->second;
        return set;
    }
    void take_surface() {
        RawMesh::Faces& set = faces(integer(0));
        for (std::size_t f = 4; f < fields_.size() && !fields_[f].empty(); f += 4)
            set.triangles.push_back({integer(f + 1), integer(f + 2), integer(f + 3)});
    }
    void take_set() {
        const std::int64_t number = integer(0);
        const auto name = said_.nodes.find(number);
        RawMesh::Nodes set{name == said_.nodes.end() ? std::to_string(number) : name->second, {}};
        for (std::size_t f = 1; f < fields_.size() && !fields_[f].empty(); ++f) {
            if (field(f) == "THRU")
                text_.fail("ends a SET1 with THRU, which is not read; list the numbers");
            set.nodes.push_back(integer(f));
        }
        mesh_.nodes.push_back(std::move(set));
    }

    TextReader text_;
    const std::filesystem::path& file_;
    bool whole_ = true;  ///< ENDDATA ends what BEGIN BULK begins
    NamedComments said_;
    RawMesh mesh_;
    std::string name_;  ///< of the entry being read; empty: one that is not wanted
    std::vector<std::string> fields_;
};

}  // namespace

RawMesh parse_nastran(std::string_view content, const std::filesystem::path& file) {
    return NastranReader(content, file).read();
}

}  // namespace myotet::meshfiles
