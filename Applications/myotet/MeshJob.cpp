// SPDX-License-Identifier: Apache-2.0
#include "MeshJob.h"

#include "Core/AtomicFile.h"
#include "Core/Parallel.h"
#include "LevelSet/FromLabels.h"
#include "LevelSet/FromSurface.h"
#include "Machine.h"
#include "MeshFiles/MeshFiles.h"
#include "Meshing/Refine.h"
#include "Outputs.h"
#include "ReportText.h"
#include "Scan.h"
#include "Stopwatch.h"
#include "TissueMesh.h"

#include <cmath>
#include <cstdio>

namespace myotet::app {
namespace {

using levelset::LabelLevelSets;

std::string in_mm(double length) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g mm", length);
    return text;
}

std::vector<std::int32_t> values_of(const std::vector<Tissue>& tissues) {
    std::vector<std::int32_t> values;
    for (const Tissue& tissue : tissues) values.push_back(tissue.label);
    return values;
}

/// A surface is one region in its own coordinates, which are the patient's.
LabelLevelSets level_sets_of_surface(const Scan& scan, const meshing::Options& sizes,
                                     const JobOptions& options, ProgressSink& progress) {
    LabelLevelSets sets;
    sets.spacing = level_set_spacing(sizes, scan);
    sets.smooth = std::max(0.0, options.smooth);
    const Tissue& tissue = scan.tissues.front();
    sets.regions.push_back(
        {.label = tissue.label,
         .volume_labels = tissue.volume,
         .phi = levelset::from_surface(
             *scan.surface, {.spacing = sets.spacing, .smooth = sets.smooth}, progress)});
    return sets;
}

LabelLevelSets make_level_sets(const Scan& scan, const meshing::Options& sizes,
                               const JobOptions& options, ProgressSink& progress) {
    if (scan.surface) return level_sets_of_surface(scan, sizes, options, progress);
    return levelset::from_labels(
        *scan.volume, values_of(scan.tissues),
        {.spacing = level_set_spacing(sizes, scan), .smooth = options.smooth}, progress);
}

/// One region of a surface holds all its pieces.
void count_surface_pieces(const Scan& scan, std::vector<TissueMesh>& tissues) {
    if (!scan.surface) return;
    TissueReport& report = tissues.front().report;
    report.components_in = scan.shells;
    if (report.components_out < scan.shells)
        report.notes.push_back(std::to_string(scan.shells - report.components_out) +
                               " closed pieces of the surface lie within others, touch them or "
                               "are too small to be meshed");
}

void write_tissue(TissueMesh& tissue, OutputFolder& out) {
    const std::string stem = file_stem(tissue.report.label, tissue.report.name);
    out.write(stem + ".vtu", [&](const std::filesystem::path& file) {
        meshfiles::write_vtu(tissue.mesh, {{tissue.report.label, tissue.report.name}}, file);
    });
    out.write(stem + ".stl", [&](const std::filesystem::path& file) {
        meshfiles::write_stl(boundary_surface(tissue.mesh), file);
    });
    tissue.report.files = {stem + ".vtu", stem + ".stl"};
}

RunReport describe(const JobOptions& options, const Scan& scan, const meshing::Options& sizes,
                   const LabelLevelSets& sets) {
    const meshing::LevelPlan plan = meshing::plan_levels(sizes);
    RunReport report;
    report.input = options.input.string();
    report.input_sha256 = scan.sha256;
    report.output = options.output.string();
    report.labels = values_of(scan.tissues);
    report.options_text = {{"names_from", scan.names_from.string()},
                           {"compress", options.compress},
                           {"input_unit", options.input_unit.empty() && scan.surface
                                              ? "mm"
                                              : options.input_unit}};
    report.options_number = {
        {"tets", options.sizes.tets > 0 ? static_cast<double>(options.sizes.tets) : NAN},
        {"edge_length_mm", sizes.edge_length},
        {"interior_edge_length_mm", plan.coarsest_edge},
        {"smallest_edge_length_mm", plan.smallest_edge},
        {"curvature", sizes.curvature_factor},
        {"smooth_mm", sets.smooth},
        {"level_set_spacing_mm", sets.spacing}};
    report.threads = thread_count();
    report.warnings = scan.warnings;
    return report;
}

}  // namespace

Forecast forecast_job(const JobOptions& options, ProgressSink& progress) {
    const OutputFolder out(options.output);
    progress.report("reading", 0);
    const Scan scan = read_scan(options);
    for (const std::string& warning : scan.warnings) progress.warn(warning);
    return forecast(choose_sizes(options.sizes, scan), scan);
}

RunReport run_job(const JobOptions& options, ProgressSink& progress) {
    const ThreadLimit limit(options.threads);
    Stopwatch watch;
    OutputFolder out(options.output);

    progress.report("reading", 0);
    Scan scan = read_scan(options);
    for (const std::string& warning : scan.warnings) progress.warn(warning);
    meshing::Options sizes = choose_sizes(options.sizes, scan);
    sizes.validate();
    require_room_for(forecast(sizes, scan), available_memory());
    const double seconds_read = watch.lap();
    progress.check();

    LabelLevelSets sets = make_level_sets(scan, sizes, options, progress);
    scan.volume.reset();
    const double seconds_level_sets = watch.lap();

    if (options.sizes.tets > 0)
        sizes.edge_length = edge_length_for_total(
            sets.regions, sizes, static_cast<double>(options.sizes.tets), progress);
    const meshing::LevelPlan plan = meshing::plan_levels(sizes);
    progress.note("edge length " + in_mm(plan.surface_edge) + " on the surface, up to " +
                  in_mm(plan.coarsest_edge) + " inside");
    RunReport report = describe(options, scan, sizes, sets);
    report.seconds["read"] = seconds_read;
    report.seconds["level_sets"] = seconds_level_sets;
    report.seconds["edge_length"] = watch.lap();

    std::vector<TissueMesh> tissues = mesh_tissues(sets, scan.tissues, sizes, progress);
    count_surface_pieces(scan, tissues);
    report.seconds["mesh"] = watch.lap();

    for (std::size_t t = 0; t < tissues.size(); ++t) {
        progress.check();
        progress.report("writing", static_cast<double>(t) / static_cast<double>(tissues.size()));
        if (tissues[t].report.broken_promises.empty()) write_tissue(tissues[t], out);
        report.tissues.push_back(std::move(tissues[t].report));
        tissues[t].mesh = {};
    }
    report.seconds["write"] = watch.lap();
    report.peak_memory = peak_memory();
    report.processor_seconds = processor_seconds();
    out.write("report.json", [&](const std::filesystem::path& file) {
        write_atomically(file, to_json(report));
    });
    progress.check();
    out.keep();
    progress.report("writing", 1);
    return report;
}

}  // namespace myotet::app
