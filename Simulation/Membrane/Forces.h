// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Membrane/Loads.h"
#include "Membrane/SelfContact.h"

namespace myotet::membrane {

/// Motion of all vertices of the finest level; those not in use are stale.
struct Motion {
    double time = 0;         ///< s
    std::vector<Vec3> x, v;  ///< mm, mm/s
};

/// What forces need to know of an organ.
struct Body {
    const Levels& levels;
    const Wall& wall;
    const Loads& loads;
    const Active& active;
    /// Of a closed surface at rest, mm^3: of the finest level, and as drawn.
    double rest_volume = 0, drawn_rest_volume = 0;
    /// A patch each: nodes and their shares of its force.
    std::vector<std::vector<std::pair<std::int32_t, double>>> patches = {};
    FacingWalls facing = {};  ///< what of the wall may meet itself
};

/// Finds the volumes and the patches' shares; whenever the nodes in use change.
void prepare(Body& body);

/// Volume of the finest surface at rest and what the drawn triangles have gained
/// since, mm^3: a change of levels alone changes nothing. 0 for an open surface.
[[nodiscard]] double cavity_volume(const Body& body, std::span<const Vec3> x);

/// MPa; from the volume where the filling is sealed.
[[nodiscard]] double cavity_pressure(const Body& body, double volume);

/// Places and velocities of hanging nodes from their ends'.
void follow(const Active& active, Motion& motion);

/// Forces on all vertices, |V| of the finest level, N.
struct NodeForces {
    std::vector<Vec3> total;     ///< those of hanging nodes given to their ends
    std::vector<Vec3> external;  ///< of all loads
    std::vector<Vec3> pressing;  ///< of patches and tools
};

/// Springs [Choi05, eq. 2], shape-preserving springs [Choi05, eq. 10], drag, the wall
/// against itself and loads. A shape-preserving spring's constant is the wall's per area times the
/// node's share of the area, its mass over thickness and density.
/// Returns what the springs of both kinds and that contact hold, N mm.
/// Cost: O(nodes and springs in use).
double find_forces(const Body& body, const Motion& motion, NodeForces& forces);

/// Of the nodes in use, N mm.
[[nodiscard]] double kinetic_energy(const Body& body, const Motion& motion);

/// Largest step (s) at which fourth-order Runge-Kutta is stable: its region holds
/// the half disc |z| <= 2.5 left of zero. With n the directions of a node's springs
/// at rest, k (n . (u - w))^2 <= 2 k ((n . u)^2 + (n . w)^2), so no frequency is above
/// the largest of sqrt(|sum 2 k n n^T| / m), and no rate of damping above that of
/// |sum 2 c n n^T| / m; other loads' stiffness comes in by area.
[[nodiscard]] double stable_step(const Body& body);

}  // namespace myotet::membrane
