// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Contraction/Contact.h"
#include "Dynamics/Potential.h"

namespace myotet::contraction {

struct BodyContactOptions {
    PenaltyLaw law;
    /// Nodes so near to the other body are watched, mm: more than the law's gap and what
    /// nodes move in a step, since what comes from farther is not felt before the next one.
    double reach = 5;
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// A body that nodes are pressed on: its tetrahedra and its shape at rest.
struct ContactBody {
    std::vector<Tet> tets;
    ContactField shape;
};

/// A deforming body pushes nodes of another one away by PenaltyLaw, without friction, and is
/// pushed back. Both ways by two of these, one each.
///
/// Before each step `update_pairs` gives each node near the body the tetrahedron that holds
/// it or is nearest; it keeps it while the step is solved. Where that has the deformation
/// gradient F, the node at x is at X = sum_i lambda_i X_i = X_0 + F^-1 (x - x_0) in the body
/// at rest, linearly extrapolated outside, and presses by
///   s (gap - phi(X)),   s = 1 / |F^-T n|, n = grad phi / |grad phi|.
/// s is how much the body has stretched along its normal, which makes a distance of the body
/// at rest one of now; it is that of the last update_pairs (5 % of strain in a step
/// are up to 5 % of pressure until the next), so that forces are exactly minus the gradient
/// of the energy. They act on the node and, opposite, on the four corners by
/// lambda_i: neither force nor torque is left over, extrapolated or not.
///
/// What overlaps at rest is forgiven as in BoneContact: a node that keeps its place in the
/// body feels nothing.
///
/// The stiffness is, over the five nodes and with y = dx - sum lambda_i dx_i, u = F^-T
/// grad phi, H the second derivative of phi and g_i = F^-T grad lambda_i,
///   k A [(s u . y)^2 - s g (y . F^-T H F^-1 y - 2 sum_i (u . dx_i)(g_i . y))],
/// g being what presses now or did when the stiffness was last asked for, as in BoneContact.
///
/// Cost: about 1 us a touching node in move_to, add_stiffness the same; update_pairs that of
/// nearest_tets. Same bytes on any number of threads.
class BodyContact final : public dynamics::Potential {
public:
    /// Nodes and tetrahedra are of one numbering, that of `rest`. Nodes that are the body's
    /// own are left out. No node is watched before update_pairs. Throws InputError when the
    /// options break a rule or a node is not there, MeshError when a tetrahedron at rest is
    /// not positive.
    BodyContact(const ContactNodes& nodes, const std::vector<Vec3>& rest, ContactBody body,
                const BodyContactOptions& options);

    /// Watches the nodes that are near at x. Whether `cliques` changed: then a new
    /// Equilibrium must be made, since it makes its matrix once.
    bool update_pairs(const dynamics::NodeVectors& x);
    /// Nodes that are watched.
    [[nodiscard]] std::size_t pairs() const { return pair_.size(); }

    /// Infinite where a tetrahedron that is near a node is flat or inverted.
    [[nodiscard]] double move_to(const dynamics::NodeVectors& x) override;
    void add_forces(dynamics::NodeVectors& forces) const override;
    [[nodiscard]] dynamics::Cliques cliques() const override;
    void add_stiffness(dynamics::BlockMatrix& K) const override;
    [[nodiscard]] double largest_step(const dynamics::NodeVectors& x,
                                      const dynamics::NodeVectors& by) const override;

    /// Forgets what pressed at the last stiffness, which only saves iterations.
    void forget() { settled_.assign(settled_.size(), 0); }
    [[nodiscard]] ContactReport report() const { return report_of(touch_, options_.law.stiffness); }

private:
    // A node and the tetrahedron it is near to.
    struct Pair {
        std::size_t index = 0;            // of nodes_
        std::int32_t tet = 0;             // of body_
        std::array<std::int32_t, 5> who;  // the node, then the corners
        Mat3 rest = Mat3::Zero();         // edges at rest, inverted: rows are grad lambda_i
        double stretch = 1;               // s
    };
    // Derivatives where a pair touches.
    struct Slopes {
        std::array<double, 5> weight;  // 1, then -lambda_i: y = sum weight dx
        std::array<Vec3, 5> gradient;  // 0, then g_i
        Vec3 u;
        Mat3 curvature;  // F^-T H F^-1
    };
    [[nodiscard]] Vec3 place(const Pair& pair, const Mat3& inverse,
                             const dynamics::NodeVectors& x) const;
    [[nodiscard]] bool move_pair(std::size_t p, const dynamics::NodeVectors& x);

    ContactNodes nodes_;
    std::vector<Vec3> rest_;
    ContactBody body_;
    BodyContactOptions options_;
    std::vector<double> gap_;  // a node, what overlaps at rest forgiven
    std::vector<Pair> pair_;
    std::vector<ContactTouch> touch_;      // a pair
    std::vector<Slopes> slopes_;           // a pair
    mutable std::vector<double> settled_;  // press at the last stiffness, a node
};

}  // namespace myotet::contraction
