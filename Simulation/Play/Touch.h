// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Dynamics/BlockMatrix.h"

namespace myotet::play {

/// A point of a surface that must stay before a plane, both of which may go with nodes:
///   c(x) = n . sum_i w_i x_i - offset >= 0,
/// linear in the nodes since within a step the plane keeps its normal. Where c is below the
/// gap g it pushes by k (g - c), the derivative of k / 2 (g - c)^2. Friction [Coulomb]: what
/// slides by u along the plane is pulled back by mu k (g - c) u / max(|u|, slip): within an
/// iteration of Newton's method a spring of constant stiffness, so that it has an energy
/// [lagged as in Li and others 2020, sec. 5].
struct Touch {
    static constexpr int kMost = 6;
    std::array<std::int32_t, kMost> node{};
    std::array<double, kMost> weight{};
    int count = 0;
    Vec3 normal = Vec3::UnitZ();  ///< away from the other
    double offset = 0;            ///< mm
    double gap = 0;               ///< g, mm
    double stiffness = 0;         ///< k, N/mm
    double friction = 0;          ///< mu
    /// Where sum w x, less the other's own motion, was when the step began, mm.
    Vec3 start = Vec3::Zero();

    double apart = 0;  ///< c when the step began, mm
    /// Which two things touch, so that a touch is found again in the next step: ascending.
    std::array<std::int32_t, 3> who{0, 0, 0};

    double press = 0;           ///< max(0, g - c), mm
    double drag = 0;            ///< N/mm, of friction
    Vec3 slide = Vec3::Zero();  ///< u, mm

    void add(std::int32_t n, double w) {
        node[count] = n;
        weight[count++] = w;
    }
    /// sum w x
    [[nodiscard]] Vec3 sum(const dynamics::NodeVectors& x) const {
        Vec3 y = Vec3::Zero();
        for (int i = 0; i < count; ++i) y += weight[i] * x[node[i]];
        return y;
    }
};

/// Energy of all where nodes are at x, mJ; what presses and slides there is kept for the
/// others.
[[nodiscard]] double move_to(std::span<Touch> touches, const dynamics::NodeVectors& x);
/// Sets the springs of friction for the next iteration from what presses and slides now;
/// what slides by less than `slip` mm sticks.
void lag_friction(std::span<Touch> touches, double slip);
/// The same for a step's first iteration, with what pressed in the step `before` and how fast
/// that slid: there is no press yet where velocities lead.
void lag_friction(std::span<Touch> touches, std::span<const Touch> before, double slip);
/// Minus the gradient of the energy, N.
void add_forces(std::span<const Touch> touches, dynamics::NodeVectors& forces);
/// y += K x of those that press.
void add_product(std::span<const Touch> touches, const dynamics::NodeVectors& x,
                 dynamics::NodeVectors& y);
/// Adds the diagonal blocks of K to one matrix a node.
void add_diagonal(std::span<const Touch> touches, std::span<Mat3> diagonal);

}  // namespace myotet::play
