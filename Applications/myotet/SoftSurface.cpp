// SPDX-License-Identifier: Apache-2.0
#include "SoftSurface.h"

#include <algorithm>
#include <cmath>

#include "LevelSet/Extract.h"
#include "LevelSet/Soften.h"
#include "Surface/Faults.h"
#include "TrimSolid.h"

namespace myotet::app {
namespace {

using levelset::LevelSet;
using levelset::Spot;

constexpr int kTries = 8;                  // surfaces made at most
constexpr int kSoftenings = 12;            // before one of them
constexpr int kKeeping = 3;                // of these, that keep volume
constexpr int kSteps = 2;                  // of smoothing at a time
constexpr double kRadius = 3, kApart = 1;  // of spots, in samples

std::vector<Spot> spots_about(const std::vector<Vec3>& places, double spacing) {
    std::vector<Spot> spots;
    for (const Vec3& p : places)
        if (std::ranges::none_of(
                spots, [&](const Spot& s) { return (s.centre - p).norm() < kApart * spacing; }))
            spots.push_back({p, kRadius * spacing});
    return spots;
}

surface::Guide guide_of(const Part& part, const LevelSet& phi) {
    return {.phi = field_of(phi), .trim = part.trim, .beside = part.beside};
}

/// A level set on its way, and what a surface of it can begin with.
struct Soft {
    LevelSet phi;
    TriMesh start;
    int places = 0;
};

/// Smooths about `places`, then about what keeps a surface from being held; volume
/// that would stay as shreds is let go after a few rounds. False where nothing is left.
bool soften(Soft& soft, const Part& part, std::vector<Vec3> places) {
    for (int i = 0; i < kSoftenings && !places.empty(); ++i) {
        const std::vector<Spot> spots = spots_about(places, soft.phi.spacing);
        levelset::soften(soft.phi, spots, {.steps = kSteps, .keeps_volume = i < kKeeping});
        soft.places += static_cast<int>(spots.size());
        soft.start = levelset::extract_surface(soft.phi);
        if (soft.start.triangles.empty()) return false;
        places = surface::start_faults(soft.start, guide_of(part, soft.phi), soft.phi.spacing);
    }
    return true;
}

double farthest(const TriMesh& mesh, const LevelSet& phi) {
    double most = 0;
    for (const Vec3& p : mesh.points) most = std::max(most, std::abs(phi.value(p)));
    return most;
}

}  // namespace

SoftSurface make_soft_surface(const Part& part, const surface::Options& options,
                              ProgressSink& progress) {
    SoftSurface best;
    const surface::Guide hard = guide_of(part, part.phi);
    best.made = surface::make_surface(part.start, hard, options, progress);
    best.parts_before = best.parts_after = surface::count_pieces(part.start);
    std::vector<Vec3> places = surface::faults(best.made.mesh, hard);
    std::size_t fewest = places.size();
    if (fewest == 0) return best;

    Soft soft{.phi = part.phi, .start = {}};
    for (int i = 1; i < kTries && !places.empty() && soften(soft, part, places); ++i) {
        progress.check();
        const surface::Guide guide = guide_of(part, soft.phi);
        surface::Result made = surface::make_surface(soft.start, guide, options, progress);
        places = surface::faults(made.mesh, guide);
        if (places.size() >= fewest) continue;
        fewest = places.size();
        best.made = std::move(made);
        best.softened = soft.phi;
        best.places = soft.places;
        best.moved = std::max(farthest(part.start, soft.phi), farthest(best.made.mesh, part.phi));
        best.parts_after = surface::count_pieces(soft.start);
    }
    return best;
}

}  // namespace myotet::app
