// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Offsets.h"

#include <algorithm>
#include <cmath>

namespace myotet::levelset {
namespace {

struct Neighbour {
    int region;
    double weight;  // half the wall's area
};

}  // namespace

std::vector<double> offsets_for(std::span<const double> missing,
                                std::span<const SharedWall> walls) {
    // A weighted graph's Laplacian, grounded at the background: symmetric
    // Gauss-Seidel, whose cost is nothing beside a measurement of volumes.
    constexpr int kMostSweeps = 400;
    constexpr double kStill = 1e-6;  // mm
    const int count = static_cast<int>(missing.size());
    std::vector<std::vector<Neighbour>> around(count);
    std::vector<double> total(count, 0.0), c(count, 0.0);
    for (const SharedWall& w : walls) {
        around[w.a].push_back({w.b, 0.5 * w.area});
        around[w.b].push_back({w.a, 0.5 * w.area});
        total[w.a] += 0.5 * w.area;
        total[w.b] += 0.5 * w.area;
    }
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
        double moved = 0;
        for (int step = 0; step < 2 * (count - 1); ++step) {
            const int r = step < count - 1 ? 1 + step : 2 * (count - 1) - step;
            if (!(total[r] > 0)) continue;
            double sum = -missing[r];
            for (const Neighbour& n : around[r]) sum += n.weight * c[n.region];
            const double next = sum / total[r];
            moved = std::max(moved, std::abs(next - c[r]));
            c[r] = next;
        }
        if (moved < kStill) break;
    }
    return c;
}

}  // namespace myotet::levelset
