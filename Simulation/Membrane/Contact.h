// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Membrane/Forces.h"

namespace myotet::membrane {

/// How far a sphere that forces drive may sink into the wall, in radii: beyond,
/// what it touches no longer pushes it back.
inline constexpr double kMostSunk = 1;

/// Where a tool is, mm: as told, or, driven by a force F, gone by the least s at
/// which F = sum k A_i d_i(s) n_i . way over the nodes, A_i being a node's area, d_i
/// its depth in the tool and n_i the unit vector out of it there.
/// `sunk`, if given, receives whether there is none and the tool stopped at
/// kMostSunk. Cost: O(nodes in use).
[[nodiscard]] Vec3 place_of(const Tool& tool, const Body& body, const Motion& motion,
                            bool* sunk = nullptr);

/// Adds what all tools do to the nodes, N: k A_i d_i n_i.
void add_tools(const Body& body, const Motion& motion, std::vector<Vec3>& force);

/// What the wall does to a tool, and the mean displacement of what it touches, by
/// the size of the force there.
struct Touch {
    Vec3 place = Vec3::Zero();  ///< of the tool, mm
    Vec3 force = Vec3::Zero();  ///< N
    double displacement = 0;    ///< mm; 0 where nothing touches
    std::size_t nodes = 0;      ///< that it touches
    bool sunk = false;          ///< see place_of
};
[[nodiscard]] Touch touch_of(const Tool& tool, const Body& body, const Motion& motion);

}  // namespace myotet::membrane
