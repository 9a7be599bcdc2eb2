// SPDX-License-Identifier: Apache-2.0
#include "Membrane/SelfContact.h"

#include <gtest/gtest.h>

#include <random>

#include "Membrane/Simulate.h"
#include "Support/MembraneShapes.h"

using namespace myotet;
using namespace myotet::membrane;

namespace {

// A ball of radius 50 mm pressed flat to a tenth.
struct Flat {
    Levels levels = make_levels(ico_sphere(50, 2), 0);
    Wall wall;
    Active active = make_active(levels, wholly_refined(levels, 0), level_properties(levels, wall));
    std::vector<Vec3> x = levels.rest;
    Flat() {
        wall.contact_stiffness = 0.01;
        for (Vec3& p : x) p.z() *= 0.05;
    }
    double energy(const FacingWalls& facing) const {
        std::vector<Vec3> ignored(x.size(), Vec3::Zero());
        return add_self_contact(facing, wall, active, x, ignored);
    }
};

}  // namespace

TEST(SelfContact, WallsFarApartDoNotFace) {
    Flat c;
    EXPECT_TRUE(find_facing(c.levels, c.wall, c.active, c.levels.rest, 5).nodes.empty());
    EXPECT_FALSE(find_facing(c.levels, c.wall, c.active, c.x, 5).nodes.empty());
    EXPECT_GT(least_clearance(c.levels), 5);
    EXPECT_LT(least_clearance(c.levels), 100);
}

TEST(SelfContact, ForceIsMinusTheGradientAndTheSumsVanish) {
    Flat c;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> part(-0.3, 0.3);
    for (Vec3& p : c.x) p += Vec3(part(random), part(random), part(random));
    const FacingWalls facing = find_facing(c.levels, c.wall, c.active, c.x, 5);
    std::vector<Vec3> force(c.x.size(), Vec3::Zero());
    ASSERT_GT(add_self_contact(facing, c.wall, c.active, c.x, force), 0);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    double largest = 0;
    for (std::size_t i = 0; i < c.x.size(); ++i) {
        sum += force[i];
        moment += c.x[i].cross(force[i]);
        largest = std::max(largest, force[i].norm());
    }
    EXPECT_LT(sum.norm(), 1e-12 * largest * 100);
    EXPECT_LT(moment.norm(), 1e-12 * largest * 5000);
    constexpr double kStep = 1e-6;  // mm; short, as the nearest triangle changes at kinks
    int off = 0;
    for (std::size_t i = 0; i < c.x.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            double side[2];
            for (int s = 0; s < 2; ++s) {
                c.x[i][axis] += s == 0 ? -kStep : 2 * kStep;
                side[s] = c.energy(facing);
            }
            c.x[i][axis] -= kStep;
            if (std::abs(force[i][axis] + (side[1] - side[0]) / (2 * kStep)) > 1e-4 * largest)
                ++off;
        }
    EXPECT_EQ(off, 0);
}

// Two plates press a ball of weak wall flat: its walls come to lie on each other.
TEST(SelfContact, PressedWallsStayApart) {
    Loads loads;
    Options options;
    options.duration = 0.5;
    options.levels = 0;
    options.wall.young = 0.01;
    for (const double side : {1.0, -1.0}) {
        Tool plate;
        plate.shape = Tool::Shape::plane;
        plate.normal = Vec3(0, 0, -side);
        plate.stiffness = 0.02;
        plate.places = {{0, Vec3(0, 0, 21 * side)}, {0.4, Vec3(0, 0, 1 * side)}};
        loads.tools.push_back(plate);
    }
    SilentProgress quiet;
    const auto least = [&](double stiffness) {
        options.wall.contact_stiffness = stiffness;
        const Result r = simulate(ico_sphere(20, 2), options, loads, quiet);
        EXPECT_EQ(r.status, Status::finished) << r.message;
        double up = 1e9, down = -1e9;  // over the middle
        const auto& points = r.final_surface.points;
        const TriMesh rest = ico_sphere(20, 2);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (rest.points[i].head<2>().norm() > 8) continue;
            if (rest.points[i].z() > 0)
                up = std::min(up, points[i].z());
            else
                down = std::max(down, points[i].z());
        }
        return up - down;
    };
    const double kept = least(0.05), through = least(0);
    EXPECT_GT(kept, through + 1);
    EXPECT_GT(kept, 3);  // of 6 mm that two walls need
}
