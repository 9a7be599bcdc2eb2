// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"
#include "ReportJob.h"

namespace myotet::app {
namespace {

struct Arguments {
    ReportJobOptions job;
    bool quiet = false;
};

ExitCode run(const Arguments& a) {
    const Verbosity verbosity = a.quiet ? Verbosity::quiet : Verbosity::normal;
    set_up_log(verbosity);
    {
        ConsoleProgress progress(verbosity);
        run_report_job(a.job, progress);
    }
    log_info("the page is " + (a.job.folder / kPageFile).string());
    return ExitCode::done;
}

}  // namespace

void add_report(CLI::App& program, ExitCode& code) {
    CLI::App* command = program.add_subcommand(
        "report", "one page, report.html, that shows what a folder of results holds");
    const auto arguments = std::make_shared<Arguments>();
    command
        ->add_option("FOLDER", arguments->job.folder,
                     "results of mesh, contract, press or activate")
        ->required()
        ->type_name("FOLDER");
    command->add_flag("--png", arguments->job.png,
                      "besides, pictures/*.png of the whole and of each tissue, cut and uncut");
    command->add_flag("--quiet", arguments->quiet, "say nothing but errors");
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
