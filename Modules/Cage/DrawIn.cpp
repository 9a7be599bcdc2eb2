// SPDX-License-Identifier: Apache-2.0
#include "Cage/DrawIn.h"

#include <algorithm>

namespace myotet::cage {
namespace {

constexpr int kEras = 3, kRounds = 60;
constexpr double kFirstWeight = 40, kGrowth = 4;
constexpr double kAbove = 0.5;  // degrees: shapes hold back this much before the floor

}  // namespace

int draw_in(Walls& walls, RelaxOptions options, const std::function<bool()>& interrupted) {
    int rounds = 0;
    options.close = kFirstWeight;
    options.above = kAbove;
    options.goal = std::min(options.goal, Relaxation(walls, options).worst());
    options.floor = options.goal;
    for (int era = 0; era < kEras; ++era) {
        // Steps start anew: what was at rest may move by the new weight.
        Relaxation relaxation(walls, options);
        for (int r = 0; r < kRounds && !interrupted(); ++r, ++rounds) relaxation.round();
        options.close *= kGrowth;
    }
    return rounds;
}

}  // namespace myotet::cage
