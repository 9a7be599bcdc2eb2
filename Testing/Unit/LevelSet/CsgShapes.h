// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "LevelSet/Csg.h"
#include "LevelSet/Primitives.h"

namespace myotet::test {

inline const levelset::CsgLattice kLattice{{-0.3, 0.2, 0.1}, 1.0};

inline levelset::Band ball(const Vec3& centre, double radius,
                           const levelset::CsgLattice& lattice = kLattice) {
    Box box;
    box.include(centre - Vec3::Constant(radius));
    box.include(centre + Vec3::Constant(radius));
    return levelset::sample_solid(
        [=](const Vec3& p) { return levelset::sphere_distance(p, centre, radius); }, box, lattice);
}

inline levelset::Band block(const Vec3& centre, const Vec3& half,
                            const levelset::CsgLattice& lattice = kLattice) {
    Box box;
    box.include(centre - half);
    box.include(centre + half);
    return levelset::sample_solid(
        [=](const Vec3& p) { return levelset::box_distance(p - centre, half); }, box, lattice);
}

inline double ball_volume(double radius) {
    return 4.0 / 3 * std::numbers::pi * radius * radius * radius;
}

/// How far the volume of a sampled ball may be off: chords between samples cut
/// spacing^2 / (2 radius^2) of it; the rest is for redistancing.
inline double ball_tolerance(double radius) {
    return 0.7 / (radius * radius) * ball_volume(radius);
}

}  // namespace myotet::test
