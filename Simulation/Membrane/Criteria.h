// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Membrane/Forces.h"

namespace myotet::membrane {

/// Where the surface is refined [Choi05, criterion for refinement]: near nodes at
/// which one of three is above its threshold. None depends on the level.
struct Criteria {
    double traction = 1e-5;   ///< force of patches and tools over the node's area, MPa
    double speed = 50;        ///< mm/s
    double curvature = 0.02;  ///< change of the mean curvature since rest, 1/mm
    /// Besides, what a tool comes nearer to than this, mm: so what it first touches is
    /// fine already, and its force is right from the beginning.
    double reach = 2;
    /// What is refined stays so until all three have been below this part of their
    /// thresholds, and no tool near, for `calm` seconds: so nothing flickers.
    double release = 0.5;
    double calm = 0.1;       ///< s
    int rings = 0;           ///< of a level's triangles that are refined around those, too
    double interval = 0.01;  ///< between two looks, s

    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// Mean curvature at the nodes in use, 1/mm, positive where the surface bulges
/// outward: the mean over a node's springs of 2 n . (x_i - x_j) / |x_i - x_j|^2
/// with n the normal of the drawn triangles; |V| of the finest level.
[[nodiscard]] std::vector<double> mean_curvatures(const Active& active, std::span<const Vec3> x);

/// What the looks so far found.
struct Watch {
    std::vector<double> calm_from;  ///< |V|: when a node may be simplified, s
    std::vector<char> hot;          ///< |V|: whether above a threshold now
};

/// Looks at all nodes and triangles in use.
void look(const Criteria& criteria, const Body& body, const Motion& motion,
          std::span<const Vec3> pressing, Watch& watch);

/// Refines and simplifies by at most one level everywhere; says whether anything
/// changed.
bool adapt(const Criteria& criteria, const Levels& levels, const Watch& watch, double time,
           Selection& selection);

}  // namespace myotet::membrane
