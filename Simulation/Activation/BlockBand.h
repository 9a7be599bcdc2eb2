// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace myotet::activation {

/// A symmetric matrix of square blocks, those of its lower half that lie in a band beside the
/// diagonal. One block: a dense matrix.
class BlockBand {
public:
    BlockBand() = default;
    /// Of zeros: blocks on the diagonal, rows of each, and blocks below the diagonal's.
    BlockBand(Eigen::Index blocks, Eigen::Index size, Eigen::Index below);

    [[nodiscard]] Eigen::Index rows() const { return blocks_ * size_; }
    [[nodiscard]] Eigen::Index blocks() const { return blocks_; }
    [[nodiscard]] Eigen::Index below() const { return below_; }
    /// Block (row, column); column <= row <= column + below. On the diagonal all of it counts.
    [[nodiscard]] Eigen::MatrixXd& at(Eigen::Index row, Eigen::Index column);
    [[nodiscard]] const Eigen::MatrixXd& at(Eigen::Index row, Eigen::Index column) const;

    [[nodiscard]] Eigen::VectorXd diagonal() const;
    void add_diagonal(const Eigen::VectorXd& more);
    /// So many times another one of the same shape.
    void add(double times, const BlockBand& other);
    /// Rows and columns of unknowns that are held become those of the identity.
    void hold(const std::vector<char>& held);

    /// Its factor L L^T takes its place; false when it is not positive definite.
    /// Cost: O(rows band^2).
    [[nodiscard]] bool factor();
    /// Of a factor.
    [[nodiscard]] Eigen::VectorXd solve(Eigen::VectorXd right) const;

private:
    Eigen::Index blocks_ = 0, size_ = 0, below_ = 0;
    std::vector<Eigen::MatrixXd> block_;  ///< [column (below + 1) + row - column]
};

}  // namespace myotet::activation
