// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <map>
#include <memory>

#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"
#include "ExitCodes.h"
#include "MeshJob.h"
#include "ReportJob.h"
#include "ReportText.h"
#include "Text.h"

namespace myotet::app {
namespace {

struct Arguments {
    JobOptions job;
    Talk talk;
    bool dry_run = false, page = true;
};

void add_options(CLI::App& command, Arguments& a) {
    add_scan_options(command, a.job.scan);
    command.add_option("-o,--output", a.job.output, "folder for the results")
        ->required()
        ->type_name("FOLDER");
    auto* edge = command.add_option("--edge-length", a.job.sizes.edge_length,
                                    "target edge length on the surface, mm (default: from the "
                                    "voxels, under a million tetrahedra)");
    auto* tets = command.add_option("--tets", a.job.sizes.tets,
                                    "or: about this many tetrahedra in all, within 10 %");
    edge->check(kPositive)->excludes(tets)->type_name("MM");
    tets->check(kPositive)->type_name("N");
    using Wish = std::map<std::string, bool>;
    static const Wish lattices = {{"graded", false}, {"uniform", true}},
                      qualities = {{"standard", false}, {"draft", true}};
    command
        .add_option("--lattice", a.job.sizes.uniform,
                    "graded: smaller where thin or far from the surface, larger inside; "
                    "uniform: one edge length, best angles (default: graded)")
        ->transform(one_of(lattices))
        ->type_name("KIND");
    command
        .add_option("--quality", a.job.sizes.draft,
                    "standard, or draft: in about half the time, promises kept, the worst "
                    "elements left as they are (default: standard)")
        ->transform(one_of(qualities))
        ->type_name("KIND");
    command
        .add_option("--interior-edge-length", a.job.sizes.interior_edge_length,
                    "how coarse the inside may grow, mm (default: 4x the edge length)")
        ->check(kPositive)
        ->type_name("MM");
    command
        .add_option("--curvature", a.job.sizes.curvature,
                    "refine where the longest edge > FACTOR / (|k1| + |k2|) (default: off)")
        ->check(kPositive)
        ->type_name("FACTOR");
    command
        .add_option("--max-aspect-ratio", a.job.sizes.max_aspect_ratio,
                    "refine, twice at most, where a few elements of the finished mesh lie "
                    "beyond this (default: 4.2)")
        ->check(CLI::Range(1.5, 1000.0))
        ->type_name("RATIO");
    add_level_set_options(command, a.job.level_sets);
    using meshing::Compression;
    static const std::map<std::string, Compression> kinds = {
        {"springs", Compression::springs},
        {"fem", Compression::fem},
        {"optimization", Compression::optimization}};
    command
        .add_option("--compress", a.job.compression,
                    "how the mesh is fitted to the surface: springs, fem, optimization or, in "
                    "order, fem,optimization (default: optimization)")
        ->transform(one_of(kinds))
        ->delimiter(',')
        ->type_name("KINDS");
    add_format_options(command, a.job.formats);
    add_threads_option(command, a.job.threads);
    add_page_option(command, a.page);
    add_talk_options(command, a.talk);
    command.add_flag("--dry-run", a.dry_run,
                     "only forecast tetrahedra, memory and time; write nothing");
}

ExitCode print_forecast(const Arguments& a, ProgressSink& progress) {
    const Forecast f = forecast_job(a.job, progress);
    std::cout << (a.talk.json ? to_json(f) : to_sentence(f) + "\n") << std::flush;
    return ExitCode::done;
}

void tell_notes(const RunReport& report) {
    std::size_t count = 0;
    for (const TissueReport& tissue : report.tissues) {
        count += tissue.notes.size();
        for (const std::string& note : tissue.notes)
            log_detail("label " + std::to_string(tissue.label) + " (" + tissue.name + "): " + note);
    }
    if (count > 0) log_info(counted(count, "note") + " on the tissues: see report.json");
}

ExitCode tell_broken_promises(const RunReport& report) {
    ExitCode code = ExitCode::done;
    for (const TissueReport& tissue : report.tissues) {
        for (const std::string& sentence : tissue.broken_promises)
            log_error("label " + std::to_string(tissue.label) + " (" + tissue.name +
                      "): " + sentence);
        if (!tissue.broken_promises.empty()) code = ExitCode::broken_promise;
    }
    return code;
}

/// An elastic body begins from the candidate, so that at most one is first.
void check_compression(const std::vector<meshing::Compression>& kinds) {
    for (std::size_t i = 1; i < kinds.size(); ++i)
        if (kinds[i] != meshing::Compression::optimization)
            throw UsageError(
                "--compress: springs and fem begin from the candidate; name one of them, first");
}

/// Where faults are not mended there is no limit to keep to.
void check_aspect_ratio(const JobOptions& job) {
    const bool optimised =
        job.compression.empty() || job.compression.back() == meshing::Compression::optimization;
    if (job.sizes.max_aspect_ratio > 0 && (job.sizes.uniform || job.sizes.draft || !optimised))
        throw UsageError(
            "--max-aspect-ratio is for graded, optimised meshes of standard quality: leave "
            "--lattice uniform, --quality draft and --compress springs or fem out");
}

/// One edge length leaves nothing to grade.
void check_lattice(const SizeOptions& sizes) {
    if (sizes.uniform && (sizes.interior_edge_length > 0 || sizes.curvature > 0))
        throw UsageError(
            "--lattice uniform has one edge length: leave --interior-edge-length and --curvature "
            "out");
}

ExitCode run(const Arguments& a) {
    check_compression(a.job.compression);
    check_lattice(a.job.sizes);
    check_aspect_ratio(a.job);
    const Verbosity verbosity = a.talk.verbosity();
    set_up_log(verbosity);
    RunReport report;
    {
        ConsoleProgress progress(verbosity);
        if (a.dry_run) return print_forecast(a, progress);
        report = run_job(a.job, progress);
        add_page(a.job.output, a.page, progress);
    }
    tell_notes(report);
    std::cout << (a.talk.json ? to_json(report) : to_table(report)) << std::flush;
    log_info("results are in " + a.job.output.string());
    return tell_broken_promises(report);
}

}  // namespace

void add_mesh(CLI::App& program, ExitCode& code) {
    CLI::App* command =
        program.add_subcommand("mesh", "tetrahedral meshes of a scan's tissues, or of a surface");
    const auto arguments = std::make_shared<Arguments>();
    add_options(*command, *arguments);
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
