// SPDX-License-Identifier: Apache-2.0
#include "Contraction/ContactPairs.h"

#include <algorithm>

#include "ContactShapes.h"
#include "Core/Nearest.h"
#include "Core/Nearest.h"
#include "Core/Parallel.h"

namespace myotet::contraction {
namespace {

double distance(const std::vector<Vec3>& x, const Tet& t, const Vec3& p) {
    const auto lambda = barycentric({x[t[0]], x[t[1]], x[t[2]], x[t[3]]}, p);
    if (*std::min_element(lambda.begin(), lambda.end()) >= 0) return 0;
    double least = 1e9;
    for (int f = 0; f < 4; ++f) {
        const Triangle n = face_of(t, f);
        least =
            std::min(least, (p - nearest_on_triangle(p, x[n[0]], x[n[1]], x[n[2]]).point).norm());
    }
    return least;
}

struct Crowd {
    std::vector<Vec3> x;
    std::vector<std::int32_t> nodes;
    std::vector<Tet> tets;

    Crowd() {
        const TetMesh mesh = test::block(5, 1);
        x = mesh.points;
        test::add_scaled(1, test::random_vectors(x.size(), 0.15, 7), x);
        tets = mesh.tets;
        for (const Vec3& r : test::random_vectors(400, 5, 8)) {
            nodes.push_back(static_cast<std::int32_t>(x.size()));
            x.push_back(Vec3::Constant(2.5) + r);
        }
    }
};

TEST(ContactPairs, FindsTheNearestOfAllWithinReach) {
    const Crowd c;
    constexpr double reach = 1.5;
    const auto found = nearest_tets(c.x, c.nodes, c.tets, reach);
    int inside = 0, outside = 0, none = 0;
    for (std::size_t i = 0; i < c.nodes.size(); ++i) {
        const Vec3& p = c.x[c.nodes[i]];
        double least = 1e9;
        for (const Tet& t : c.tets) least = std::min(least, distance(c.x, t, p));
        if (found[i] < 0) {
            EXPECT_GT(least, reach);
            ++none;
            continue;
        }
        EXPECT_NEAR(distance(c.x, c.tets[found[i]], p), least, test::kRounding);
        ++(least > 0 ? outside : inside);
    }
    EXPECT_GT(std::min({inside, outside, none}), 40);
}

TEST(ContactPairs, ExtrapolatesAsLittleAsPossible) {
    // Over the edge between two tetrahedra that are equally near, nearer the second's side.
    const std::vector<Vec3> x = {{0, 0, 0},     {1, 0, 0},     {0, 1, 0}, {0, 0, -1},
                                 {1, 1, -0.01}, {0.6, 0.6, 1}, {0, 3, 0}};
    const std::vector<Tet> tets = {{0, 2, 1, 3}, {4, 1, 2, 3}};
    const auto found = nearest_tets(x, std::vector<std::int32_t>{5}, tets, 2);
    EXPECT_EQ(found[0], 1);
}

TEST(ContactPairs, SameOnOneThreadOrMany) {
    const Crowd c;
    const auto on = [&](int threads) {
        const ThreadLimit limit(threads);
        return nearest_tets(c.x, c.nodes, c.tets, 1.5);
    };
    EXPECT_EQ(on(1), on(3));
}

TEST(ContactPairs, NothingNearIsNoPair) {
    Crowd c;
    for (const std::int32_t n : c.nodes) c.x[n].x() += 100;
    for (const std::int32_t t : nearest_tets(c.x, c.nodes, c.tets, 1.5)) EXPECT_EQ(t, -1);
    EXPECT_TRUE(nearest_tets(c.x, {}, c.tets, 1.5).empty());
}

}  // namespace
}  // namespace myotet::contraction
