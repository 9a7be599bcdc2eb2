// SPDX-License-Identifier: Apache-2.0
#include "Wrapped.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>

#include "CommandLine.h"
#include "Console.h"
#include "Core/Text.h"
#include "SlicerModule.h"

namespace myotet::app {
namespace {

const std::map<std::string, Telling>& tellings() {
    static const std::map<std::string, Telling> table = {
        {"text", Telling::text}, {"json", Telling::json}, {"slicer", Telling::slicer}};
    return table;
}

// The subcommand that a link is named after; empty when it is named otherwise.
std::string command_of(const CLI::App& program, const std::string& called) {
    const std::string name = lower(std::filesystem::path(called).filename().string());
    if (!name.starts_with("myotet")) return "";
    const std::string rest = name.substr(name.starts_with("myotet-") ? 7 : 6);
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
        if (command->get_name() == rest) return rest;
    return "";
}

void hear_telling(const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        std::string said;
        if (words[i].starts_with("--progress=")) said = words[i].substr(11);
        if (words[i] == "--progress" && i + 1 < words.size()) said = words[i + 1];
        if (const auto found = tellings().find(said); found != tellings().end())
            set_telling(found->second);
    }
}

}  // namespace

void add_wrapping_options(CLI::App& program) {
    for (CLI::App* command : program.get_subcommands([](CLI::App*) { return true; })) {
        command
            ->add_option_function<Telling>(
                "--progress", [](const Telling& telling) { set_telling(telling); },
                "how progress and log are told: text; json, an object a line on stderr, for "
                "programs; slicer, its tags on stdout (default: text)")
            ->transform(one_of(tellings()))
            ->type_name("KIND");
        command->add_flag_callback(
            "--xml", [command] { throw CLI::CallForVersion(slicer_description(*command), 0); },
            "print this command's description as a module of 3D Slicer, and end");
    }
}

std::vector<std::string> words_of(const CLI::App& program, int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (const std::string command = command_of(program, argv[0]); !command.empty())
        words.insert(words.begin(), command);
    hear_telling(words);
    return words;
}

}  // namespace myotet::app
