// SPDX-License-Identifier: Apache-2.0
#include "Dynamics/NodeAlgebra.h"

#include "Core/Parallel.h"

namespace myotet::dynamics {
namespace {

constexpr std::size_t kGrain = 4096;

}  // namespace

double dot(const NodeVectors& a, const NodeVectors& b) {
    return parallel_sum(0, a.size(), kGrain, [&](std::size_t first, std::size_t last) {
        double sum = 0;
        for (std::size_t i = first; i < last; ++i) sum += a[i].dot(b[i]);
        return sum;
    });
}

void add_scaled(double s, const NodeVectors& a, NodeVectors& to) {
    parallel_for(0, a.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) to[i] += s * a[i];
    });
}

}  // namespace myotet::dynamics
