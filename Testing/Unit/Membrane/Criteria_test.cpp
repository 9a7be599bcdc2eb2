// SPDX-License-Identifier: Apache-2.0
#include "Membrane/Criteria.h"

#include <gtest/gtest.h>

#include "Membrane/Simulate.h"
#include "Support/MembraneShapes.h"

using namespace myotet;
using namespace myotet::membrane;

// What a tool comes near to is fine before it is touched; its far side is not.
TEST(Criteria, RefinesAheadOfATool) {
    Loads loads;
    Tool tool;
    tool.radius = 8;
    tool.places = {{0, Vec3(0, 0, 63)}, {0.1, Vec3(0, 0, 59)}};
    loads.tools = {tool};
    Options options;
    options.duration = 0.1;
    options.levels = 2;
    SilentProgress quiet;
    const auto run = [&] { return simulate(even_sphere(50, 114), options, loads, quiet).history; };
    const auto ahead = run();
    EXPECT_EQ(ahead.front().nodes, 114U);
    EXPECT_GT(ahead.back().nodes, 114U);
    EXPECT_LT(ahead.back().nodes, 300U);
    EXPECT_EQ(ahead.back().tools[0].nodes, 0U);
    options.criteria.reach = 0;
    EXPECT_EQ(run().back().nodes, 114U);
}
