// SPDX-License-Identifier: Apache-2.0
#include "Activation/BlockBand.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace myotet::activation {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

BlockBand::BlockBand(Index blocks, Index size, Index below)
    : blocks_(blocks),
      size_(size),
      below_(below),
      block_(static_cast<std::size_t>(blocks * (below + 1)), MatrixXd::Zero(size, size)) {}

MatrixXd& BlockBand::at(Index row, Index column) {
    return block_[static_cast<std::size_t>(column * (below_ + 1) + row - column)];
}
const MatrixXd& BlockBand::at(Index row, Index column) const {
    return block_[static_cast<std::size_t>(column * (below_ + 1) + row - column)];
}

VectorXd BlockBand::diagonal() const {
    VectorXd out(rows());
    for (Index j = 0; j < blocks_; ++j) out.segment(j * size_, size_) = at(j, j).diagonal();
    return out;
}

void BlockBand::add_diagonal(const VectorXd& more) {
    for (Index j = 0; j < blocks_; ++j) at(j, j).diagonal() += more.segment(j * size_, size_);
}

void BlockBand::add(double times, const BlockBand& other) {
    for (std::size_t b = 0; b < block_.size(); ++b) block_[b] += times * other.block_[b];
}

void BlockBand::hold(const std::vector<char>& held) {
    const auto is_held = [&](Index block, Index i) {
        return held[static_cast<std::size_t>(block * size_ + i)] != 0;
    };
    for (Index j = 0; j < blocks_; ++j)
        for (Index k = j; k <= std::min(j + below_, blocks_ - 1); ++k) {
            MatrixXd& block = at(k, j);
            for (Index i = 0; i < size_; ++i) {
                if (is_held(k, i)) block.row(i).setZero();
                if (is_held(j, i)) block.col(i).setZero();
                if (k == j && is_held(j, i)) block(i, i) = 1;
            }
        }
}

bool BlockBand::factor() {
    for (Index j = 0; j < blocks_; ++j) {
        const Index last = std::min(j + below_, blocks_ - 1);
        Eigen::LLT<Eigen::Ref<MatrixXd>> diagonal(at(j, j));
        if (diagonal.info() != Eigen::Success) return false;
        const MatrixXd upper = at(j, j).triangularView<Eigen::Lower>().toDenseMatrix().transpose();
        for (Index k = j + 1; k <= last; ++k)
            upper.triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(at(k, j));
        for (Index c = j + 1; c <= last; ++c)
            for (Index k = c; k <= last; ++k) at(k, c).noalias() -= at(k, j) * at(c, j).transpose();
    }
    return true;
}

VectorXd BlockBand::solve(VectorXd x) const {
    const auto part = [&](Index j) { return x.segment(j * size_, size_); };
    for (Index j = 0; j < blocks_; ++j) {
        at(j, j).triangularView<Eigen::Lower>().solveInPlace(part(j));
        for (Index k = j + 1; k <= std::min(j + below_, blocks_ - 1); ++k)
            part(k).noalias() -= at(k, j) * part(j);
    }
    for (Index j = blocks_ - 1; j >= 0; --j) {
        for (Index k = j + 1; k <= std::min(j + below_, blocks_ - 1); ++k)
            part(j).noalias() -= at(k, j).transpose() * part(k);
        at(j, j).triangularView<Eigen::Lower>().transpose().solveInPlace(part(j));
    }
    return x;
}

}  // namespace myotet::activation
