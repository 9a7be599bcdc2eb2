// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Attach.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "Contraction/Words.h"
#include "Core/Parallel.h"
#include "LevelSet/WindingTree.h"

namespace myotet::contraction {
namespace {

using meshfiles::NamedMesh;
using meshfiles::NodeSet;

constexpr double kFar = std::numeric_limits<double>::infinity();

std::vector<std::uint8_t> used_points(const TetMesh& mesh) {
    std::vector<std::uint8_t> used(mesh.points.size(), 0);
    for (const Tet& tet : mesh.tets)
        for (const std::int32_t node : tet) used[node] = 1;
    return used;
}

/// Distances of a body's nodes to what an attachment names, mm.
using Distance = std::function<double(const Vec3& point, double bound)>;

Distance distance_of(const Scene& scene, const Attachment& attachment,
                     std::span<const BoneShape> bones) {
    if (attachment.where == Where::plane)
        return [&](const Vec3& point, double) {
            return std::abs((point - attachment.point).dot(attachment.normal));
        };
    const auto bone = std::ranges::find(bones, attachment.bone, &BoneShape::name);
    if (bone != bones.end()) return bone->distance;
    std::vector<std::string> known;
    for (const BoneShape& shape : bones) known.push_back(shape.name);
    refuse(scene, attachment.line,
           "the bone '" + attachment.bone + "' has no shape" + known_are(attachment.bone, known));
}

/// Distances up to `bound`; kFar of points that no tetrahedron uses.
std::vector<double> distances(const TetMesh& mesh, const std::vector<std::uint8_t>& used,
                              const Distance& distance, double bound) {
    constexpr std::size_t kGrain = 256;
    std::vector<double> all(mesh.points.size(), kFar);
    parallel_for(0, all.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (used[i] != 0) all[i] = distance(mesh.points[i], bound);
    });
    return all;
}

std::vector<std::int32_t> nodes_within(const Scene& scene, const Attachment& attachment,
                                       const TetMesh& mesh, const std::vector<std::uint8_t>& used,
                                       std::span<const BoneShape> bones) {
    const Distance distance = distance_of(scene, attachment, bones);
    // Just above, so that a distance of `within` itself is told from the bound.
    const double bound = std::nextafter(attachment.within, kFar);
    const auto near = distances(mesh, used, distance, bound);
    std::vector<std::int32_t> nodes;
    for (std::size_t i = 0; i < near.size(); ++i)
        if (near[i] <= attachment.within) nodes.push_back(static_cast<std::int32_t>(i));
    if (nodes.empty()) {
        const auto all = distances(mesh, used, distance, kFar);
        const std::string what =
            attachment.where == Where::plane ? "the plane" : "'" + attachment.bone + "'";
        refuse(scene, attachment.line,
               "no node of '" + attachment.body + "' is within " + shown(attachment.within) +
                   " mm of " + what + ", the nearest is at " +
                   shown(*std::ranges::min_element(all)) +
                   " mm; make 'within' longer, and check that both are in one frame and in mm");
    }
    return nodes;
}

std::vector<std::int32_t> nodes_of_set(const Scene& scene, const Attachment& attachment,
                                       const NamedMesh& mesh,
                                       const std::vector<std::uint8_t>& used) {
    const auto set = std::ranges::find(mesh.nodes, attachment.node_set, &NodeSet::name);
    if (set == mesh.nodes.end()) {
        std::vector<std::string> known;
        for (const NodeSet& other : mesh.nodes) known.push_back(other.name);
        refuse(scene, attachment.line,
               "the mesh of '" + attachment.body + "' has no node set '" + attachment.node_set +
                   "'" + known_are(attachment.node_set, known));
    }
    std::vector<std::int32_t> nodes;
    for (const std::int32_t node : set->nodes)
        if (used[node] != 0) nodes.push_back(node);
    if (nodes.empty())
        refuse(scene, attachment.line,
               "the node set '" + attachment.node_set +
                   "' holds no node of a tetrahedron; choose "
                   "another, or write the set again");
    return nodes;
}

std::string called(const Attachment& attachment) {
    return attachment.bone.empty() ? "what is fixed" : "'" + attachment.bone + "'";
}

/// Refuses a node that two attachments hold.
void check_apart(const Scene& scene, const std::vector<HeldNodes>& held) {
    for (std::size_t b = 0; b < held.size(); ++b)
        for (std::size_t a = 0; a < b; ++a) {
            std::vector<std::int32_t> both;
            std::ranges::set_intersection(held[a].nodes, held[b].nodes, std::back_inserter(both));
            if (both.empty()) continue;
            std::vector<std::string> numbers;
            for (const std::int32_t node : both) numbers.push_back(std::to_string(node));
            constexpr std::size_t kMostShown = 5;
            const bool more = numbers.size() > kMostShown;
            numbers.resize(std::min(numbers.size(), kMostShown));
            const Attachment& first = scene.attachments[held[a].attachment];
            const Attachment& second = scene.attachments[held[b].attachment];
            refuse(scene, second.line,
                   std::to_string(both.size()) + " nodes of '" + second.body + "' (" +
                       list_of(numbers) + (more ? ", ..." : "") +
                       ", counted from 0) would go with " + called(second) + " and, by line " +
                       std::to_string(first.line) + ", with " + called(first) +
                       "; make 'within' shorter or choose other nodes");
        }
}

}  // namespace

BoneShape bone_of_surface(std::string name, const TriMesh& surface) {
    const auto tree =
        std::make_shared<const levelset::WindingTree>(levelset::build_winding_tree(surface));
    return {std::move(name), [tree](const Vec3& point, double bound) {
                const double distance = levelset::distance_to_triangles(*tree, point, bound);
                constexpr double kInside = 0.5;  // between 1 inside and 0 outside
                return levelset::winding_number(*tree, point) > kInside ? -distance : distance;
            }};
}

BoneShape bone_of_level_sets(std::string name, std::vector<levelset::LevelSet> pieces,
                             const Frame& frame) {
    const auto shared = std::make_shared<const std::vector<levelset::LevelSet>>(std::move(pieces));
    return {std::move(name), [shared, frame](const Vec3& point, double) {
                double least = kFar;
                for (const levelset::LevelSet& piece : *shared)
                    least = std::min(least, piece.value(frame.to_local(point)));
                return least;
            }};
}

std::vector<HeldNodes> find_held_nodes(const Scene& scene, const Body& body, const NamedMesh& mesh,
                                       std::span<const BoneShape> bones) {
    const auto used = used_points(mesh.mesh);
    std::vector<HeldNodes> held;
    std::size_t count = 0;
    for (std::size_t a = 0; a < scene.attachments.size(); ++a) {
        const Attachment& attachment = scene.attachments[a];
        if (attachment.body != body.name) continue;
        held.push_back({a, attachment.where == Where::node_set
                               ? nodes_of_set(scene, attachment, mesh, used)
                               : nodes_within(scene, attachment, mesh.mesh, used, bones)});
        count += held.back().nodes.size();
    }
    check_apart(scene, held);
    if (!held.empty() && count == static_cast<std::size_t>(std::ranges::count(used, 1)))
        refuse(scene, scene.attachments[held.front().attachment].line,
               "all " + std::to_string(count) + " nodes of '" + body.name +
                   "' are held, so that nothing of it can move; make 'within' shorter or choose "
                   "fewer nodes");
    return held;
}

}  // namespace myotet::contraction
