// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "Core/Errors.h"
#include "LevelSet/Csg.h"
#include "LevelSet/CsgMeasure.h"
#include "LevelSet/CsgPieces.h"
#include "LevelSet/Measure.h"
#include "LevelSet/Primitives.h"
#include "Repair/Apply.h"
#include "Support/TemporaryFolder.h"

namespace myotet::test {

using levelset::Band;
using repair::Scene;

inline constexpr double kSpacing = 1;  // mm
// A sharp edge is rounded inside its cells: what that cuts off across it, mm^2.
inline constexpr double kEdge = 0.5;

inline double ball_volume(double radius) {
    return 4.0 / 3 * std::numbers::pi * radius * radius * radius;
}
/// How far the volume of a sampled ball may be off: chords between samples cut
/// spacing^2 / (2 radius^2) of it; the rest is for redistancing.
inline double ball_tolerance(double radius) {
    return 0.7 / (radius * radius) * ball_volume(radius);
}

inline Band solid(const levelset::Distance& distance, const Box& box) {
    return levelset::sample_solid(distance, box, {Vec3::Zero(), kSpacing});
}

inline Box box_around(const Vec3& centre, double half) {
    Box box;
    box.include(centre - Vec3::Constant(half));
    box.include(centre + Vec3::Constant(half));
    return box;
}

inline Band ball(const Vec3& centre, double radius) {
    return solid([=](const Vec3& p) { return levelset::sphere_distance(p, centre, radius); },
                 box_around(centre, radius));
}

inline Band bar(const Vec3& centre, const Vec3& half) {
    return solid([=](const Vec3& p) { return levelset::box_distance(p - centre, half); },
                 box_around(centre, half.maxCoeff()));
}

/// A scene of one region a tissue, labels from 1, in lattice coordinates that
/// `frame` takes to the patient's.
inline Scene make_scene(const std::vector<std::pair<std::string, Band>>& tissues,
                        const Frame& frame = {}) {
    Scene scene;
    scene.frame = frame;
    scene.spacing = kSpacing;
    for (const auto& [name, band] : tissues) {
        repair::Tissue tissue;
        tissue.label = static_cast<std::int32_t>(scene.tissues.size()) + 1;
        tissue.name = name;
        levelset::Region region;
        region.label = tissue.label;
        region.phi = levelset::assemble(levelset::settle(band));
        region.voxels = 1000;
        region.volume_level_set = levelset::enclosed_volume(region.phi);
        region.volume_labels = 1000 * kSpacing * kSpacing * kSpacing;
        tissue.regions.push_back(std::move(region));
        scene.tissues.push_back(std::move(tissue));
    }
    return scene;
}

/// All of a tissue in one band; empty name: refused.
inline Band band_of(const Scene& scene, const std::string& name) {
    for (const repair::Tissue& tissue : scene.tissues) {
        if (tissue.name != name) continue;
        std::vector<Band> parts;
        for (const levelset::Region& region : tissue.regions)
            parts.push_back(levelset::to_band(region.phi));
        std::vector<const Band*> all;
        for (const Band& part : parts) all.push_back(&part);
        const std::size_t count = all.size();
        return levelset::merge(std::move(all), levelset::Extent::all,
                               [count](const float* v) { return *std::min_element(v, v + count); });
    }
    throw LogicError("no tissue " + name);
}

inline double volume_of(const Scene& scene, const std::string& name) {
    return levelset::enclosed_volume(band_of(scene, name));
}

inline const repair::Tissue& tissue_of(const Scene& scene, const std::string& name) {
    for (const repair::Tissue& tissue : scene.tissues)
        if (tissue.name == name) return tissue;
    throw LogicError("no tissue " + name);
}

/// Writes steps below "steps:" into a file and reads the recipe.
inline repair::Recipe recipe_of(const std::string& steps) {
    const testing::TemporaryFolder folder;
    testing::write_bytes(folder / "recipe.yaml", "myotet_recipe: 1\nsteps:\n" + steps);
    return repair::read_recipe(folder / "recipe.yaml");
}

inline repair::Summary repaired(Scene& scene, const std::string& steps) {
    SilentProgress progress;
    return repair::apply(recipe_of(steps), scene, progress);
}

/// The sentence with which the steps are refused, or "".
inline std::string refusal(Scene scene, const std::string& steps) {
    try {
        repaired(scene, steps);
    } catch (const InputError& e) {
        return e.what();
    }
    return {};
}

}  // namespace myotet::test
