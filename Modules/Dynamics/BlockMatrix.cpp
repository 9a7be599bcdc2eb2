// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/BlockMatrix.h"

#include <algorithm>

#include "Core/Errors.h"
#include "Core/Parallel.h"

namespace myotet::dynamics {
namespace {

constexpr std::size_t kGrain = 512;

// For each node the cliques that hold it.
Cliques cliques_of(std::size_t nodes, const Cliques& cliques) {
    Cliques of;
    of.start.assign(nodes + 1, 0);
    for (const std::int32_t n : cliques.node) ++of.start[n + 1];
    for (std::size_t n = 0; n < nodes; ++n) of.start[n + 1] += of.start[n];
    of.node.resize(cliques.node.size());
    std::vector<std::size_t> next(of.start.begin(), of.start.end() - 1);
    for (std::size_t c = 0; c < cliques.size(); ++c)
        for (std::size_t i = cliques.start[c]; i < cliques.start[c + 1]; ++i)
            of.node[next[cliques.node[i]]++] = static_cast<std::int32_t>(c);
    return of;
}

}  // namespace

std::size_t BlockMatrix::at(std::int32_t row, std::int32_t col) const {
    const auto first = column.begin() + static_cast<std::ptrdiff_t>(row_start[row]),
               last = column.begin() + static_cast<std::ptrdiff_t>(row_start[row + 1]);
    const auto found = std::lower_bound(first, last, col);
    MYOTET_CHECK(found != last && *found == col, "blocks lie inside the pattern");
    return static_cast<std::size_t>(found - column.begin());
}

void BlockMatrix::set_zero() { std::fill(value.begin(), value.end(), Mat3(Mat3::Zero())); }

BlockMatrix block_pattern(std::size_t nodes, const Cliques& cliques) {
    const Cliques of = cliques_of(nodes, cliques);
    BlockMatrix K;
    K.row_start = {0};
    std::vector<std::int32_t> row;
    for (std::size_t n = 0; n < nodes; ++n) {
        row = {static_cast<std::int32_t>(n)};
        for (std::size_t i = of.start[n]; i < of.start[n + 1]; ++i) {
            const std::int32_t c = of.node[i];
            row.insert(row.end(),
                       cliques.node.begin() + static_cast<std::ptrdiff_t>(cliques.start[c]),
                       cliques.node.begin() + static_cast<std::ptrdiff_t>(cliques.start[c + 1]));
        }
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        K.column.insert(K.column.end(), row.begin(), row.end());
        K.row_start.push_back(K.column.size());
    }
    K.value.assign(K.column.size(), Mat3::Zero());
    return K;
}

NodeVectors multiply(const BlockMatrix& K, const NodeVectors& x) {
    NodeVectors y(K.rows());
    parallel_for(0, K.rows(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) {
            Vec3 sum = Vec3::Zero();
            for (std::size_t i = K.row_start[n]; i < K.row_start[n + 1]; ++i)
                sum += K.value[i] * x[K.column[i]];
            y[n] = sum;
        }
    });
    return y;
}

}  // namespace myotet::dynamics
