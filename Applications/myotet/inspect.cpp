// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"
#include "Core/Parallel.h"
#include "InspectReport.h"

namespace myotet::app {
namespace {

struct Arguments {
    std::filesystem::path labels;
    segmentation::ReadOptions reading;
    int threads = 0;
    bool json = false;
};

ExitCode run(const Arguments& a) {
    const ThreadLimit limit(a.threads);
    const InspectReport report = inspect_file(a.labels, a.reading);
    for (const std::string& warning : report.warnings) log_warning(warning);
    std::cout << (a.json ? to_json(report) : to_text(report)) << std::flush;
    return ExitCode::done;
}

}  // namespace

void add_inspect(CLI::App& program, ExitCode& code) {
    CLI::App* command = program.add_subcommand(
        "inspect", "what a label file holds, and what meshing it by default would change");
    const auto arguments = std::make_shared<Arguments>();
    command->add_option("LABELS", arguments->labels, "label file")->required()->type_name("FILE");
    add_read_options(*command, arguments->reading);
    command->add_option("--threads", arguments->threads, "threads to use (default: all there are)")
        ->check(CLI::Range(1, 4096))
        ->type_name("N");
    command->add_flag("--json", arguments->json, "print JSON instead of text");
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
