// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>
#include <memory>

#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"
#include "FitJob.h"

namespace myotet::app {
namespace {

struct Arguments {
    FitJobOptions job;
    Talk talk;
};

void add_options(CLI::App& command, Arguments& a) {
    command.add_option("SCENE", a.job.scene, "what is contracted, and how (.yaml)")
        ->required()
        ->type_name("SCENE.yaml");
    command
        .add_option("--target", a.job.target,
                    "quantities of history.csv over time that the scene shall come to, such as "
                    "time,biceps_at_forearm_force (.csv, .sto)")
        ->required()
        ->type_name("FILE");
    command.add_option("-o,--output", a.job.output, "folder for the results")
        ->required()
        ->type_name("FOLDER");
    command
        .add_option("--body", a.job.body,
                    "muscle whose activation is sought (default: the only one)")
        ->type_name("NAME");
    command
        .add_option("--intervals", a.job.fitting.intervals,
                    "pieces of the activation's cubic spline (default: one each 0.2 s, at most 5)")
        ->check(CLI::Range(1, 200))
        ->type_name("N");
    command
        .add_option("--evaluations", a.job.fitting.evaluations,
                    "times that the scene is run, at most (default: 40)")
        ->check(CLI::Range(1, 100000))
        ->type_name("N");
    command
        .add_option("--goal", a.job.fitting.goal,
                    "good enough: misfit (rms) as a part of the target's most (default: 0.01)")
        ->check(kPositive)
        ->type_name("PART");
    add_threads_option(command, a.job.threads);
    add_talk_options(command, a.talk);
}

ExitCode run(const Arguments& a) {
    const Verbosity verbosity = a.talk.verbosity();
    set_up_log(verbosity);
    FitReport report;
    {
        ConsoleProgress progress(verbosity);
        report = run_fit_job(a.job, progress);
    }
    std::cout << (a.talk.json ? to_json(report) : to_table(report)) << std::flush;
    if (report.fitted.fit.status == activation::Status::converged) {
        const bool far = std::ranges::any_of(report.fitted.quantities, [&](const auto& quantity) {
            return quantity.misfit > a.job.fitting.goal * quantity.most;
        });
        if (far)
            log_info("this is the best that a spline of " +
                     std::to_string(report.fitted.basis.intervals) +
                     " intervals can do; more --intervals may come nearer");
        log_info("results are in " + report.output);
        return ExitCode::done;
    }
    log_error(report.fitted.fit.message);
    log_info("the best that was found is in " + report.output);
    return ExitCode::not_converged;
}

}  // namespace

void add_fit(CLI::App& program, ExitCode& code) {
    CLI::App* command = program.add_subcommand(
        "fit", "the activation with which a contraction comes to measured forces or lengths");
    const auto arguments = std::make_shared<Arguments>();
    add_options(*command, *arguments);
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
