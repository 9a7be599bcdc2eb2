// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "Elasticity/Tangent.h"
#include "Elasticity/VolumeLaw.h"

namespace myotet::elasticity {

/// What a body is made of at the points at which its energy is taken, by their numbers;
/// it may differ from one to the next, as tissue, fibre direction and activation do.
/// With linear tetrahedra there is one point a tetrahedron. Called from several threads
/// at once.
class PointLaw {
public:
    virtual ~PointLaw() = default;
    /// Energy in a unit of undeformed volume but for volume()'s, MPa; infinite where F
    /// must not be.
    [[nodiscard]] virtual double energy(std::size_t point, const Mat3& F) const = 0;
    /// P = dPsi/dF, MPa.
    [[nodiscard]] virtual Mat3 stress(std::size_t point, const Mat3& F) const = 0;
    /// dP/dF, MPa.
    [[nodiscard]] virtual Tangent tangent(std::size_t point, const Mat3& F) const = 0;
    /// The part of the energy that depends on det F alone, apart, so that a body can
    /// average det F over several points. None where a law has it in energy().
    [[nodiscard]] virtual VolumeLaw volume(std::size_t /*point*/) const { return {}; }
};

/// One law, such as NeoHookean, for all points.
template <class Law>
class OneLaw final : public PointLaw {
public:
    explicit OneLaw(const Law& law, const VolumeLaw& volume = {}) : law_(law), volume_(volume) {}
    [[nodiscard]] double energy(std::size_t, const Mat3& F) const override {
        return law_.energy(F);
    }
    [[nodiscard]] Mat3 stress(std::size_t, const Mat3& F) const override { return law_.stress(F); }
    [[nodiscard]] Tangent tangent(std::size_t, const Mat3& F) const override {
        return law_.tangent(F);
    }
    [[nodiscard]] VolumeLaw volume(std::size_t) const override { return volume_; }

private:
    Law law_;
    VolumeLaw volume_;
};

}  // namespace myotet::elasticity
