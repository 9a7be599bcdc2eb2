// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "Dynamics/ForceField.h"

namespace myotet::dynamics {

/// Groups of nodes whose forces depend on one another's positions: a tetrahedron's
/// corners, the nodes around a node. Group g has node[start[g]] to node[start[g + 1]].
struct Cliques {
    std::vector<std::size_t> start = {0};
    std::vector<std::int32_t> node;

    void add(std::span<const std::int32_t> group) {
        node.insert(node.end(), group.begin(), group.end());
        start.push_back(node.size());
    }
    [[nodiscard]] std::size_t size() const { return start.size() - 1; }
};

/// A sparse square matrix of 3 x 3 blocks, a row and a column a node, N/mm. Rows are
/// stored whole, their columns in increasing order, so that each row is a sum of its
/// own: any number of threads gives the same bytes.
struct BlockMatrix {
    std::vector<std::size_t> row_start;  ///< |V| + 1
    std::vector<std::int32_t> column;    ///< a block
    std::vector<Mat3> value;             ///< a block

    [[nodiscard]] std::size_t rows() const { return row_start.size() - 1; }
    /// Index of a block that the pattern has.
    [[nodiscard]] std::size_t at(std::int32_t row, std::int32_t column) const;
    void set_zero();
};

/// The pattern of nodes that share a clique, and of each node with itself; all blocks
/// zero. About 72 bytes a block, 15 blocks a node in a lattice's mesh.
[[nodiscard]] BlockMatrix block_pattern(std::size_t nodes, const Cliques& cliques);

/// K x
[[nodiscard]] NodeVectors multiply(const BlockMatrix& K, const NodeVectors& x);

}  // namespace myotet::dynamics
