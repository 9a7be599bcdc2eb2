// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Cage/Body.h"
#include "Cage/Parts.h"

namespace myotet::cage {

/// Keeps a cage around its surface while its nodes move one at a time. A boundary node's move
/// sweeps the room between the faces around it before and after. The surface does not meet
/// those before; when it does not meet those after either, each connected part of it is within
/// that room as a whole or not at all, and only a part whose box fits into it needs a look.
class Walls {
public:
    /// Surface and body must live on; the body must enclose the surface, whose parts these are.
    Walls(const SurfaceTree& surface, std::vector<Part> parts, Body& body);

    /// Distance of a boundary node from the surface, mm, and where it is nearest.
    [[nodiscard]] const Nearest& nearest(std::int32_t node);

    /// Whether a boundary node at x is within `bound` of the surface.
    [[nodiscard]] bool within(std::int32_t node, const Vec3& x, double bound);

    /// Whether a node may move to x. `wall`, if not, is the outward normal of the face that
    /// would meet the surface or another face.
    [[nodiscard]] bool allows(std::int32_t node, const Vec3& x, Vec3& wall);

    /// Whether the tetrahedra and boundary faces around two nodes may become these.
    [[nodiscard]] bool allows(std::int32_t node, std::int32_t into,
                              const std::vector<Corners4>& tets,
                              const std::vector<Corners3>& faces) const;

    /// After the body's tetrahedra have changed.
    void start_anew();

    /// Moves a node, which must be allowed.
    void move(std::int32_t node, const Vec3& x);

    /// The surface's point nearest to any point.
    [[nodiscard]] Nearest nearest_to(const Vec3& p) const;

    /// Whether the surface meets none of these.
    [[nodiscard]] bool clear(const std::vector<Corners3>& faces) const;

    [[nodiscard]] Body& body() { return body_; }

private:
    [[nodiscard]] bool crosses_itself(std::int32_t node, const Vec3& x, std::int32_t& face) const;
    [[nodiscard]] bool loses_part(std::int32_t node, const Vec3& x) const;

    const SurfaceTree& surface_;
    std::vector<Part> parts_;
    Body& body_;
    std::vector<Nearest> nearest_;       // a node
    std::vector<std::uint8_t> known_;    // whether that is so
    std::vector<std::int32_t> blocker_;  // a face: the surface's triangle that stopped it last
    std::vector<Box> boxes_;             // a face
};

}  // namespace myotet::cage
