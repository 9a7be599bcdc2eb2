// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"
#include "LevelSetJob.h"
#include "ReportText.h"

namespace myotet::app {
namespace {

struct Arguments {
    LevelSetJobOptions job;
    bool json = false, quiet = false, verbose = false;
};

void add_options(CLI::App& command, Arguments& a) {
    add_scan_options(command, a.job.scan);
    command.add_option("-o,--output", a.job.output, "folder for the results")
        ->required()
        ->type_name("FOLDER");
    add_level_set_options(command, a.job.level_sets);
    command
        .add_option("--spacing", a.job.level_sets.spacing,
                    "distance between samples, mm (default: from the voxels)")
        ->check(kPositive)
        ->type_name("MM");
    command.add_option("--surface", a.job.surface_format, "format of the surfaces")
        ->check(CLI::IsMember({"stl", "vtp"}))
        ->capture_default_str();
    command.add_option("--threads", a.job.threads, "threads to use (default: all there are)")
        ->check(CLI::Range(1, 4096))
        ->type_name("N");
    command.add_flag("--json", a.json, "print report.json instead of the table");
    auto* quiet = command.add_flag("--quiet", a.quiet, "say nothing but errors and the result");
    command.add_flag("--verbose", a.verbose, "say more about what is done")->excludes(quiet);
}

ExitCode run(const Arguments& a) {
    const Verbosity verbosity = a.quiet     ? Verbosity::quiet
                                : a.verbose ? Verbosity::verbose
                                            : Verbosity::normal;
    set_up_log(verbosity);
    LevelSetReport report;
    {
        ConsoleProgress progress(verbosity);
        report = run_level_set_job(a.job, progress);
    }
    std::cout << (a.json ? to_json(report) : to_table(report)) << std::flush;
    log_info("results are in " + a.job.output.string());
    return ExitCode::done;
}

}  // namespace

void add_levelset(CLI::App& program, ExitCode& code) {
    CLI::App* command = program.add_subcommand(
        "levelset", "signed distances (.vdb) and surfaces of a scan's tissues, or of a surface");
    const auto arguments = std::make_shared<Arguments>();
    add_options(*command, *arguments);
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
