// SPDX-License-Identifier: Apache-2.0
#include "Sizing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Core/Text.h"
#include "Meshing/Refine.h"
#include "Meshing/Select.h"

namespace myotet::app {
namespace {

constexpr double kVoxelsPerEdge = 2;       // shorter edges would mesh the voxels' own steps
constexpr double kMostTetsOfLabels = 1e6;  // by default; more is to be asked for
constexpr double kTetsOfSurface = 1e5;     // by default
// ln(tetrahedra) against ln(edge length) is nearly straight, of a slope between
// -2 (all on the surface) and -3 (all inside).
constexpr double kSlope = -2.5;
// Level set of a surface: samples along an edge.
constexpr double kSamplesPerEdge = 4, kSamplesPerDraftEdge = 3;

// Fitted to runs on a 32-tissue arm, a 49-tissue knee and a 61-tissue trunk, and
// rounded up; a sample is a square of the level set's spacing on a surface.
constexpr double kBytesOfProgram = 6e7;
constexpr double kBytesPerVoxel = 5;
constexpr double kBytesPerSample = 450;
constexpr double kBytesPerTet = 200;
constexpr double kSecondsPerVoxel = 4e-8;
constexpr double kSecondsPerSample = 3.5e-5;
constexpr double kSecondsPerTet = 5e-5;
// Tetrahedra of finished meshes for each of the first candidates: 1.03 to 1.25.
constexpr double kGrowth = 1.14;
constexpr double kMostTets = 5e8;  // 32-bit indices and what hangs on them

/// The inside is never finer than the surface.
meshing::Options with_edge_length(meshing::Options sizes, double edge_length) {
    sizes.edge_length = edge_length;
    if (sizes.interior_edge_length > 0)
        sizes.interior_edge_length = std::max(sizes.interior_edge_length, edge_length);
    return meshing::spelled_out(sizes);
}

meshing::Options sizes_at(double edge_length, const SizeOptions& asked) {
    meshing::Options sizes;
    sizes.interior_edge_length = asked.interior_edge_length;
    sizes.curvature_factor = asked.curvature;
    sizes.uniform = asked.uniform;
    sizes.draft = asked.draft;
    if (asked.max_aspect_ratio > 0) sizes.aspect_ratio = asked.max_aspect_ratio;
    return with_edge_length(sizes, edge_length);
}

double forecast_tets(const meshing::Options& sizes, const Scan& scan) {
    double tets = 0;
    for (const Tissue& tissue : asked_tissues(scan))
        tets += meshing::forecast_tets(tissue.volume, tissue.area, sizes);
    return tets;
}

/// The shortest edge length whose forecast is at most `tets`: bisection, as
/// the forecast falls with the edge length.
double shortest_edge_for(double tets, const SizeOptions& asked, const Scan& scan) {
    double extent = 0;
    for (const Tissue& tissue : asked_tissues(scan)) extent += std::sqrt(tissue.area);
    double low = 1e-6 * extent, high = 10 * extent;
    constexpr int kHalvings = 40;  // of the logarithm: far below any rounding that matters
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = std::sqrt(low * high);
        (forecast_tets(sizes_at(middle, asked), scan) > tets ? low : high) = middle;
    }
    return high;
}

/// Three digits are enough for a length that is said to people.
double rounded_up(double length) {
    const double unit = std::pow(10.0, std::floor(std::log10(length)) - 2);
    return std::ceil(length / unit) * unit;
}

double tets_at(const std::vector<levelset::Region>& regions, const meshing::Options& sizes,
               ProgressSink& progress) {
    return parallel_sum(0, regions.size(), 1, [&](std::size_t r, std::size_t) {
        SilentProgress silent;
        progress.check();
        const meshing::Options options = options_for(regions[r], sizes);
        try {
            auto lattice = meshing::build_lattice(regions[r].phi, options,
                                                  meshing::plan_levels(options), silent);
            const auto candidate =
                meshing::select_candidate(lattice, {.components = options.components}, silent);
            return static_cast<double>(candidate.mesh.tets.size());
        } catch (const MeshError&) {
            return 0.0;  // too thin at this length; the run itself will say so
        }
    });
}

}  // namespace

meshing::Options choose_sizes(const SizeOptions& asked, const Scan& scan) {
    double edge_length = asked.edge_length;
    if (asked.tets > 0) {
        edge_length = shortest_edge_for(static_cast<double>(asked.tets), asked, scan);
    } else if (!(edge_length > 0) && scan.surface) {
        edge_length = rounded_up(shortest_edge_for(kTetsOfSurface, asked, scan));
    } else if (!(edge_length > 0)) {
        const double voxel = std::cbrt(scan.spacing.prod());
        edge_length = rounded_up(
            std::max(kVoxelsPerEdge * voxel, shortest_edge_for(kMostTetsOfLabels, asked, scan)));
    }
    meshing::Options sizes = sizes_at(edge_length, asked);
    if (scan.surface) sizes.components = scan.shells;
    return sizes;
}

double level_set_spacing(const meshing::Options& sizes, const Scan& scan) {
    return scan.surface ? sizes.edge_length / (sizes.draft ? kSamplesPerDraftEdge : kSamplesPerEdge)
                        : 0;
}

Forecast forecast(const meshing::Options& sizes, const Scan& scan) {
    double voxels = 0;
    for (const LabelVolume& layer : scan.layers) voxels += static_cast<double>(layer.values.size());
    const double spacing =
        scan.surface ? level_set_spacing(sizes, scan) : std::cbrt(scan.spacing.prod());
    double samples = 0;
    for (const Tissue& tissue : asked_tissues(scan)) samples += tissue.area / (spacing * spacing);
    Forecast result;
    result.edge_length = sizes.edge_length;
    result.tets = forecast_tets(sizes, scan);
    result.bytes = kBytesOfProgram + kBytesPerVoxel * voxels + kBytesPerSample * samples +
                   kBytesPerTet * result.tets;
    result.seconds =
        kSecondsPerVoxel * voxels + kSecondsPerSample * samples + kSecondsPerTet * result.tets;
    return result;
}

std::string to_sentence(const Forecast& forecast) {
    return formatted(
        "forecast at an edge length of %.3g mm: about %.2g tetrahedra, %.2g GB of memory, "
        "%.2g s of processor time",
        forecast.edge_length, forecast.tets, 1e-9 * forecast.bytes, forecast.seconds);
}

void require_room_for(const Forecast& forecast, double available_bytes) {
    std::string limit;
    if (!(forecast.tets <= kMostTets))
        limit = formatted("one run can number %.2g tetrahedra", kMostTets);
    else if (!(forecast.bytes <= available_bytes))
        limit = formatted("%.2g GB are available", 1e-9 * available_bytes);
    else
        return;
    throw ResourceError(to_sentence(forecast) + ", but " + limit +
                        "; use a longer --edge-length or fewer --labels");
}

meshing::Options options_for(const levelset::Region& region, meshing::Options sizes) {
    const bool from_labels = region.voxels > 0;
    sizes.volume = from_labels ? region.volume_labels : 0;
    if (from_labels) sizes.components = 1;
    return sizes;
}

meshing::Options bounded(meshing::Options sizes, double tets) {
    sizes.least_tets = static_cast<std::int64_t>((1 - kTetsTolerance) * tets);
    sizes.most_tets = static_cast<std::int64_t>((1 + kTetsTolerance) * tets);
    return sizes;
}

meshing::Options rescaled(meshing::Options sizes, double excess) {
    return with_edge_length(sizes, sizes.edge_length * std::pow(excess, -1 / kSlope));
}

meshing::Options sizes_for_total(const std::vector<levelset::Region>& regions,
                                 const meshing::Options& first_guess, double tets,
                                 ProgressSink& progress) {
    // A secant search in logarithms, kept within its bracket.
    constexpr int kMostTrials = 12;
    constexpr double kGoodEnough = 0.2 * kTetsTolerance;
    if (!first_guess.uniform) tets /= kGrowth;
    const double unset = std::numeric_limits<double>::quiet_NaN();
    double x = std::log(first_guess.edge_length);
    double best_x = x, best_error = std::numeric_limits<double>::infinity();
    double low = unset, low_y = 0, high = unset, high_y = 0;  // too many, too few tetrahedra
    for (int trial = 0; trial < kMostTrials; ++trial) {
        progress.report("edge length", static_cast<double>(trial) / kMostTrials);
        const auto sizes = with_edge_length(first_guess, std::exp(x));
        const double count = std::max(1.0, tets_at(regions, sizes, progress));
        const double y = std::log(count / tets);
        if (std::abs(y) < best_error) best_error = std::abs(y), best_x = x;
        if (std::abs(y) < kGoodEnough) break;
        (y > 0 ? low : high) = x;
        (y > 0 ? low_y : high_y) = y;
        x = std::isnan(low) || std::isnan(high)
                ? x - y / kSlope
                : low + (high - low) * std::clamp(low_y / (low_y - high_y), 0.1, 0.9);
    }
    if (best_error > std::log1p(kTetsTolerance))
        progress.warn("no edge length was found that makes " +
                      std::to_string(static_cast<long long>(tets)) +
                      " tetrahedra within 10 %; the nearest is used");
    return with_edge_length(first_guess, std::exp(best_x));
}

}  // namespace myotet::app
