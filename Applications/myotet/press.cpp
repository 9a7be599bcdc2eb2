// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"
#include "PressJob.h"
#include "ReportJob.h"

namespace myotet::app {
namespace {

struct Arguments {
    PressJobOptions job;
    Talk talk;
    bool page = true;
};

void add_input_options(CLI::App& command, PressJobOptions& job) {
    command
        .add_option("INPUT", job.organ.scan.input,
                    "the organ: a surface, open or closed (.obj .off .stl .ply .vtp), or labels "
                    "(.nii .nii.gz .nrrd .seg.nrrd .mha .mhd, DICOM SEG .dcm)")
        ->required()
        ->type_name("FILE");
    command
        .add_option("--label", job.organ.scan.labels,
                    "which label is pressed, by value, name or layer:value; needed where there "
                    "are several")
        ->type_name("LABEL");
    command
        .add_option("--tool", job.tool,
                    "what presses, and how: tools, forces, the wall, what is held, times (.yaml)")
        ->required()
        ->type_name("TOOL.yaml");
    command.add_option("-o,--output", job.output, "folder for the results")
        ->required()
        ->type_name("FOLDER");
    add_read_options(command, job.organ.scan.reading);
    command
        .add_option("--input-unit", job.organ.scan.input_unit,
                    "what a surface file's numbers mean: mm, cm or m (default: mm)")
        ->check(CLI::IsMember({"mm", "cm", "m"}));
    add_level_set_options(command, job.organ.level_sets);
}

void add_model_options(CLI::App& command, PressJobOptions& job) {
    auto* nodes =
        command
            .add_option("--nodes", job.organ.nodes,
                        "about how many nodes the coarsest level has (default: 400 for labels; a "
                        "surface as it is)")
            ->check(CLI::Range(20, 1000000))
            ->type_name("N");
    command
        .add_option("--edge-length", job.organ.edge_length,
                    "or the length of the coarsest level's edges, mm")
        ->check(kPositive)
        ->type_name("MM")
        ->excludes(nodes);
    command
        .add_option("--levels", job.levels,
                    "how often the surface may be refined, each time in four (default: 2)")
        ->check(CLI::Range(0, 8))
        ->type_name("N");
    add_no_flag(command, "--no-adapt", job.adapt,
                "refine all of the surface all the time (default: where it is pressed or bends)");
    add_no_flag(command, "--no-shape", job.shape,
                "no shape-preserving springs (default: as the tool's file or its material says)");
}

ExitCode run(const Arguments& a) {
    const Verbosity verbosity = a.talk.verbosity();
    set_up_log(verbosity);
    PressReport report;
    {
        ConsoleProgress progress(verbosity);
        report = run_press_job(a.job, progress);
        add_page(a.job.output, a.page, progress);
    }
    std::cout << (a.talk.json ? to_json(report) : to_table(report)) << std::flush;
    if (report.status == membrane::Status::finished) {
        log_info("results are in " + report.output);
        return ExitCode::done;
    }
    log_error(report.message);
    log_info("what was reached is in " + report.output);
    return ExitCode::not_converged;
}

}  // namespace

void add_press(CLI::App& program, ExitCode& code) {
    CLI::App* command = program.add_subcommand(
        "press", "press a hollow organ: a wall of springs, refined where it is pressed or bends");
    const auto arguments = std::make_shared<Arguments>();
    add_input_options(*command, arguments->job);
    add_model_options(*command, arguments->job);
    add_threads_option(*command, arguments->job.threads);
    add_no_flag(*command, "--no-pictures", arguments->job.pictures,
                "draw no pictures of the frames (default: pictures/*.png in the folder)");
    add_page_option(*command, arguments->page);
    add_talk_options(*command, arguments->talk);
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
