// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "Core/TetMesh.h"

namespace myotet::meshfiles {

/// Faces under one name.
struct FaceSet {
    std::string name;                 ///< `A|exterior`, `A|B`
    std::int32_t tag = 0;             ///< number where a format wants one
    std::vector<Triangle> triangles;  ///< corners in mesh.points, outward from A
};

/// Nodes under one name.
struct NodeSet {
    std::string name;
    std::vector<std::int32_t> nodes;  ///< indices into mesh.points, ascending
};

/// A mesh with the names that its files carry. Points are mm in the patient
/// frame LPS. Without tetrahedra it is a surface, made of its face sets.
struct NamedMesh {
    TetMesh mesh;                               ///< labels are the scan's values
    std::map<std::int32_t, std::string> names;  ///< by label value
    std::vector<FaceSet> faces;
    std::vector<NodeSet> nodes;
};

/// Exterior faces of label L have the tag kExteriorTag + L, as SimNIBS has it.
inline constexpr std::int32_t kExteriorTag = 1000;

/// The boundary of a mesh of one or several labels, by neighbour: for each
/// label A the faces with nothing behind them, `A|exterior`, and for each pair
/// of labels A < B that share faces, `A|B`, outward from A. Interfaces are
/// tagged by the numbers that follow the largest label's exterior tag, in the
/// order of (A, B). Sets are in the order of their tags; within a set, faces
/// are in the order of A's tetrahedra. A label without a name goes by its
/// value. Throws MeshError when a label is so large that its tags are none.
/// Cost: O(|T|).
[[nodiscard]] std::vector<FaceSet> faces_by_neighbour(
    const TetMesh& mesh, const std::map<std::int32_t, std::string>& names);

/// A node set for each face set, of its nodes and by its name.
[[nodiscard]] std::vector<NodeSet> nodes_of_faces(const std::vector<FaceSet>& faces);

/// The mesh with its boundary named: faces_by_neighbour and nodes_of_faces.
[[nodiscard]] NamedMesh with_named_boundary(TetMesh mesh,
                                            std::map<std::int32_t, std::string> names);

/// Adds tetrahedra, names, faces and nodes of `part`; face sets of the same
/// name and tag become one, as do node sets of the same name.
void append(NamedMesh& whole, const NamedMesh& part);

/// A name for each label of the mesh, none twice and none empty: what formats
/// need that know parts by name alone. A missing name is `label_<value>`, one
/// that another label has gets its value after it.
[[nodiscard]] std::map<std::int32_t, std::string> part_names(const NamedMesh& mesh);

/// Tetrahedra of each label, by label value; a mesh without labels is of label 1.
[[nodiscard]] std::map<std::int32_t, std::vector<std::int32_t>> tets_by_label(const TetMesh& mesh);

/// Where a face of a face set lies: 4 * tetrahedron + face (as face_of counts
/// them) of the tetrahedron it is outward for, and of the one behind it; -1
/// where there is none.
struct FaceSides {
    std::int32_t inside = -1, behind = -1;
};

/// One element a face set, with the sides of each of its triangles. Throws
/// MeshError when a triangle is no face of a tetrahedron.
/// Cost: O(|T| + |F|).
[[nodiscard]] std::vector<std::vector<FaceSides>> sides_of(const NamedMesh& mesh);

}  // namespace myotet::meshfiles
