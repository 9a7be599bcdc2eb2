// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/FromSurface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "Core/Errors.h"
#include "LevelSet/Band.h"
#include "LevelSet/Flow.h"
#include "LevelSet/HealBand.h"
#include "LevelSet/Redistance.h"
#include "LevelSet/SurfaceBand.h"
#include "LevelSet/WindingTree.h"

namespace myotet::levelset {
namespace {

// Half width of the band, in samples.
constexpr double kHalfWidth = 4;
// What the conversion of the triangles fills, in samples: both ends of every
// edge that the surface cuts.
constexpr double kExactWidth = 1.25;
// Displacement by smoothing is given back on the scale of this many times it.
constexpr double kGiveBack = 3;

struct EdgeUse {
    std::int32_t low, high;
    int direction;  // +1 when walked from low to high
};

std::string text(const Vec3& p) {
    std::ostringstream out;
    out.precision(6);
    out << "(" << p.x() << ", " << p.y() << ", " << p.z() << ")";
    return out.str();
}

// Edges that are not walked as often one way as the other, and where one lies.
struct OpenEdges {
    std::size_t count = 0;
    Vec3 place = Vec3::Zero();
};

// A surface is closed when it has none. An inside-out or crossing surface is
// closed; a hole or a flipped triangle opens it.
OpenEdges find_open_edges(const TriMesh& surface) {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * surface.triangles.size());
    for (const Triangle& t : surface.triangles)
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = t[i], b = t[(i + 1) % 3];
            if (a != b) uses.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
        }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return a.low != b.low ? a.low < b.low : a.high < b.high;
    });
    OpenEdges open;
    for (std::size_t i = 0; i < uses.size();) {
        int balance = 0;
        std::size_t end = i;
        for (; end < uses.size() && uses[end].low == uses[i].low && uses[end].high == uses[i].high;
             ++end)
            balance += uses[end].direction;
        if (balance != 0 && open.count++ == 0)
            open.place = 0.5 * (surface.points[uses[i].low] + surface.points[uses[i].high]);
        i = end;
    }
    return open;
}

[[noreturn]] void refuse_open(const OpenEdges& open) {
    throw InputError("the surface is not closed: " + std::to_string(open.count) +
                     " edges are not walked once each way by two triangles, one of them at " +
                     text(open.place) +
                     "; let --heal guess what it encloses, or close its holes, merge its double "
                     "points and orient its triangles alike");
}

void warn_of_crossings(const HealSummary& summary, ProgressSink& progress) {
    if (summary.crossing_pairs == 0) return;
    progress.warn("the surface crosses itself: " + std::to_string(summary.crossing_pairs) +
                  (summary.crossing_pairs == 1 ? " pair" : " pairs") +
                  " of triangles; what cannot be reached from outside is taken as inside");
}

// A closed surface by its triangles alone, an open one by its winding number.
Band exact_band(const TriMesh& surface, const SurfaceOptions& options, HealSummary& summary,
                ProgressSink& progress) {
    const OpenEdges open = find_open_edges(surface);
    if (open.count > 0 && !options.heal) refuse_open(open);
    summary.crossing_pairs = count_crossing_pairs(build_winding_tree(surface));
    if (open.count == 0) {
        warn_of_crossings(summary, progress);
        return surface_band(surface, options.spacing, kExactWidth, progress);
    }
    return healed_band(orient_surface(surface, summary), options.spacing, kExactWidth, summary,
                       progress);
}

void require_valid(const TriMesh& surface) {
    if (surface.triangles.empty())
        throw InputError("the surface has no triangles; a closed surface is needed");
    const auto count = static_cast<std::int32_t>(surface.points.size());
    for (const Triangle& t : surface.triangles)
        for (const std::int32_t v : t) {
            if (v < 0 || v >= count)
                throw InputError("a triangle of the surface names point " + std::to_string(v) +
                                 " of " + std::to_string(count) + "; the file is damaged");
            if (!surface.points[v].allFinite())
                throw InputError("point " + std::to_string(v) +
                                 " of the surface is not a finite position; repair the file");
        }
}

// Bricks follow the area, the coarse field the box.
void require_memory(const TriMesh& surface, const SurfaceOptions& options) {
    double area = 0;
    Box box;
    for (const Triangle& t : surface.triangles) {
        const Vec3 &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
        area += 0.5 * (b - a).cross(c - a).norm();
        for (const Vec3* p : {&a, &b, &c}) box.include(*p);
    }
    // Measured on spheres and on a dragon: 3 to 4 bricks for a brick's face of
    // surface, 9 kB at the peak for each; 25 bytes for a coarse sample.
    constexpr double kBricksPerFace = 4, kBytesPerBrick = 9000, kBytesPerCoarse = 25;
    const double side = LevelSet::kBrickCells * options.spacing;
    const double coarse = 4 * options.spacing;
    const double bytes = kBricksPerFace * kBytesPerBrick * (area / (side * side) + 8) +
                         kBytesPerCoarse * ((box.extent().array() / coarse) + 10).prod();
    if (!(bytes <= options.max_memory)) {
        std::ostringstream out;
        out.precision(3);
        out << "a level set with samples " << options.spacing << " mm apart would need about "
            << bytes / 1e9 << " GB where " << options.max_memory / 1e9
            << " GB are allowed; ask for a longer edge length or a wider spacing";
        throw ResourceError(out.str());
    }
}

}  // namespace

void SurfaceOptions::validate() const {
    const auto require = [](bool good, const char* field, double value, const char* rule) {
        if (good) return;
        std::ostringstream out;
        out << field << " is " << value << " but must be " << rule;
        throw InputError(out.str());
    };
    require(spacing > 0 && std::isfinite(spacing), "spacing", spacing, "a positive length in mm");
    require(smooth >= 0 && std::isfinite(smooth), "smooth", smooth, "zero or a length in mm");
    require(max_memory > 0, "max_memory", max_memory, "a positive number of bytes");
}

LevelSet from_surface(const TriMesh& surface, const SurfaceOptions& options, ProgressSink& progress,
                      HealSummary* summary) {
    options.validate();
    require_valid(surface);
    require_memory(surface, options);
    progress.report("distances", 0);
    // OpenVDB's values are exact next to the surface and drift by up to a
    // quarter of the spacing two samples away; ours hold to the band's edge.
    HealSummary found;
    Band band = exact_band(surface, options, found, progress);
    if (summary) *summary = found;
    band = refit(band, static_cast<float>(kHalfWidth * options.spacing));
    redistance(band, Seeds::keep_ends, 2);
    if (options.smooth > 0) {
        progress.report("smoothing", 0);
        std::vector<std::int8_t> none;
        const FlowOptions flow{.time = flow_time(options.smooth),
                               .give_back_radius = kGiveBack * options.smooth,
                               .wanders = true};
        flow_by_mean_curvature(band, {none, 0}, flow, progress);
        band = refit(band, static_cast<float>(kHalfWidth * options.spacing));
        redistance(band, Seeds::keep_cells, 2);
    }
    progress.report("level sets", 0);
    LevelSet phi = assemble(band);
    progress.report("level sets", 1);
    return phi;
}

}  // namespace myotet::levelset
