// SPDX-License-Identifier: Apache-2.0
#include "MeshJob.h"

#include "Core/Parallel.h"
#include "Core/Stopwatch.h"
#include "Costs.h"
#include "Machine.h"
#include "MeshStages.h"
#include "ReportText.h"
#include "Text.h"

namespace myotet::app {
namespace {

Scan read(const JobOptions& options, ProgressSink& progress) {
    progress.report("reading", 0);
    Scan scan = read_scan(options.scan);
    tell(scan, progress);
    return scan;
}

/// What was asked for and could not be had.
void note_aspect_ratio(TissueReport& report, double asked) {
    if (asked > 0 && report.shapes.max_aspect_ratio > asked)
        report.notes.push_back("the largest aspect ratio is " +
                               readable(report.shapes.max_aspect_ratio) + ", beyond the " +
                               readable(asked) + " asked for; try a shorter --edge-length");
}

}  // namespace

Forecast forecast_job(const JobOptions& options, ProgressSink& progress) {
    const OutputFolder out(options.output);
    const Scan scan = read(options, progress);
    return forecast(choose_sizes(options.sizes, scan), scan);
}

RunReport run_job(const JobOptions& options, ProgressSink& progress) {
    const ThreadLimit limit(options.threads);
    OutputFolder out(options.output);
    std::map<std::string, double> seconds;
    Stopwatch watch;

    Scan scan = read(options, progress);
    meshing::Options sizes = choose_sizes(options.sizes, scan);
    sizes.compression = options.compression;
    sizes.validate();
    const Forecast expected = forecast(sizes, scan);
    require_room_for(expected, available_memory());
    progress.note(to_sentence(expected));
    progress.check();
    seconds["read"] = watch.lap();

    LevelSetChoices choices = options.level_sets;
    if (scan.surface) choices.spacing = level_set_spacing(sizes, scan);
    TissueSets sets = make_level_sets(scan, choices, progress);
    require_distinct_labels(sets.tissues, options.formats);
    scan.layers.clear();
    seconds["level_sets"] = watch.lap();

    std::vector<TissueMesh> tissues = mesh_to_size(sets, scan, sizes, options.sizes.tets, progress);
    RunReport report = describe_run(options, scan, sizes, sets);
    seconds["mesh"] = watch.lap();

    MeshOutput meshes(options.formats, out);
    for (std::size_t t = 0; t < tissues.size(); ++t) {
        progress.check();
        progress.report("writing", static_cast<double>(t) / static_cast<double>(tissues.size()));
        note_aspect_ratio(tissues[t].report, options.sizes.max_aspect_ratio);
        if (tissues[t].report.broken_promises.empty()) meshes.write_tissue(tissues[t]);
        report.tissues.push_back(std::move(tissues[t].report));
        tissues[t].mesh = {};
    }
    const std::vector<std::string> together = meshes.write_together();
    for (TissueReport& tissue : report.tissues)
        if (!tissue.files.empty())
            tissue.files.insert(tissue.files.end(), together.begin(), together.end());
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
