// SPDX-License-Identifier: Apache-2.0
#include "PressOrgan.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <numeric>

#include "Core/Errors.h"
#include "Core/Text.h"
#include "ExitCodes.h"
#include "InputKind.h"
#include "LevelSet/Extract.h"
#include "LevelSet/FromSurface.h"
#include "Quality/Quality.h"
#include "Sizing.h"
#include "Surface/MakeSurface.h"
#include "TrimSolid.h"

namespace myotet::app {
namespace {

using levelset::LevelSet;
using levelset::Region;

// A cavity smaller than this part of what the organ encloses is a hole in the
// segmentation, no lumen.
constexpr double kLeastLumen = 0.05;
constexpr double kSampleOfEdge = 0.1;  // of a surface that is made anew, its samples apart

double area_of(const TriMesh& surface) { return quality::measure_surface(surface).area; }

/// The connected parts of a closed surface, in the order of their first triangles.
std::vector<TriMesh> parts_of(const TriMesh& surface) {
    std::vector<std::int32_t> root(surface.points.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](std::int32_t v) {
        while (root[v] != v) v = root[v] = root[root[v]];
        return v;
    };
    for (const auto& [a, b, c] : surface.triangles) {
        root[find(b)] = find(a);
        root[find(c)] = find(a);
    }
    std::vector<TriMesh> parts;
    std::vector<std::int32_t> part(surface.points.size(), -1), number(surface.points.size(), -1);
    for (const Triangle& t : surface.triangles) {
        auto& p = part[find(t[0])];
        if (p < 0) {
            p = static_cast<std::int32_t>(parts.size());
            parts.emplace_back();
        }
        TriMesh& mesh = parts[p];
        Triangle moved{};
        for (int i = 0; i < 3; ++i) {
            if (number[t[i]] < 0) {
                number[t[i]] = static_cast<std::int32_t>(mesh.points.size());
                mesh.points.push_back(surface.points[t[i]]);
            }
            moved[i] = number[t[i]];
        }
        mesh.triangles.push_back(moved);
    }
    return parts;
}

/// The outer surface of a region, and what it needs as level set.
struct Outside {
    TriMesh surface;  ///< local coordinates
    LevelSet filled;  ///< of it, where cavities had to be filled
    bool has_cavity = false;
};

Outside outside_of(const Region& region, double spacing, Organ& organ, ProgressSink& progress) {
    std::vector<TriMesh> parts = parts_of(levelset::extract_surface(region.phi));
    std::ranges::sort(parts, std::ranges::greater{},
                      [](const TriMesh& part) { return volume(part); });
    Outside out{.surface = parts.front(), .filled = {}, .has_cavity = parts.size() > 1};
    const double enclosed = volume(out.surface);
    double holes = 0;
    int hole_count = 0;
    for (std::size_t p = 1; p < parts.size(); ++p) {
        const double cavity = -volume(parts[p]);
        // The largest cavity is last: its signed volume is the lowest.
        if (p + 1 == parts.size() && cavity >= kLeastLumen * enclosed) {
            const double wall = region.volume_level_set;
            organ.lumen = {cavity, wall, wall / (0.5 * (area_of(out.surface) + area_of(parts[p])))};
            continue;
        }
        holes += cavity;
        ++hole_count;
    }
    if (hole_count > 0)
        organ.notes.push_back(std::to_string(hole_count) + " small cavities in " + organ.name +
                              " (" + rounded(holes) +
                              " mm^3 together) are taken for holes of the segmentation and filled");
    if (out.has_cavity)
        out.filled = levelset::from_surface(out.surface, {.spacing = spacing}, progress);
    return out;
}

// How often nodes are counted and the edges made longer or shorter, and when they are enough.
constexpr int kTries = 4;
constexpr double kNearEnough = 0.15;  // of the nodes asked for

std::string missed(int nodes, std::size_t came) {
    return "about " + std::to_string(nodes) + " nodes were asked for, but " + std::to_string(came) +
           " came of it";
}

bool far_from(int nodes, std::size_t came) {
    return !(std::abs(static_cast<double>(came) / nodes - 1) < 2 * kNearEnough);
}

/// Even triangles: sqrt(3)/2 L^2 of area a node.
double edge_for(double area, int nodes) { return std::sqrt(2 * area / (std::sqrt(3.0) * nodes)); }

void triangulate(const Outside& outside, const LevelSet& phi, const OrganOptions& options,
                 Organ& organ, ProgressSink& progress) {
    constexpr double kEven = 0.5;          // of the edge length, how short edges may get
    constexpr double kNoCurvature = 1000;  // refinement comes by levels, not by shape
    const int nodes = options.nodes > 0 ? options.nodes : kOrganNodes;
    organ.edge_length =
        options.edge_length > 0 ? options.edge_length : edge_for(area_of(outside.surface), nodes);
    surface::Result made;
    for (int attempt = 1;; ++attempt) {
        made = surface::make_surface(outside.surface, {.phi = field_of(phi), .trim = {}},
                                     {.edge_length = organ.edge_length,
                                      .smallest_edge_length = kEven * organ.edge_length,
                                      .curvature_factor = kNoCurvature},
                                     progress);
        // Bends make some edges shorter: then all are asked to be longer.
        const double excess = static_cast<double>(made.mesh.points.size()) / nodes;
        if (options.edge_length > 0 || std::abs(excess - 1) < kNearEnough || attempt == kTries)
            break;
        organ.edge_length *= std::sqrt(excess);
    }
    const auto broken = surface::broken_promises(made.quality);
    if (!broken.empty())
        throw InputError(options.scan.input.string() + ": the surface of " + organ.name +
                         " cannot be in triangles of " + rounded(organ.edge_length) + " mm (" +
                         broken.front() + "); give a shorter --edge-length or more --nodes");
    organ.surface = made.mesh;
    if (options.edge_length == 0 && far_from(nodes, made.mesh.points.size()))
        organ.notes.push_back(missed(nodes, made.mesh.points.size()) +
                              "; edges could not be made longer");
}

void hold_near(const OrganOptions& options, const TissueSets& sets, Organ& organ) {
    for (const std::string& wanted : options.hold_to) {
        const auto tissue = tissue_named(wanted, sets.tissues);
        MYOTET_CHECK(tissue, "a label to hold to has its level set");
        std::vector<const LevelSet*> phis;
        for (const Region& region : sets.sets.regions)
            if (belongs(region, *tissue)) phis.push_back(&region.phi);
        const surface::Field distance = field_of(phis);
        for (std::size_t v = 0; v < organ.surface.points.size(); ++v)
            if (distance(organ.surface.points[v]).value < options.hold_within)
                organ.near.push_back(static_cast<std::int32_t>(v));
    }
    std::ranges::sort(organ.near);
    organ.near.erase(std::unique(organ.near.begin(), organ.near.end()), organ.near.end());
}

/// Takes the one tissue that is asked for, and besides those that it is held to.
Tissue choose_tissue(const OrganOptions& options, Scan& scan) {
    const std::vector<Tissue> asked = asked_tissues(scan);
    if (asked.size() != 1) {
        std::vector<std::string> names;
        for (const Tissue& tissue : asked) names.push_back(tissue.name);
        throw UsageError("--label: " + options.scan.input.string() + " has " +
                         std::to_string(asked.size()) + " tissues (" + list_of(names) +
                         "); name the one that is pressed");
    }
    for (const std::string& name : options.hold_to) {
        const auto found = tissue_named(name, scan.tissues);
        if (!found)
            throw InputError(options.scan.input.string() + ": there is no label '" + name +
                             "' to hold the organ to; see myotet inspect");
        for (Tissue& tissue : scan.tissues)
            tissue.asked |= tissue.layer == found->layer && tissue.label == found->label;
    }
    return asked.front();
}

Organ organ_of_level_set(const OrganOptions& options, ProgressSink& progress) {
    Organ organ;
    organ.scan = read_scan(options.scan);
    tell(organ.scan, progress);
    const Tissue tissue = choose_tissue(options, organ.scan);
    organ.name = tissue.name;
    organ.label = tissue.label;
    LevelSetChoices choices = options.level_sets;
    if (organ.scan.surface && !(choices.spacing > 0)) {
        // On samples much finer than the triangles these do not become as large as asked.
        choices.spacing = std::max(kSampleOfEdge * options.edge_length,
                                   level_set_spacing(choose_sizes({}, organ.scan), organ.scan));
    }
    const TissueSets sets = make_level_sets(organ.scan, choices, progress);
    progress.check();
    std::vector<const Region*> regions;
    for (const Region& region : sets.sets.regions)
        if (belongs(region, tissue)) regions.push_back(&region);
    std::ranges::stable_sort(regions, std::ranges::greater{}, &Region::volume_level_set);
    MYOTET_CHECK(!regions.empty(), "a tissue that is asked for has a region");
    if (regions.size() > 1) {
        double left = 0;
        for (std::size_t r = 1; r < regions.size(); ++r) left += regions[r]->volume_level_set;
        organ.notes.push_back(organ.name + " has " + std::to_string(regions.size()) +
                              " parts; the largest is pressed, " + rounded(left) +
                              " mm^3 are left out");
    }
    const Outside outside = outside_of(*regions.front(), sets.sets.spacing, organ, progress);
    triangulate(outside, outside.has_cavity ? outside.filled : regions.front()->phi, options, organ,
                progress);
    hold_near(options, sets, organ);
    for (Vec3& p : organ.surface.points) p = sets.sets.frame.to_lps(p);
    organ.scan.layers.clear();
    return organ;
}

void refuse_for_surface(const OrganOptions& options) {
    std::vector<std::string> given = label_options_given(options.scan);
    if (!given.empty() && given.front() == "--labels") given.front() = "--label";
    refuse_options(given, options.scan.input, "a surface, which is one tissue");
    if (!options.hold_to.empty())
        throw InputError(options.scan.input.string() +
                         ": is a surface, which has no labels to hold it to; hold 'points', "
                         "'balls' or 'rims'");
}

// A surface made anew with so many nodes: each try has samples for its own edge length.
Organ organ_of_nodes(OrganOptions options, ProgressSink& progress) {
    const int nodes = std::exchange(options.nodes, 0);
    options.edge_length = edge_for(area_of(*read_scan(options.scan).surface), nodes);
    for (int attempt = 1;; ++attempt) {
        Organ organ = organ_of_level_set(options, progress);
        const std::size_t came = organ.surface.points.size();
        const double excess = static_cast<double>(came) / nodes;
        if (std::abs(excess - 1) < kNearEnough || attempt == kTries) {
            if (far_from(nodes, came)) organ.notes.push_back(missed(nodes, came));
            return organ;
        }
        options.edge_length *= std::sqrt(excess);
    }
}

Organ organ_of_surface(const OrganOptions& options) {
    std::vector<std::string> given;
    if (options.level_sets.smooth >= 0) given.emplace_back("--smooth");
    if (!options.level_sets.repair.empty()) given.emplace_back("--repair");
    if (options.level_sets.smoothing != levelset::Smoothing::curvature)
        given.emplace_back("--smoothing");
    refuse_options(given, options.scan.input,
                   "a surface that is pressed as it is; with --nodes or --edge-length it is made "
                   "into a level set first");
    Organ organ;
    organ.scan = read_plain_surface(options.scan);
    organ.name = organ.scan.tissues.front().name;
    organ.label = organ.scan.tissues.front().label;
    organ.surface = *organ.scan.surface;
    if (quality::measure_surface(organ.surface).boundary_edges == 0 && volume(organ.surface) < 0) {
        for (Triangle& t : organ.surface.triangles) std::swap(t[1], t[2]);
        organ.notes.emplace_back("the surface faced inward and was turned outward");
    }
    return organ;
}

}  // namespace

Organ find_organ(const OrganOptions& options, ProgressSink& progress) {
    if (kind_of(options.scan.input) != InputKind::surface)
        return organ_of_level_set(options, progress);
    refuse_for_surface(options);
    if (options.nodes > 0) return organ_of_nodes(options, progress);
    if (options.edge_length > 0) return organ_of_level_set(options, progress);
    return organ_of_surface(options);
}

}  // namespace myotet::app
