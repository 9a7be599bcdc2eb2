// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace myotet::app {

/// A subcommand as a command-line module of 3D Slicer: the description that `--xml` prints, made
/// from the options' own names and help. Files, folders and flags are what they are; an option
/// of a few words whose help names the one it defaults to is a choice; each other is a text that
/// may stay empty, since what it defaults to depends on the input. The labels of `mesh`,
/// `levelset`, `surface` and `inspect` are chosen among the label volumes of the scene.
/// Source: Slicer Execution Model; what Slicer makes of each tag, its vtkSlicerCLIModuleLogic.
[[nodiscard]] std::string slicer_description(const CLI::App& command);

}  // namespace myotet::app
