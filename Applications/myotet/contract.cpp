// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <map>
#include <memory>

#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"
#include "ContractJob.h"
#include "ReportJob.h"

namespace myotet::app {
namespace {

struct Arguments {
    ContractJobOptions job;
    Talk talk;
    bool dry_run = false, page = true;
};

void add_options(CLI::App& command, Arguments& a) {
    command.add_option("SCENE", a.job.scene, "what is contracted, and how (.yaml)")
        ->required()
        ->type_name("SCENE.yaml");
    command.add_option("-o,--output", a.job.output, "folder for the results")
        ->required()
        ->type_name("FOLDER");
    command.add_flag("--resume", a.job.resume, "go on from the checkpoint in the folder");
    command
        .add_option("--checkpoint-every", a.job.checkpoint_every,
                    "steps from one checkpoint to the next (default: 10)")
        ->check(CLI::Range(1, 1000000))
        ->type_name("K");
    using contraction::Series;
    static const std::map<std::string, Series> series = {
        {"auto", Series::by_count}, {"pvd", Series::pvd}, {"xdmf", Series::xdmf}};
    command
        .add_option("--series", a.job.series,
                    "what frames become: pvd, a .vtu each and a .pvd; xdmf, one .h5 and one .xdmf; "
                    "auto, xdmf beyond 500 frames (default: auto)")
        ->transform(one_of(series))
        ->type_name("KIND");
    add_threads_option(command, a.job.threads);
    add_no_flag(command, "--no-pictures", a.job.pictures,
                "draw no pictures of the frames (default: pictures/*.png in the folder)");
    add_page_option(command, a.page);
    add_talk_options(command, a.talk);
    command.add_flag("--dry-run", a.dry_run,
                     "only read, mesh and check the scene and say what it holds; write nothing");
}

ExitCode tell_end(const ContractReport& report) {
    if (report.run.completed) {
        log_info("results are in " + report.output);
        return ExitCode::done;
    }
    log_error(report.run.message);
    log_info("what was reached is in " + report.output +
             (report.run.resumable ? "; go on with --resume" : ""));
    return report.run.interrupted ? ExitCode::interrupted : ExitCode::not_converged;
}

ExitCode run(const Arguments& a) {
    const Verbosity verbosity = a.talk.verbosity();
    set_up_log(verbosity);
    ContractReport report;
    {
        ConsoleProgress progress(verbosity);
        report = a.dry_run ? check_scene(a.job, progress) : run_contract_job(a.job, progress);
        if (!a.dry_run) add_page(a.job.output, a.page && !report.run.interrupted, progress);
    }
    for (const ContractBody& body : report.bodies)
        for (const std::string& note : body.notes) log_detail(body.name + ": " + note);
    std::cout << (a.talk.json ? to_json(report) : to_table(report)) << std::flush;
    return a.dry_run ? ExitCode::done : tell_end(report);
}

}  // namespace

void add_contract(CLI::App& program, ExitCode& code) {
    CLI::App* command = program.add_subcommand(
        "contract", "contract the muscles of a scene: finite elements, over time");
    const auto arguments = std::make_shared<Arguments>();
    add_options(*command, *arguments);
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
