// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iostream>

#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"
#include "Interrupt.h"
#include "Wrapped.h"

using namespace myotet::app;

int main(int argc, char** argv) {
    set_up_log(Verbosity::normal);
    watch_signals();
    ExitCode code = ExitCode::done;
    CLI::App program("Myotet makes simulation-ready tissue meshes from labelled scans.", "myotet");
    program.set_version_flag("--version", "myotet " MYOTET_VERSION);
    program.require_subcommand(1);
    program.footer(
        "Lengths are millimetres. Exit codes: 0 done, 2 usage, 3 bad input, 4 a mesh\n"
        "breaks a promise, 5 not converged, 6 out of a resource, 130 interrupted.");
    try {
        add_activate(program, code);
        add_contract(program, code);
        add_convert(program, code);
        add_fit(program, code);
        add_inspect(program, code);
        add_levelset(program, code);
        add_mesh(program, code);
        add_phantom(program, code);
        add_play(program, code);
        add_press(program, code);
        add_quality(program, code);
        add_report(program, code);
        add_surface(program, code);
        add_wrapping_options(program);
        std::vector<std::string> words = words_of(program, argc, argv);
        std::ranges::reverse(words);  // as CLI11 takes them
        program.parse(std::move(words));
    } catch (const CLI::Success& asked) {  // --help, --version
        return program.exit(asked);
    } catch (const CLI::ParseError& error) {
        log_error(std::string(error.what()) + "; see myotet --help");
        code = ExitCode::usage;
    } catch (...) {
        const Ending ending = ending_for(std::current_exception());
        log_error(ending.sentence);
        code = ending.code;
    }
    log_end(static_cast<int>(code));
    return static_cast<int>(code);
}
