// SPDX-License-Identifier: Apache-2.0
#include "Cage/Reach.h"

#include <algorithm>

#include "Cage/Bisect.h"
#include "Cage/Collapse.h"

namespace myotet::cage {
namespace {

constexpr int kEras = 16, kFirstRounds = 20, kRounds = 8;
// Eras after which nodes are taken out, and edges bisected.
constexpr int kCollapseFrom = 1, kBisectFrom = 3;
constexpr double kLeast = 3;  // degrees of score_deg that a collapse must leave
// Bisected are edges at no more nodes than this part of all, and no more often in all than
// this part of the tetrahedra: where more is amiss the lattice is too coarse for the offset.
constexpr double kFew = 0.1, kBisected = 0.1;

// Nodes by their places, since numbers change as the mesh does.
std::vector<Vec3> places(const Body& body, const std::vector<std::int32_t>& nodes) {
    std::vector<Vec3> at;
    for (const std::int32_t n : nodes) at.push_back(body.points[n]);
    return at;
}

std::int32_t node_at(const Body& body, const Vec3& p) {
    const auto at = std::ranges::find(body.points, p);
    return at == body.points.end() ? -1 : static_cast<std::int32_t>(at - body.points.begin());
}

// Changes the mesh around nodes that stay beyond.
void change(Walls& walls, const std::vector<Vec3>& stuck, int era, const RelaxOptions& options,
            ReachSummary& summary) {
    const double most = kBisected * static_cast<double>(walls.body().tets.size());
    for (const Vec3& p : stuck) {
        const std::int32_t node = node_at(walls.body(), p);
        if (node < 0) continue;
        if (era >= kCollapseFrom && collapse(walls, node, options.offset, kLeast))
            ++summary.collapsed;
        else if (era >= kBisectFrom && summary.refined < most)
            summary.refined += bisect_around(walls, node);
    }
}

}  // namespace

ReachSummary reach(Walls& walls, const RelaxOptions& options,
                   const std::function<bool()>& interrupted) {
    ReachSummary summary;
    for (int era = 0; era < kEras; ++era) {
        RelaxOptions now = options;
        now.seed = options.seed + static_cast<std::uint64_t>(era);
        Relaxation relaxation(walls, now);
        const int rounds = era == 0 ? kFirstRounds : kRounds;
        for (int r = 0; r < rounds && !relaxation.all_within(); ++r) {
            if (interrupted()) return summary;
            relaxation.round();
            ++summary.rounds;
            if (r % 5 != 4) continue;
            for (const std::int32_t n : relaxation.beyond()) summary.jumps += relaxation.jump(n);
        }
        summary.reached = relaxation.all_within();
        if (summary.reached) return summary;
        const std::vector<Vec3> stuck = places(walls.body(), relaxation.beyond());
        const double few = kFew * static_cast<double>(walls.body().points.size());
        if (era >= kBisectFrom && static_cast<double>(stuck.size()) > few) break;
        change(walls, stuck, era, options, summary);
    }
    return summary;
}

}  // namespace myotet::cage
