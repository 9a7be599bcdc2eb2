// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Progress.h"
#include "Core/TetMesh.h"
#include "LevelSet/LevelSet.h"

namespace myotet::meshing {

// Optimisation-based compression [Teran05, sec. 8], made smooth. Each node in
// turn minimises
//
//     E = sum over its tetrahedra of q^m + mu * F
//
// by Newton's method with a line search. q = S^3 / (432 (6 V)^2), S the sum of
// the six squared edges, is 1 for a regular tetrahedron and infinite for a flat
// one, so that no tetrahedron can invert. F is the integral of
// d^2 (1 + d^2 / f^2), d = (phi - c) / h, f = 0.07 or less, over the boundary
// faces around the node: fitting faces and not only nodes makes the surface straddle phi = c,
// which keeps the volume; the fourth power holds back the farthest places. mu
// grows from sweep to sweep, as the paper moves boundary nodes gradually; m
// grows too, so that the worst elements come to decide. In the last rounds the sum is
// AngleEnergy's, which knows dihedral angles and aspect ratios themselves, over the nodes
// of the few elements near or beyond a goal. There mu is lowered, round by round, and where
// the distance is held it is raised at the few places that are too far; the round that
// came nearest to both goals is kept.
//
// The mesh must be positive and stays so. Same bytes on any number of threads:
// nodes are coloured, and the colours swept in order.

/// The first part: drives the candidate's boundary onto phi = 0.
void fit_surface(TetMesh& mesh, const levelset::LevelSet& phi, ProgressSink& progress);

/// What the second part shall reach.
struct PolishOptions {
    double volume = 0;  ///< of the mesh, mm^3; 0: none asked
    /// The surface's distance is promised (14 % of the median surface edge), with angles
    /// within 22.5 and 134 degrees and aspect ratios below 3.95, until all holds or the
    /// rounds end. Without, it gives way until all angles lie within 28 and 116 degrees
    /// and aspect ratios below 3.4, or 2.6 on smooth shapes.
    bool hold_distance = true;
    /// Only the whole mesh is relaxed; nothing is done for the worst elements.
    bool draft = false;
};

/// The second part: improves the elements, worst last, and reaches the volume by fitting
/// phi = c instead of 0. Returns c, mm.
double polish(TetMesh& mesh, const levelset::LevelSet& phi, const PolishOptions& options,
              ProgressSink& progress);

}  // namespace myotet::meshing
