// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/RawMesh.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <numeric>

#include "Core/Errors.h"

namespace myotet::meshfiles {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& defect) {
    throw InputError(file.string() + ": " + defect +
                     "; the file is damaged or of a kind that is not read, export it again");
}

std::int32_t narrow(std::int64_t value, const char* what, const std::filesystem::path& file) {
    if (value < std::numeric_limits<std::int32_t>::min() ||
        value > std::numeric_limits<std::int32_t>::max())
        refuse(file, std::string(what) + " " + std::to_string(value) + " is beyond 32 bits");
    return static_cast<std::int32_t>(value);
}

/// From a file's node numbers to indices.
class Numbering {
public:
    Numbering(const std::vector<std::int64_t>& ids, const std::filesystem::path& file)
        : file_(file), order_(ids.size()) {
        std::iota(order_.begin(), order_.end(), 0);
        if (!std::ranges::is_sorted(ids))
            std::ranges::stable_sort(order_, {}, [&](std::int32_t i) { return ids[i]; });
        sorted_.reserve(ids.size());
        for (const std::int32_t i : order_) sorted_.push_back(ids[i]);
        const auto twice = std::ranges::adjacent_find(sorted_);
        if (twice != sorted_.end())
            refuse(file_, "node number " + std::to_string(*twice) + " is given twice");
        dense_ = !sorted_.empty() &&
                 sorted_.back() - sorted_.front() + 1 == static_cast<std::int64_t>(sorted_.size());
    }
    /// Points in the order of their numbers: entry i is a place in the file's list.
    [[nodiscard]] const std::vector<std::int32_t>& order() const { return order_; }

    /// `who` and `number` say in a message what names the node.
    [[nodiscard]] std::int32_t index_of(std::int64_t id, std::string_view who,
                                        std::int64_t number) const {
        if (dense_ && id >= sorted_.front() && id <= sorted_.back())
            return static_cast<std::int32_t>(id - sorted_.front());
        const auto found = std::ranges::lower_bound(sorted_, id);
        if (found == sorted_.end() || *found != id)
            refuse(file_, std::string(who) + " " + std::to_string(number) + " names node " +
                              std::to_string(id) + ", which is not there");
        return static_cast<std::int32_t>(found - sorted_.begin());
    }

private:
    const std::filesystem::path& file_;
    std::vector<std::int32_t> order_;
    std::vector<std::int64_t> sorted_;
    bool dense_ = false;
};

void take_points(const RawMesh& raw, const Numbering& numbering, NamedMesh& named,
                 const std::filesystem::path& file) {
    // RAS and LPS differ by half a turn about the third axis.
    const Vec3 to_lps = raw.space == "RAS" ? Vec3(-1, -1, 1) : Vec3(1, 1, 1);
    named.mesh.points.reserve(raw.points.size());
    for (const std::int32_t i : numbering.order()) {
        if (!raw.points[i].allFinite())
            refuse(file, "node " + std::to_string(raw.ids[i]) +
                             " has a coordinate that is not a finite number");
        named.mesh.points.push_back(to_lps.cwiseProduct(raw.points[i]));
    }
}

void take_tets(const RawMesh& raw, const Numbering& numbering, NamedMesh& named,
               const std::filesystem::path& file) {
    std::vector<std::int32_t> order(raw.tets.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::int32_t t) { return raw.tet_ids[t]; });
    named.mesh.tets.reserve(order.size());
    for (const std::int32_t t : order) {
        Tet tet{};
        for (int i = 0; i < 4; ++i)
            tet[i] = numbering.index_of(raw.tets[t][i], "tetrahedron", raw.tet_ids[t]);
        named.mesh.tets.push_back(tet);
        named.mesh.labels.push_back(narrow(raw.labels[t], "label", file));
    }
}

void take_sets(const RawMesh& raw, const Numbering& numbering, NamedMesh& named,
               const std::filesystem::path& file) {
    for (const RawMesh::Faces& from : raw.faces) {
        FaceSet& to = named.faces.emplace_back(
            FaceSet{from.name, narrow(from.tag, "face set number", file), {}});
        const std::string who = "face set '" + from.name + "', triangle";
        for (const auto& t : from.triangles) {
            const auto number = static_cast<std::int64_t>(to.triangles.size()) + 1;
            to.triangles.push_back({numbering.index_of(t[0], who, number),
                                    numbering.index_of(t[1], who, number),
                                    numbering.index_of(t[2], who, number)});
        }
    }
    for (const RawMesh::Nodes& from : raw.nodes) {
        NodeSet& to = named.nodes.emplace_back(NodeSet{from.name, {}});
        const std::string who = "node set '" + from.name + "', entry";
        for (const std::int64_t id : from.nodes)
            to.nodes.push_back(
                numbering.index_of(id, who, static_cast<std::int64_t>(to.nodes.size()) + 1));
        std::ranges::sort(to.nodes);
    }
}

/// Formats without tags: exteriors are known by name, the rest follow.
void tag_the_untagged(NamedMesh& named) {
    std::int32_t last = kExteriorTag;
    for (const std::int32_t label : named.mesh.labels) last = std::max(last, kExteriorTag + label);
    for (const FaceSet& set : named.faces) last = std::max(last, set.tag);
    std::map<std::string, std::int32_t> exterior_tag;
    for (const auto& [label, name] : named.names)
        exterior_tag.emplace(name + "|exterior", kExteriorTag + label);
    for (FaceSet& set : named.faces) {
        if (set.tag != 0) continue;
        const auto known = exterior_tag.find(set.name);
        set.tag = known != exterior_tag.end() ? known->second : ++last;
    }
}

}  // namespace

RawMesh::Faces& RawMesh::faces_tagged(std::int64_t tag) {
    const auto found = std::ranges::find(faces, tag, &Faces::tag);
    return found != faces.end() ? *found : faces.emplace_back(Faces{std::to_string(tag), tag, {}});
}

NamedMesh checked(RawMesh&& raw, const std::filesystem::path& file) {
    if (raw.points.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) ||
        raw.tets.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()) / 4)
        throw ResourceError(file.string() + ": has " + std::to_string(raw.tets.size()) +
                            " tetrahedra, more than 32-bit indices hold; split the mesh");
    if (raw.tets.empty()) refuse(file, "holds no tetrahedra of four nodes");
    const Numbering numbering(raw.ids, file);
    NamedMesh named;
    take_points(raw, numbering, named, file);
    take_tets(raw, numbering, named, file);
    for (const auto& [label, name] : raw.names) named.names[narrow(label, "label", file)] = name;
    take_sets(raw, numbering, named, file);
    tag_the_untagged(named);
    return named;
}

void require_positive_numbers(const NamedMesh& mesh, std::string_view format) {
    const auto require = [&](const char* what, std::int32_t number) {
        if (number < 1)
            throw MeshError(std::string(what) + " " + std::to_string(number) + ": " +
                            std::string(format) +
                            " numbers its groups from 1; use another format or other labels");
    };
    for (const std::int32_t label : mesh.mesh.labels) require("label", label);
    for (const FaceSet& set : mesh.faces) require("face set number", set.tag);
}

std::size_t line_at(std::string_view content, std::ptrdiff_t offset) {
    const std::string_view before =
        content.substr(0, static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)));
    return 1 + static_cast<std::size_t>(std::ranges::count(before, '\n'));
}

bool parse_value_name(std::string_view text, std::int64_t& value, std::string& name) {
    const std::size_t start = text.find_first_not_of(" \t");
    if (start == std::string_view::npos) return false;
    text.remove_prefix(start);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end == text.data() + text.size() || *end != '=') return false;
    name = text.substr(static_cast<std::size_t>(end - text.data()) + 1);
    while (!name.empty() && (name.back() == '\r' || name.back() == ' ')) name.pop_back();
    return true;
}

}  // namespace myotet::meshfiles
