// SPDX-License-Identifier: Apache-2.0
#include "LevelSetJob.h"

#include <algorithm>
#include <cmath>

#include "Core/Parallel.h"
#include "Core/Stopwatch.h"
#include "Costs.h"
#include "LevelSet/Extract.h"
#include "LevelSet/WriteVdb.h"
#include "MeshFiles/MeshFiles.h"
#include "Outputs.h"
#include "ReportText.h"
#include "Text.h"

namespace myotet::app {
namespace {

using levelset::Region;

// Samples along the square root of a surface's area, where none are asked for.
constexpr double kSamplesAcross = 200;

LevelSetChoices with_spacing(LevelSetChoices choices, const Scan& scan) {
    if (scan.surface && !(choices.spacing > 0))
        choices.spacing = std::sqrt(scan.tissues.front().area) / kSamplesAcross;
    return choices;
}

std::vector<const Region*> regions_of(const Tissue& tissue, const TissueSets& sets) {
    std::vector<const Region*> regions;
    for (const Region& region : sets.sets.regions)
        if (belongs(region, tissue)) regions.push_back(&region);
    return regions;
}

/// The surfaces of all components in the patient's frame.
TriMesh whole_surface(const std::vector<const Region*>& regions, const Frame& frame) {
    std::vector<TriMesh> parts(regions.size());
    parallel_for(0, regions.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r)
            parts[r] = levelset::extract_surface(regions[r]->phi);
    });
    TriMesh whole;
    for (const TriMesh& part : parts) {
        const auto first = static_cast<std::int32_t>(whole.points.size());
        for (const Vec3& p : part.points) whole.points.push_back(frame.to_lps(p));
        for (const Triangle& t : part.triangles)
            whole.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return whole;
}

LevelSetTissue write_tissue(const Tissue& tissue, const TissueSets& sets,
                            const std::string& surface_format, OutputFolder& out) {
    LevelSetTissue result{.tissue = tissue};
    const std::vector<const Region*> regions = regions_of(tissue, sets);
    std::vector<const levelset::LevelSet*> phis;
    for (const Region* region : regions) {
        ++result.components;
        result.volume += region->volume_level_set;
        result.inscribed_radius = std::max(result.inscribed_radius, region->inscribed_radius);
        phis.push_back(&region->phi);
        if (region->smoothed_less)
            result.notes.push_back("component " + std::to_string(region->component) + " (" +
                                   counted(region->voxels, "voxel") +
                                   ") was smoothed less to keep a thin part");
    }
    const TriMesh surface = whole_surface(regions, sets.sets.frame);
    result.triangles = surface.triangles.size();

    const std::string stem = file_stem(tissue.layer, tissue.label, tissue.name);
    out.write(stem + ".vdb", [&](const std::filesystem::path& file) {
        levelset::write_vdb(phis, {tissue.label, tissue.name, sets.sets.frame}, file);
    });
    out.write(stem + "." + surface_format, [&](const std::filesystem::path& file) {
        if (surface_format == "vtp")
            meshfiles::write_vtp(surface, {{tissue.label, tissue.name}}, file);
        else
            meshfiles::write_stl(surface, file);
    });
    result.files = {stem + ".vdb", stem + "." + surface_format};
    return result;
}

}  // namespace

LevelSetReport run_level_set_job(const LevelSetJobOptions& options, ProgressSink& progress) {
    const ThreadLimit limit(options.threads);
    OutputFolder out(options.output);
    std::map<std::string, double> seconds;
    Stopwatch watch;

    progress.report("reading", 0);
    Scan scan = read_scan(options.scan);
    tell(scan, progress);
    progress.check();
    seconds["read"] = watch.lap();

    const LevelSetChoices choices = with_spacing(options.level_sets, scan);
    const TissueSets sets = make_level_sets(scan, choices, progress);
    seconds["level_sets"] = watch.lap();

    LevelSetReport report;
    report.run = describe_level_sets(options.scan, choices, scan, sets);
    report.run.output = options.output.string();
    for (const Tissue& tissue : sets.tissues) {
        progress.check();
        progress.report("writing", static_cast<double>(report.tissues.size()) /
                                       static_cast<double>(sets.tissues.size()));
        report.tissues.push_back(write_tissue(tissue, sets, options.surface_format, out));
    }
    seconds["write"] = watch.lap();

    report.run.seconds = seconds;
    note_costs(report.run);
    write_report(out, report);
    progress.check();
    out.keep();
    progress.report("writing", 1);
    return report;
}

}  // namespace myotet::app
