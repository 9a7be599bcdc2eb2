// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "Core/TetMesh.h"

namespace myotet::meshing {

/// Where a selection breaks the rules of [Teran05, sec. 6].
struct Trouble {
    std::vector<std::int32_t> nodes;  ///< non-manifold boundary nodes
    std::vector<std::array<std::int32_t, 2>>
        edges;                           ///< interior edges between boundary nodes, sorted
    std::vector<std::int32_t> left_out;  ///< nodes well inside, in no selected tetrahedron
    std::vector<std::int32_t> wishes;    ///< boundary nodes with three faces
    bool only_wishes = false;            ///< nothing but wishes is left

    [[nodiscard]] bool empty() const {
        return nodes.empty() && edges.empty() && left_out.empty() && wishes.empty();
    }
    [[nodiscard]] bool holds_edge(std::int32_t a, std::int32_t b) const;
};

/// The set of enveloped nodes over a fixed conforming mesh; a tetrahedron is
/// selected when one of its nodes is enveloped, so no selected tetrahedron has
/// four boundary nodes.
class Selection {
public:
    /// `tets` and `phi` (a value a node) must outlive the selection.
    Selection(const std::vector<Tet>& tets, const std::vector<float>& phi,
              std::function<Vec3(std::int32_t)> position);

    [[nodiscard]] std::size_t node_count() const { return phi_.size(); }
    [[nodiscard]] bool in_mesh(std::size_t tet) const { return in_mesh_[tet] != 0; }

    /// Envelops nodes with phi < 0 all of whose crossing edges are at least 25 %
    /// inside; where there is none, the deepest node.
    void envelop_inside();
    /// Selects the tetrahedra whose mean phi is negative, and envelops nothing.
    void select_inside();
    /// What is wrong now.
    [[nodiscard]] Trouble examine(bool avoid_three_faces) const;
    /// Envelops troubled nodes and the deeper end of troubled edges. Returns how
    /// many were new.
    std::size_t envelop(const Trouble& trouble);
    /// When there are more than `wanted` pieces, envelops the nodes on the deepest
    /// way from the smallest piece to another; false when nothing was to be done.
    bool join_pieces(int wanted);

private:
    bool envelop_node(std::int32_t node);
    void find_left_out(Trouble& trouble) const;
    [[nodiscard]] std::span<const std::int32_t> star(std::int32_t node) const {
        return {star_.data() + star_start_[node], star_.data() + star_start_[node + 1]};
    }

    const std::vector<Tet>& tets_;
    const std::vector<float>& phi_;
    std::function<Vec3(std::int32_t)> position_;
    std::vector<Tet> neighbours_;
    std::vector<std::int32_t> star_start_, star_;  // tetrahedra at each node
    std::vector<char> hull_;                       // nodes on the end of the lattice
    std::vector<char> enveloped_;
    std::vector<char> in_mesh_;
};

}  // namespace myotet::meshing
