// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/NamedMesh.h"

#include <algorithm>
#include <limits>
#include <set>
#include <unordered_map>

#include "Core/Errors.h"

namespace myotet::meshfiles {
namespace {

using Names = std::map<std::int32_t, std::string>;

std::int32_t label_of(const TetMesh& mesh, std::size_t tet) {
    return mesh.labels.empty() ? 1 : mesh.labels[tet];
}

std::string name_of(const Names& names, std::int32_t label) {
    const auto found = names.find(label);
    return found == names.end() || found->second.empty() ? std::to_string(label) : found->second;
}

Triangle sorted(Triangle face) {
    std::ranges::sort(face);
    return face;
}

struct FaceHash {
    std::size_t operator()(const Triangle& face) const {
        std::uint64_t h = 0;
        for (const std::int32_t node : face)
            h = (h ^ static_cast<std::uint32_t>(node)) * 0x9E3779B97F4A7C15u + (h >> 31);
        return h ^ (h >> 32);
    }
};

/// True when both list the same corners in the same turn.
bool same_turn(const Triangle& a, const Triangle& b) {
    return a == b || a == Triangle{b[1], b[2], b[0]} || a == Triangle{b[2], b[0], b[1]};
}

/// Lists each name once: later sets of a name are added to the first.
template <class Set, class Same, class Add>
void append_sets(std::vector<Set>& whole, const std::vector<Set>& part, Same same, Add add) {
    for (const Set& set : part) {
        const auto found =
            std::ranges::find_if(whole, [&](const Set& other) { return same(other, set); });
        if (found != whole.end())
            add(*found, set);
        else
            add(whole.emplace_back(Set{.name = set.name}), set);
    }
}

void number_interfaces(std::map<std::pair<std::int32_t, std::int32_t>, FaceSet>& interfaces,
                       std::int32_t largest_label) {
    const std::int64_t room = std::numeric_limits<std::int32_t>::max() - std::int64_t{kExteriorTag};
    if (largest_label + static_cast<std::int64_t>(interfaces.size()) > room)
        throw MeshError("label " + std::to_string(largest_label) +
                        " leaves no 32-bit number for its faces' tags; use labels below " +
                        std::to_string(room - static_cast<std::int64_t>(interfaces.size())));
    std::int32_t tag = kExteriorTag + largest_label;
    for (auto& [labels, set] : interfaces) set.tag = ++tag;
}

}  // namespace

std::map<std::int32_t, std::vector<std::int32_t>> tets_by_label(const TetMesh& mesh) {
    std::map<std::int32_t, std::vector<std::int32_t>> parts;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        parts[label_of(mesh, t)].push_back(static_cast<std::int32_t>(t));
    return parts;
}

std::vector<FaceSet> faces_by_neighbour(const TetMesh& mesh, const Names& names) {
    const std::vector<Tet> neighbours = face_neighbours(mesh.tets);
    std::map<std::int32_t, FaceSet> exteriors;
    std::map<std::pair<std::int32_t, std::int32_t>, FaceSet> interfaces;
    std::int32_t largest = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        const std::int32_t a = label_of(mesh, t);
        largest = std::max(largest, a);
        for (int i = 0; i < 4; ++i) {
            const std::int32_t behind = neighbours[t][i];
            const std::int32_t b = behind < 0 ? a : label_of(mesh, behind);
            if (behind < 0)
                exteriors[a].triangles.push_back(face_of(mesh.tets[t], i));
            else if (a < b)
                interfaces[{a, b}].triangles.push_back(face_of(mesh.tets[t], i));
        }
    }
    number_interfaces(interfaces, largest);
    std::vector<FaceSet> sets;
    for (auto& [label, set] : exteriors)
        sets.push_back(
            {name_of(names, label) + "|exterior", kExteriorTag + label, std::move(set.triangles)});
    for (auto& [labels, set] : interfaces)
        sets.push_back({name_of(names, labels.first) + "|" + name_of(names, labels.second), set.tag,
                        std::move(set.triangles)});
    return sets;
}

std::vector<NodeSet> nodes_of_faces(const std::vector<FaceSet>& faces) {
    std::vector<NodeSet> sets;
    for (const FaceSet& face_set : faces) {
        NodeSet& set = sets.emplace_back(NodeSet{face_set.name, {}});
        for (const Triangle& face : face_set.triangles)
            set.nodes.insert(set.nodes.end(), face.begin(), face.end());
        std::ranges::sort(set.nodes);
        set.nodes.erase(std::unique(set.nodes.begin(), set.nodes.end()), set.nodes.end());
    }
    return sets;
}

NamedMesh with_named_boundary(TetMesh mesh, Names names) {
    std::vector<FaceSet> faces = faces_by_neighbour(mesh, names);
    std::vector<NodeSet> nodes = nodes_of_faces(faces);
    return {std::move(mesh), std::move(names), std::move(faces), std::move(nodes)};
}

void append(NamedMesh& whole, const NamedMesh& part) {
    const auto shift = static_cast<std::int32_t>(whole.mesh.points.size());
    append(whole.mesh, part.mesh);
    whole.names.insert(part.names.begin(), part.names.end());
    append_sets(
        whole.faces, part.faces,
        [](const FaceSet& a, const FaceSet& b) { return a.name == b.name && a.tag == b.tag; },
        [&](FaceSet& to, const FaceSet& from) {
            to.tag = from.tag;
            for (const Triangle& t : from.triangles)
                to.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
        });
    append_sets(
        whole.nodes, part.nodes,
        [](const NodeSet& a, const NodeSet& b) { return a.name == b.name; },
        [&](NodeSet& to, const NodeSet& from) {
            for (const std::int32_t node : from.nodes) to.nodes.push_back(node + shift);
        });
}

Names part_names(const NamedMesh& mesh) {
    Names names;
    std::set<std::string> taken;
    for (const auto& [label, tets] : tets_by_label(mesh.mesh)) {
        const auto found = mesh.names.find(label);
        std::string name = found == mesh.names.end() || found->second.empty()
                               ? "label_" + std::to_string(label)
                               : found->second;
        while (!taken.insert(name).second) name += "_" + std::to_string(label);
        names.emplace(label, name);
    }
    return names;
}

std::vector<std::vector<FaceSides>> sides_of(const NamedMesh& mesh) {
    std::unordered_map<Triangle, FaceSides, FaceHash> at;
    for (const FaceSet& set : mesh.faces)
        for (const Triangle& face : set.triangles) at.try_emplace(sorted(face));
    // For now `inside` is the first tetrahedron of a face, `behind` the second.
    const std::vector<Tet>& tets = mesh.mesh.tets;
    for (std::size_t t = 0; t < tets.size() && !at.empty(); ++t)
        for (int i = 0; i < 4; ++i)
            if (const auto found = at.find(sorted(face_of(tets[t], i))); found != at.end()) {
                FaceSides& sides = found->second;
                (sides.inside < 0 ? sides.inside : sides.behind) =
                    static_cast<std::int32_t>(4 * t + i);
            }
    std::vector<std::vector<FaceSides>> all;
    for (const FaceSet& set : mesh.faces) {
        std::vector<FaceSides>& of_set = all.emplace_back();
        for (const Triangle& face : set.triangles) {
            FaceSides sides = at.at(sorted(face));
            if (sides.inside < 0)
                throw MeshError("face set '" + set.name + "': the triangle of nodes " +
                                std::to_string(face[0]) + ", " + std::to_string(face[1]) + ", " +
                                std::to_string(face[2]) +
                                " is no face of a tetrahedron; name faces of the mesh");
            if (!same_turn(face, face_of(tets[sides.inside / 4], sides.inside % 4)))
                std::swap(sides.inside, sides.behind);
            of_set.push_back(sides);
        }
    }
    return all;
}

}  // namespace myotet::meshfiles
