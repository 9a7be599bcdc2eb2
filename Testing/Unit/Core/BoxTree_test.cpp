// SPDX-License-Identifier: Apache-2.0
#include "Core/BoxTree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "Core/Errors.h"

namespace myotet {
namespace {

struct Things {
    std::vector<Box> boxes;
    std::vector<Vec3> centres;

    explicit Things(std::size_t count) {
        std::mt19937 random(3);
        std::uniform_real_distribution<double> part(-1, 1);
        for (std::size_t i = 0; i < count; ++i) {
            Box box;
            const Vec3 at(part(random), part(random), part(random));
            box.include(at);
            box.include(at + 0.1 * Vec3(part(random), part(random), part(random)));
            boxes.push_back(box);
            centres.push_back(box.centre());
        }
    }
    [[nodiscard]] BoxTree tree() const { return {boxes, centres}; }
};

bool overlap(const Box& a, const Box& b) {
    return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

TEST(BoxTree, HoldsEachThingOnce) {
    for (const std::size_t count : {1u, 4u, 5u, 1000u}) {
        std::vector<std::int32_t> order = Things(count).tree().order();
        std::ranges::sort(order);
        ASSERT_EQ(order.size(), count);
        for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(order[i], static_cast<int>(i));
    }
    EXPECT_THROW(BoxTree({}, {}), LogicError);
}

TEST(BoxTree, FindsWhatASearchThroughAllFinds) {
    const Things things(1000);
    const BoxTree tree = things.tree();
    for (std::size_t q = 0; q < 50; ++q) {
        Box query = things.boxes[q];
        query.max += Vec3::Constant(0.2);
        std::vector<std::int32_t> found, expected;
        tree.walk([&](const Box& box) { return !overlap(box, query); },
                  [&](std::int32_t i) {
                      const std::int32_t t = tree.order()[i];
                      if (overlap(things.boxes[t], query)) found.push_back(t);
                      return false;
                  });
        for (std::size_t t = 0; t < things.boxes.size(); ++t)
            if (overlap(things.boxes[t], query)) expected.push_back(static_cast<std::int32_t>(t));
        std::ranges::sort(found);
        EXPECT_EQ(found, expected);
        EXPECT_GT(found.size(), 0u);
    }
}

TEST(BoxTree, StopsWhereItIsTold) {
    const BoxTree tree = Things(1000).tree();
    int visited = 0;
    tree.walk([](const Box&) { return false; }, [&](std::int32_t) { return ++visited == 7; });
    EXPECT_EQ(visited, 7);
}

TEST(BoxTree, TheNearestAlsoAfterThingsMoved) {
    Things things(1000);
    BoxTree tree = things.tree();
    for (int round = 0; round < 2; ++round) {
        for (int q = 0; q < 50; ++q) {
            const Vec3 p = 1.5 * things.centres[static_cast<std::size_t>(q)];
            double squared = 1e9, expected = 1e9;
            int visited = 0;
            tree.near(p, squared, [&](std::int32_t i) {
                squared = std::min(squared, squared_distance(things.boxes[tree.order()[i]], p));
                ++visited;
            });
            for (const Box& box : things.boxes)
                expected = std::min(expected, squared_distance(box, p));
            EXPECT_EQ(squared, expected);
            EXPECT_LT(visited, 500);  // half of what a search through all looks at
        }
        for (Box& box : things.boxes) {
            box.min.x() *= 2;
            box.max.x() = 2 * box.max.x() + 1;
        }
        tree.follow([&](std::int32_t i, Box& box) {
            box.include(things.boxes[tree.order()[i]].min);
            box.include(things.boxes[tree.order()[i]].max);
        });
    }
}

}  // namespace
}  // namespace myotet
