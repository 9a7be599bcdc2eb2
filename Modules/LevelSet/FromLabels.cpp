// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/FromLabels.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <sstream>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "LevelSet/Changes.h"
#include "LevelSet/Flow.h"
#include "LevelSet/LabelGrid.h"
#include "LevelSet/Measure.h"
#include "LevelSet/Partition.h"
#include "LevelSet/Redistance.h"
#include "LevelSet/RegionMap.h"
#include "LevelSet/SliceShape.h"
#include "LevelSet/VoxelBand.h"
#include "LevelSet/VoxelVolume.h"

namespace myotet::levelset {
namespace {

// Half widths of the bands, in samples.
constexpr double kWorkWidth = 3, kResultWidth = 3;
// The flow lasts longer than a corner needs to reach the allowance, so that
// the steps of slowly sloping surfaces, several voxels long, are levelled too;
// locks hold what has arrived.
constexpr double kLonger = 6;
// Displacement is given back on the scale of this many times the allowance:
// three half voxels, beyond the steps and within the shapes they make up.
constexpr double kGiveBack = 3;
// Volume is restored on the scale of this many times the allowance: beyond the
// steps of slowly sloping surfaces, so that they do not come back, and short
// enough that no tissue's centroid moves by a voxel.
constexpr double kRestore = 5;

// Regions one by one on as many threads as there are, with progress. Each
// result depends on its region alone.
void each_region(std::size_t count, std::string_view stage, ProgressSink& progress,
                 const std::function<void(std::size_t)>& body) {
    progress.report(stage, 0);
    std::atomic<std::size_t> done = 0;
    parallel_for(0, count, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r) {
            progress.check();
            body(r);
            progress.report(stage, double(++done) / double(count));
        }
    });
}

Allowance allowance_for(const LabelGrid& grid, Smoothing smoothing) {
    Allowance allowance;
    const Vec3& side = grid.lattice.plane_spacing;
    const int thick = grid.lattice.thick_axis;
    allowance.voxels = grid.smooth / (thick < 0 ? side.maxCoeff() : larger_pixel_side(side, thick));
    // A voxel's centre lies half its side from its walls.
    if (smoothing == Smoothing::constrained) allowance.voxels = std::min(allowance.voxels, 0.5);
    // Locks look one voxel far.
    if (allowance.voxels > 1) allowance.voxels = std::numeric_limits<double>::infinity();
    return allowance;
}

void smooth_region(const LabelGrid& grid, const Allowance& allowance, const ProgressSink& progress,
                   RegionBand& region) {
    const bool bounded = std::isfinite(allowance.voxels);
    FlowOptions options;
    options.time = (bounded ? kLonger : 1) * flow_time(grid.smooth);
    options.give_back_radius = kGiveBack * grid.smooth;
    options.wanders = !bounded;
    region.held_back = flow_by_mean_curvature(region.band, {region.locks, region.lock_unit},
                                              options, progress) > 0;
}

// By region: its voxels' volume, in all and cell by cell.
WantedVolumes wanted_volumes(const VoxelScene& scene, const LabelGrid& grid,
                             const std::vector<RegionBand>& work) {
    WantedVolumes wanted;
    const double voxel = std::abs(scene.lattice.local_to_index.inverse().linear().determinant());
    wanted.total.assign(work.size(), 0.0);
    for (std::size_t r = 1; r < work.size(); ++r)
        wanted.total[r] = static_cast<double>(scene.map.regions[r - 1].voxels) * voxel;
    if (!(grid.smooth > 0) || !std::isfinite(scene.allowance.voxels)) return wanted;
    // Thick slices would bring their terraces back.
    if (grid.lattice.thick_axis >= 0) return wanted;
    wanted.radius = kRestore * grid.smooth;
    wanted.cells.resize(work.size());
    parallel_for(0, work.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r)
            wanted.cells[r] = voxel_volumes(scene, static_cast<RegionMap::Owner>(r), work[r]);
    });
    return wanted;
}

LevelSet finish_band(RegionBand& work, const Seams& seams) {
    Band band = refit(work.band, static_cast<float>(kResultWidth * work.band.spacing));
    work = {};
    redistance(band, Seeds::keep_cells, 2);
    LevelSet phi = assemble(band);
    attach_seams(phi, seams);
    return phi;
}

Region finish_region(const VoxelRegion& voxels, double voxel_volume, RegionBand& work,
                     const Seams& seams) {
    Region region;
    region.label = voxels.label;
    region.component = voxels.component;
    region.voxels = voxels.voxels;
    region.volume_labels = static_cast<double>(voxels.voxels) * voxel_volume;
    region.smoothed_less = work.held_back;
    region.phi = finish_band(work, seams);
    region.volume_level_set = enclosed_volume(region.phi);
    region.inscribed_radius = inscribed_radius(region.phi);
    return region;
}

// What each kind of smoothing asks of the grid.
LabelOptions resolve(LabelOptions options, const LabelVolume& volume) {
    if (options.smoothing == Smoothing::none) options.smooth = 0;
    if (options.smoothing != Smoothing::constrained) return options;
    const double side = plane_spacing(volume).minCoeff();
    if (options.spacing == 0) options.spacing = side;
    if (!(options.spacing <= side * (1 + 1e-6))) {
        std::ostringstream out;
        out << "spacing is " << options.spacing << " mm but constrained smoothing needs at most "
            << side << " mm, the voxels' smallest side, to tell their centres apart";
        throw InputError(out.str());
    }
    return options;
}

}  // namespace

void LabelOptions::validate() const {
    const auto require = [](bool good, const char* field, double value, const char* rule) {
        if (good) return;
        std::ostringstream out;
        out << field << " is " << value << " but must be " << rule;
        throw InputError(out.str());
    };
    require(spacing >= 0 && std::isfinite(spacing), "spacing", spacing,
            "a length in mm, or 0 to have it chosen");
    require(std::isfinite(smooth), "smooth", smooth,
            "a length in mm, or negative to have it chosen");
    require(smoothing != Smoothing::none || smooth <= 0, "smooth", smooth,
            "0 where smoothing is none; ask for another kind of smoothing or for no distance");
    require(max_memory > 0, "max_memory", max_memory, "a positive number of bytes");
}

LabelLevelSets from_labels(const LabelVolume& volume, std::span<const std::int32_t> labels,
                           const LabelOptions& options, ProgressSink& progress) {
    options.validate();
    progress.report("distances", 0);
    RegionMap map = map_regions(volume, labels);
    const auto walls = shared_walls(map, face_area(volume));
    const LabelGrid grid = lay_grid(volume, walls, resolve(options, volume));
    const auto claims = claim_samples(map, grid.lattice);
    const VoxelScene scene{map, grid.lattice, claims, allowance_for(grid, options.smoothing),
                           kWorkWidth};

    std::vector<RegionBand> work(map.regions.size() + 1);
    // Between thick slices the background is what the regions leave.
    const bool thick = grid.lattice.thick_axis >= 0;
    each_region(work.size(), "distances", progress, [&](std::size_t r) {
        const auto owner = static_cast<RegionMap::Owner>(r);
        if (!thick)
            work[r] = voxel_band(scene, owner);
        else if (r > 0)
            work[r] = slice_band(scene, owner);
    });
    if (thick) work[0] = background_band(scene, work);
    each_region(work.size(), "smoothing", progress,
                [&](std::size_t r) { smooth_region(grid, scene.allowance, progress, work[r]); });

    progress.report("partition", 0);
    WantedVolumes wanted = wanted_volumes(scene, grid, work);
    wanted.hold_voxels = options.smoothing == Smoothing::constrained;
    const PartitionSummary partition =
        make_partition(work, map, grid.lattice, walls, wanted, progress);
    progress.report("partition", 1);

    LabelLevelSets out;
    out.frame = grid.frame;
    out.spacing = grid.lattice.spacing;
    out.smooth = grid.smooth;
    out.regions.resize(map.regions.size());
    if (options.background) out.background = finish_band(work.front(), partition.seams.front());
    work.front() = {};
    std::vector<RegionChanges> changes(map.regions.size());
    each_region(map.regions.size(), "level sets", progress, [&](std::size_t r) {
        out.regions[r] = finish_region(map.regions[r], volume.voxel_volume(), work[r + 1],
                                       partition.seams[r + 1]);
        changes[r] = measure_changes(map, static_cast<RegionMap::Owner>(r + 1), grid.lattice,
                                     out.regions[r].phi);
    });
    out.smoothing = report_changes(out.regions, changes);
    return out;
}

}  // namespace myotet::levelset
