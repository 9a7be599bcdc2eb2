// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace myotet::app {

/// What programs that wrap Myotet need of each subcommand: --progress and --xml.
void add_wrapping_options(CLI::App& program);

/// The words of the command line without the program's name, in their order. A link to the
/// program that is named after a subcommand (MyotetMesh, myotet-mesh) is that subcommand, as
/// programs need it that run a file without words of their own before the options. What
/// --progress says is in force from here on, for mistakes in the other words, too.
[[nodiscard]] std::vector<std::string> words_of(const CLI::App& program, int argc, char** argv);

}  // namespace myotet::app
