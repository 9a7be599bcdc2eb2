// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "ActivateJob.h"
#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"
#include "Core/Text.h"
#include "ReportJob.h"

namespace myotet::app {
namespace {

struct Arguments {
    ActivateJobOptions job;
    std::string cost = "activation^2";
    Talk talk;
    bool page = true;
};

// "activation^2", "stress^3"
void read_cost(const std::string& cost, ActivateJobOptions& job) {
    const std::size_t hat = cost.find('^');
    const std::string kind = cost.substr(0, hat);
    // 0 where it is none, which no power is.
    const double exponent =
        hat == std::string::npos ? 0 : to_number(cost.substr(hat + 1)).value_or(0);
    if ((kind != "activation" && kind != "stress") || !(exponent > 1) || !(exponent <= 10))
        throw UsageError("--cost: '" + cost +
                         "' is neither activation^P nor stress^P with P above 1, at most 10");
    job.criterion =
        kind == "stress" ? activation::Criterion::stress : activation::Criterion::activation;
    job.exponent = exponent;
}

// The inputs, and how muscles share the load.
void add_muscle_options(CLI::App& command, Arguments& a) {
    using activation::Tendons;
    command.add_option("MODEL", a.job.model, "a skeleton with muscles (.osim)")
        ->required()
        ->type_name("MODEL.osim");
    command
        .add_option("MOTION", a.job.motion,
                    "how its coordinates move (.mot, .sto, .csv) or key frames (.yaml)")
        ->required()
        ->type_name("MOTION");
    command.add_option("-o,--output", a.job.output, "folder for the results")
        ->required()
        ->type_name("FOLDER");
    command
        .add_option("--cost", a.cost,
                    "what muscles share a load by: activation^P or stress^P (default: "
                    "activation^2)")
        ->type_name("COST");
    static const std::map<std::string, Tendons> tendons = {{"elastic", Tendons::elastic},
                                                           {"rigid", Tendons::rigid}};
    command
        .add_option("--tendon", a.job.tendons,
                    "whether tendons stretch: elastic or rigid (default: as the model says)")
        ->transform(one_of(tendons))
        ->type_name("KIND");
    add_no_flag(command, "--no-passive", a.job.passive,
                "leave out what relaxed muscles pull when stretched");
    command.add_flag("--static", a.job.still, "leave out speeds and inertia: postures held");
    command
        .add_option("--bounds", a.job.bounds,
                    "least and most activations over time: columns MUSCLE_min, MUSCLE_max")
        ->type_name("FILE");
    auto* emg = command.add_option("--emg", a.job.emg,
                                   "measured activations over time, from 0 to 1: columns MUSCLE");
    emg->type_name("FILE");
    command
        .add_option("--tracking", a.job.tracking,
                    "weight of what --emg says beside the cost (default: 1)")
        ->check(kPositive)
        ->needs(emg)
        ->type_name("WEIGHT");
    command
        .add_option("--synergies", a.job.synergies,
                    "muscles are driven together: a row a synergy, numbered in the first column, "
                    "a column a MUSCLE with its share (.csv)")
        ->type_name("FILE");
    command
        .add_option("--curves", a.job.curves,
                    "instead of each time on its own, smooth activation curves that keep to the "
                    "muscles' rise and fall, a knot each S seconds; what torque they leave is told")
        ->check(kPositive)
        ->type_name("S");
}

// What else may carry a torque, which times, and what is said.
void add_run_options(CLI::App& command, Arguments& a) {
    command
        .add_option("--reserves", a.job.reserves,
                    "actuators that help where muscles cannot: NAME=STRENGTH,... or one STRENGTH "
                    "for all, N mm for angles, N for lengths (default: none)")
        ->delimiter(',')
        ->type_name("LIST");
    command
        .add_option("--hold", a.job.held,
                    "coordinates that something else holds, such as muscles that the model does "
                    "not have: NAME,... (default: locked ones and those that no muscle moves)")
        ->delimiter(',')
        ->type_name("LIST");
    command
        .add_option("--cutoff", a.job.cutoff_hz,
                    "low-pass of measured motion, Hz; 6 is usual (default: none)")
        ->check(kPositive)
        ->type_name("HZ");
    command.add_option("--from", a.job.from, "first time, s (default: the motion's first)")
        ->type_name("S");
    command.add_option("--to", a.job.to, "last time, s (default: the motion's last)")
        ->type_name("S");
    command
        .add_option("--step", a.job.step,
                    "time from one result to the next, s (default: the motion's own times; of "
                    "key frames 0.01)")
        ->check(kPositive)
        ->type_name("S");
    add_threads_option(command, a.job.threads);
    add_no_flag(command, "--no-pictures", a.job.pictures, "draw no activation.png");
    add_page_option(command, a.page);
    add_talk_options(command, a.talk);
}

ExitCode tell_end(const ActivateReport& report) {
    if (report.status == activation::Status::converged) {
        log_info("results are in " + report.output);
        return ExitCode::done;
    }
    log_error(report.message);
    log_info("lengths, moment arms and moments are in " + report.output +
             "; activations are not, since not all times have some");
    return ExitCode::not_converged;
}

ExitCode run(Arguments& a) {
    const Verbosity verbosity = a.talk.verbosity();
    set_up_log(verbosity);
    read_cost(a.cost, a.job);
    ActivateReport report;
    {
        ConsoleProgress progress(verbosity);
        report = run_activate_job(a.job, progress);
        add_page(a.job.output, a.page, progress);
    }
    for (const std::string& note : report.notes) log_detail(note);
    std::cout << (a.talk.json ? to_json(report) : to_table(report)) << std::flush;
    return tell_end(report);
}

}  // namespace

void add_activate(CLI::App& program, ExitCode& code) {
    CLI::App* command = program.add_subcommand(
        "activate", "activations of muscles from a moving skeleton: who pulls how much");
    const auto arguments = std::make_shared<Arguments>();
    add_muscle_options(*command, *arguments);
    add_run_options(*command, *arguments);
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
