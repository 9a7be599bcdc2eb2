// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "Cage/StarShape.h"
#include "Cage/Walls.h"

namespace myotet::cage {

struct RelaxOptions {
    double offset = 0;  ///< mm: boundary nodes are to be within it
    double cell = 0;    ///< mm: the scale of steps
    Scale scale;        ///< of score_deg (StarShape.h)
    double goal = 60;   ///< degrees of it that are enough
    double above = 1;   ///< degrees over the goal at which shapes begin to count
    double floor = 0;   ///< degrees below which no move takes a star, nor one below it lower
    double close = 0;   ///< weight of the cage's volume (in cubed cells) beside shapes
    std::uint64_t seed = 1;
};

/// Makes the worst shapes of a cage better, one node after another, within its walls.
///
/// A node goes down the slope of the badness of its tetrahedra (StarShape.h), taken against a
/// level little above the worst of the whole mesh, so that the worst count most and the others
/// hold back where they come near. Its step is as long as went well last time. A step into a
/// wall slides along it; when nothing helps, two random directions are tried, both ways.
/// Boundary nodes within the offset stay there. Others are drawn to the surface by a force
/// that grows from round to round, and the level stays low until all are there.
class Relaxation {
public:
    /// Walls must live on, and the body's tetrahedra stay.
    Relaxation(Walls& walls, const RelaxOptions& options);

    /// Each node once. Cost: about 10 us a node that is not at rest.
    void round();

    [[nodiscard]] double worst() const;                      ///< degrees of score_deg
    [[nodiscard]] bool all_within() const;                   ///< boundary nodes within the offset
    [[nodiscard]] std::vector<std::int32_t> beyond() const;  ///< those that are not

    /// Moves a boundary node that is beyond the offset to a place within it, near by but not
    /// on its way: the best of many drawn at random. Before that the nodes around it rise as
    /// far as the offset lets them, to make room. False when there is none.
    bool jump(std::int32_t node);

private:
    struct Star {
        std::vector<Corners4> tets;
        std::vector<int> corner;  // of the node
    };
    void gather(std::int32_t node);
    [[nodiscard]] double shape_energy(const Vec3& x);
    [[nodiscard]] double energy(std::int32_t node, const Vec3& x);
    [[nodiscard]] double star_score(const Vec3& x);
    [[nodiscard]] bool falls(std::int32_t node, const Vec3& x);
    [[nodiscard]] bool accept(std::int32_t node, const Vec3& x, double before, Vec3& wall);
    [[nodiscard]] bool descend(std::int32_t node, double before);
    void settle(std::int32_t node, const Vec3& x);
    void visit(std::int32_t node);
    void raise_ring(std::int32_t node);
    [[nodiscard]] double random_part();
    [[nodiscard]] Vec3 random_direction();

    Walls& walls_;
    Body& body_;
    RelaxOptions options_;
    std::mt19937_64 random_;
    std::vector<double> step_;          // a node, mm
    std::vector<double> shape_;         // a tetrahedron: its score
    std::vector<std::uint8_t> within_;  // a node; true of inner ones
    Star star_;                         // of the node that is visited
    Level level_;
    double pull_ = 20;
};

}  // namespace myotet::cage
