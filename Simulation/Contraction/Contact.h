// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Contraction/ContactField.h"
#include "Core/TetMesh.h"
#include "Elasticity/Points.h"

namespace myotet::contraction {

/// How bodies push each other away. A node that stands for the area A of a surface and is
/// at the distance d from another one stores
///   k A (gap - d)^2 / 2   where d < gap, and nothing elsewhere:
/// the pressure on it is p = k (gap - d), MPa, whatever the mesh [penalty method: Wriggers
/// 2006, sec. 5.3 and 6.3]. Where two surfaces press on each other both ways, from a to b
/// and from b to a, both pressures add up: each way has half of k.
struct PenaltyLaw {
    /// k, pressure a depth, MPa/mm = N/mm^3. 1: muscles at 0.05 MPa sink in by 0.05 mm, less
    /// than a scan resolves; of a tetrahedron of 2 mm it is as stiff as 2 MPa, a few times
    /// muscle, so that solves stay easy.
    double stiffness = 1;
    double gap = 0;  ///< at which pressing begins, mm
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// Nodes of a surface that feel others, ascending, and the undeformed area that each stands
/// for, mm^2.
struct ContactNodes {
    std::vector<std::int32_t> node;
    std::vector<double> area;
};

/// The corners of a surface's triangles, with a third of the area of each that meets there,
/// but for those left out: nodes that an attachment holds, or that two bodies share.
/// Throws InputError when a triangle names a node that is not there.
[[nodiscard]] ContactNodes contact_nodes(const std::vector<Vec3>& rest,
                                         const std::vector<Triangle>& surface,
                                         std::span<const std::int32_t> left_out);

/// A node's distance at rest where that is less than the law's gap, else the gap: overlap
/// at rest is forgiven. Throws InputError when a node is not among `rest`, its area is not
/// positive, or there is no level set.
[[nodiscard]] std::vector<double> gaps_at_rest(const ContactNodes& nodes,
                                               const std::vector<Vec3>& rest,
                                               const ContactField& other, double gap);

/// Eight linear tetrahedra for each quadratic one, of the same nodes, which together fill it
/// where its edges are straight: contact sees a quadratic body as these, and their
/// boundary_faces as its surface.
[[nodiscard]] std::vector<Tet> linear_pieces(const elasticity::QuadraticMesh& mesh);

/// What presses where nodes were last.
struct ContactReport {
    int nodes = 0;              ///< that are pressed on
    double area = 0;            ///< undeformed, that they stand for, mm^2
    double max_depth = 0;       ///< below the other surface and below where they were at rest, mm
    double mean_depth = 0;      ///< of that, over the area, mm
    double max_pressure = 0;    ///< MPa
    double total = 0;           ///< sum of the forces' sizes, N
    Vec3 force = Vec3::Zero();  ///< their resultant on the nodes, N; minus it on the other
};

/// The gap less the distance, where it is positive, of a node among others.
struct ContactTouch {
    double area = 0;             ///< mm^2
    double press = 0;            ///< gap - d, mm; 0: it does not touch
    double depth = 0;            ///< as ContactReport has it
    Vec3 normal = Vec3::Zero();  ///< derivative of d by the node's position
};
[[nodiscard]] ContactReport report_of(std::span<const ContactTouch> touches, double stiffness);

}  // namespace myotet::contraction
