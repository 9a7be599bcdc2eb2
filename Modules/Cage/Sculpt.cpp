// SPDX-License-Identifier: Apache-2.0
#include "Cage/Sculpt.h"

#include <algorithm>
#include <limits>

#include "Core/Parallel.h"
#include "Lattice/RedGreenLattice.h"

namespace myotet::cage {
namespace {

constexpr std::size_t kGrain = 256;

// Tetrahedra that meet the box reach a cell beyond it, and snowflakes around their nodes one more.
constexpr double kPad = 2;

Corners4 corners(const Sculpture& s, const Tet& t) {
    return {s.points[t[0]], s.points[t[1]], s.points[t[2]], s.points[t[3]]};
}

Sculpture cover(const SurfaceTree& surface, double cell, const Placement& placement) {
    // The surface's box in the lattice's axes: that of its box's corners.
    Box box;
    for (int c = 0; c < 8; ++c) {
        const Box& b = surface.box();
        const Vec3 corner(c & 1 ? b.max[0] : b.min[0], c & 2 ? b.max[1] : b.min[1],
                          c & 4 ? b.max[2] : b.min[2]);
        box.include(placement.rotation.transpose() * corner);
    }
    // The lattice is laid about the box's centre, so a larger box on one side shifts it.
    box.min.array() -= kPad * cell;
    box.max += cell * (Vec3::Constant(kPad) + 2 * placement.shift);
    const lattice::RedGreenLattice lattice(box, cell, 0, std::numeric_limits<double>::max(),
                                           [](const Vec3&) { return 0.0; });
    Sculpture s;
    s.tets = lattice.tets(0);
    s.points.resize(lattice.node_count());
    for (std::size_t n = 0; n < s.points.size(); ++n)
        s.points[n] = placement.rotation * lattice.position(static_cast<std::int32_t>(n));
    s.neighbours = face_neighbours(s.tets);
    return s;
}

// Marks all that hangs together with `seed` by faces without meeting the surface; says
// whether it reaches the lattice's rim.
bool flood(const Sculpture& s, std::int32_t seed, std::vector<std::uint8_t>& seen,
           std::vector<std::int32_t>& part) {
    part.assign(1, seed);
    seen[seed] = 1;
    bool rim = false;
    for (std::size_t i = 0; i < part.size(); ++i)
        for (const std::int32_t n : s.neighbours[part[i]]) {
            rim |= n < 0;
            if (n < 0 || seen[n]) continue;
            seen[n] = 1;
            part.push_back(n);
        }
    return rim;
}

}  // namespace

std::size_t Sculpture::count() const {
    return static_cast<std::size_t>(std::ranges::count(kept, 1));
}

Sculpture sculpt(const SurfaceTree& surface, double cell, const Placement& placement) {
    Sculpture s = cover(surface, cell, placement);
    s.kept.resize(s.tets.size());
    parallel_for(0, s.tets.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) s.kept[t] = surface.meets(corners(s, s.tets[t]));
    });
    std::vector<std::uint8_t> seen = s.kept;
    std::vector<std::int32_t> part;
    for (std::size_t t = 0; t < s.tets.size(); ++t) {
        if (seen[t]) continue;
        const bool rim = flood(s, static_cast<std::int32_t>(t), seen, part);
        if (rim || surface.winding(s.points[s.tets[t][0]]) == 0) continue;
        for (const std::int32_t inside : part) s.kept[inside] = 1;
    }
    return s;
}

}  // namespace myotet::cage
