// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "Contraction/Scene.h"
#include "LevelSet/LevelSet.h"
#include "MeshFiles/NamedMesh.h"

namespace myotet::contraction {

/// A bone at rest, as attachments measure it.
struct BoneShape {
    std::string name;
    /// Signed distance from a point to the bone's surface, mm, negative inside;
    /// anything of at least `bound` where it is farther than that. Called from
    /// several threads.
    std::function<double(const Vec3& point, double bound)> distance;
};

/// A closed surface, outward. Cost: O(n log n), a distance O(log n).
[[nodiscard]] BoneShape bone_of_surface(std::string name, const TriMesh& surface);

/// The pieces of a tissue, in the local coordinates of `frame`.
[[nodiscard]] BoneShape bone_of_level_sets(std::string name, std::vector<levelset::LevelSet> pieces,
                                           const Frame& frame);

/// Nodes of a body that an attachment holds.
struct HeldNodes {
    std::size_t attachment = 0;       ///< in Scene::attachments
    std::vector<std::int32_t> nodes;  ///< ascending; at least one
};

/// Finds the nodes that the attachments of a body hold, in the scene's order:
/// near_bone: those within the distance of the bone's surface or inside it;
/// node_set: those of the set; plane: those within the distance on either side.
/// Points that belong to no tetrahedron count nowhere.
/// Throws InputError at the attachment's line when it holds no node (with the
/// nearest distance), names a node set or a bone that is not there, or shares
/// nodes with another attachment, and when no node of the body stays free.
/// Cost: O(nodes log triangles), on all threads; same result on any number.
[[nodiscard]] std::vector<HeldNodes> find_held_nodes(const Scene& scene, const Body& body,
                                                     const meshfiles::NamedMesh& mesh,
                                                     std::span<const BoneShape> bones);

}  // namespace myotet::contraction
