// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"
#include "MeshFiles/MeshFiles.h"
#include "ReportText.h"

namespace myotet::app {
namespace {

struct Arguments {
    std::filesystem::path mesh;
    bool json = false;
};

ExitCode run(const Arguments& a) {
    const TetMesh mesh = meshfiles::read_vtu(a.mesh);
    const std::vector<TissueReport> tissues = measure_tissues(mesh);
    std::cout << (a.json ? quality_json(a.mesh.string(), tissues) : quality_table(tissues))
              << std::flush;
    ExitCode code = ExitCode::done;
    for (const TissueReport& tissue : tissues)
        for (const std::string& sentence : tissue.broken_promises) {
            log_error(a.mesh.string() + ": label " + std::to_string(tissue.label) + ": " +
                      sentence);
            code = ExitCode::broken_promise;
        }
    return code;
}

}  // namespace

void add_quality(CLI::App& program, ExitCode& code) {
    CLI::App* command =
        program.add_subcommand("quality", "angles, aspect ratios and topology of a mesh");
    const auto arguments = std::make_shared<Arguments>();
    command->add_option("MESH", arguments->mesh, "tetrahedral mesh (.vtu)")
        ->required()
        ->type_name("FILE");
    command->add_flag("--json", arguments->json, "print JSON instead of the table");
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
