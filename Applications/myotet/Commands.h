// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ExitCodes.h"

namespace CLI {
class App;
}

namespace myotet::app {

/// Each adds its subcommand to the program; when the subcommand is chosen it
/// runs and leaves its exit code in `code`.
void add_activate(CLI::App& program, ExitCode& code);
void add_contract(CLI::App& program, ExitCode& code);
void add_convert(CLI::App& program, ExitCode& code);
void add_fit(CLI::App& program, ExitCode& code);
void add_inspect(CLI::App& program, ExitCode& code);
void add_levelset(CLI::App& program, ExitCode& code);
void add_mesh(CLI::App& program, ExitCode& code);
void add_phantom(CLI::App& program, ExitCode& code);
void add_play(CLI::App& program, ExitCode& code);
void add_press(CLI::App& program, ExitCode& code);
void add_quality(CLI::App& program, ExitCode& code);
void add_report(CLI::App& program, ExitCode& code);
void add_surface(CLI::App& program, ExitCode& code);

}  // namespace myotet::app
