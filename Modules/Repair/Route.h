// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Core/Progress.h"
#include "LevelSet/Band.h"

namespace myotet::repair {

/// A way to be found from one solid to another through what lies between.
struct RouteTask {
    const levelset::Band& from;
    const levelset::Band& to;
    std::vector<const levelset::Band*> walls;      ///< not to be passed
    std::vector<const levelset::Band*> passables;  ///< at three times the cost
    double within = 0;                             ///< how far to look, mm
    double clearance = 0;  ///< nearer to a wall than this costs more, mm; up to the bands' width
    std::optional<Vec3> begin, end;  ///< leave and arrive near these, lattice coordinates
};

struct Route {
    std::vector<Vec3> points;     ///< lattice coordinates, from sample to sample; empty: none found
    double length = 0;            ///< mm
    std::vector<int> blocked_by;  ///< without a route: the walls that the nearest way meets
};

/// Dijkstra's shortest path over the samples and their 26 neighbours, where a
/// step of length l costs l (1 + 4 (1 - d / clearance)^2) at distance d < clearance
/// from a wall. Cost: O(n log n) in the samples of the box around both.
/// Throws ResourceError when that box is too large, Interrupted.
[[nodiscard]] Route find_route(const RouteTask& task, const ProgressSink& progress);

/// Distance between the surfaces of two solids, mm, good to a few percent; 0
/// where they touch.
[[nodiscard]] double gap_between(const levelset::Band& a, const levelset::Band& b);

}  // namespace myotet::repair
