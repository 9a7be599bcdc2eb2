// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"
#include "PlayJob.h"

namespace myotet::app {
namespace {

struct Arguments {
    PlayJobOptions job;
    Talk talk;
    bool dry_run = false;
};

void add_options(CLI::App& command, Arguments& a) {
    command.add_option("SCENE", a.job.scene, "what is played, and how (.yaml)")
        ->required()
        ->type_name("SCENE.yaml");
    command.add_option("-o,--output", a.job.output, "folder for the results")
        ->required()
        ->type_name("FOLDER");
    add_threads_option(command, a.job.threads);
    add_no_flag(command, "--no-pictures", a.job.pictures,
                "draw no pictures of the frames (default: pictures/*.png in the folder)");
    add_talk_options(command, a.talk);
    command.add_flag("--dry-run", a.dry_run,
                     "only read and check the scene and say what it holds; write nothing");
}

ExitCode run(const Arguments& a) {
    const Verbosity verbosity = a.talk.verbosity();
    set_up_log(verbosity);
    PlayReport report;
    {
        ConsoleProgress progress(verbosity);
        report = a.dry_run ? check_play(a.job, progress) : run_play_job(a.job, progress);
    }
    std::cout << (a.talk.json ? to_json(report) : to_table(report)) << std::flush;
    if (a.dry_run) return ExitCode::done;
    log_info((report.run.completed ? "results are in " : "what was reached is in ") +
             report.output);
    return report.run.interrupted ? ExitCode::interrupted : ExitCode::done;
}

}  // namespace

void add_play(CLI::App& program, ExitCode& code) {
    CLI::App* command = program.add_subcommand(
        "play", "play a scene of soft bodies that collide, faster than its own clock");
    const auto arguments = std::make_shared<Arguments>();
    add_options(*command, *arguments);
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
