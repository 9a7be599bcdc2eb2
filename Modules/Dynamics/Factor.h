// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "Dynamics/ConjugateGradients.h"

namespace myotet::dynamics {

/// What a factor would cost.
struct FactorCost {
    double operations = 0;  ///< multiplications and additions
    double entries = 0;     ///< of the factor, 8 bytes each
};

/// Cholesky factor of the free nodes' part of a matrix (CHOLMOD's supernodal one, nested
/// dissection of the nodes): K = L L^T, for solves that no number of iterations would do.
/// The ordering is found once for a pattern. Where K is not positive, the factor is that of
/// K + s diag(K) with the first s of 1e-3, 1e-2, ... that is. One thread, so that threads
/// change no byte.
class Factor final : public Preconditioner {
public:
    Factor();
    ~Factor() override;
    Factor(const Factor&) = delete;
    Factor& operator=(const Factor&) = delete;

    /// Factors K for the nodes that are not held; the pattern and `held` shall be those of
    /// the first call. Returns false when no factor was found, as when numbers are not
    /// finite; throws ResourceError when memory is short.
    [[nodiscard]] bool compute(const BlockMatrix& K, const std::vector<char>& held);
    /// What compute() would cost; the ordering is found here if it is not known.
    [[nodiscard]] FactorCost analyze(const BlockMatrix& K, const std::vector<char>& held);
    [[nodiscard]] bool ready() const;
    /// s of the last factor, 0 when K is positive.
    [[nodiscard]] double shift() const;
    /// z = (L L^T)^-1 r on free nodes, nothing on held ones.
    void apply(const NodeVectors& r, NodeVectors& z) const override;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace myotet::dynamics
