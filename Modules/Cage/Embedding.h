// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Cage/TetTree.h"

namespace myotet::cage {

/// What becomes of a point that lies in no tetrahedron.
enum class Outside {
    refused,  ///< an error
    nearest,  ///< it goes with the nearest tetrahedron, extrapolated, and is counted
};

/// Points that ride in a mesh: each is a sum of a tetrahedron's corners by four weights, and
/// stays so where the mesh deforms.
struct Embedding {
    std::vector<std::int32_t> tets;  ///< |P| indices into the mesh's tetrahedra
    std::vector<Tet> corners;        ///< |P| their corners, indices into the mesh's points
    std::vector<Weights> weights;    ///< |P| at the corners; they sum to 1
    std::size_t outside = 0;         ///< points in no tetrahedron
    double farthest = 0;             ///< of these from their tetrahedron, mm

    [[nodiscard]] std::size_t size() const { return tets.size(); }
};

/// For each point the tetrahedron that holds it and its weights there. Through a tree of
/// boxes: cost some 2 us a point and 1 us a tetrahedron, both times a logarithm; the same on
/// any number of threads. Throws MeshError where TetTree does and, with Outside::refused,
/// when a point is outside, naming the one that is farthest out; InputError when a point is
/// not finite.
[[nodiscard]] Embedding embed(const TetMesh& mesh, std::span<const Vec3> points,
                              Outside outside = Outside::refused);

/// Where the points are when the mesh's are at `nodes`: affine in each tetrahedron,
/// continuous across their faces. `points` has one entry a point. Cost: bound by memory,
/// 72 bytes a point. Throws InputError when the numbers of points or nodes do not fit.
void deform(const Embedding& embedding, std::span<const Vec3> nodes, std::span<Vec3> points);
[[nodiscard]] std::vector<Vec3> deform(const Embedding& embedding, std::span<const Vec3> nodes);

}  // namespace myotet::cage
