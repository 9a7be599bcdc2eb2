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
    Talk talk;
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
    add_threads_option(command, a.job.threads);
    add_talk_options(command, a.talk);
}

ExitCode run(const Arguments& a) {
    const Verbosity verbosity = a.talk.verbosity();
    set_up_log(verbosity);
    LevelSetReport report;
    {
        ConsoleProgress progress(verbosity);
        report = run_level_set_job(a.job, progress);
    }
    std::cout << (a.talk.json ? to_json(report) : to_table(report)) << std::flush;
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
