// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "Elasticity/Tangent.h"

namespace myotet::elasticity {

/// What the tetrahedra of a mesh are made of; it may differ from one to the next, as
/// tissue, fibre direction and activation do. Called from several threads at once.
class TetLaw {
public:
    virtual ~TetLaw() = default;
    /// Energy in a unit of undeformed volume, MPa; infinite where F must not be.
    [[nodiscard]] virtual double energy(std::size_t tet, const Mat3& F) const = 0;
    /// P = dPsi/dF, MPa.
    [[nodiscard]] virtual Mat3 stress(std::size_t tet, const Mat3& F) const = 0;
    /// dP/dF, MPa.
    [[nodiscard]] virtual Tangent tangent(std::size_t tet, const Mat3& F) const = 0;
};

/// One law, such as NeoHookean, for all tetrahedra.
template <class Law>
class OneLaw final : public TetLaw {
public:
    explicit OneLaw(const Law& law) : law_(law) {}
    [[nodiscard]] double energy(std::size_t, const Mat3& F) const override {
        return law_.energy(F);
    }
    [[nodiscard]] Mat3 stress(std::size_t, const Mat3& F) const override { return law_.stress(F); }
    [[nodiscard]] Tangent tangent(std::size_t, const Mat3& F) const override {
        return law_.tangent(F);
    }

private:
    Law law_;
};

}  // namespace myotet::elasticity
