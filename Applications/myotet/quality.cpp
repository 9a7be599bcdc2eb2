// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "CommandLine.h"
#include "Commands.h"
#include "Console.h"
#include "MeshFiles/MeshFiles.h"
#include "QualityReport.h"

namespace myotet::app {
namespace {

struct Arguments {
    std::filesystem::path mesh;
    bool json = false;
};

ExitCode run(const Arguments& a) {
    const QualityReport report = measure(meshfiles::read_mesh(a.mesh));
    std::cout << (a.json ? to_json(a.mesh.string(), report) : to_table(report)) << std::flush;
    ExitCode code = ExitCode::done;
    const auto tell = [&](const std::string& what, const std::vector<std::string>& broken) {
        for (const std::string& sentence : broken) {
            log_error(a.mesh.string() + ": " + what + ": " + sentence);
            code = ExitCode::broken_promise;
        }
    };
    for (const TissueReport& tissue : report.tissues)
        tell("label " + std::to_string(tissue.label), tissue.broken_promises);
    for (const FacesReport& faces : report.faces) tell(faces.name, faces.broken_promises);
    return code;
}

}  // namespace

void add_quality(CLI::App& program, ExitCode& code) {
    CLI::App* command = program.add_subcommand(
        "quality", "angles, aspect ratios and topology of a mesh or surface");
    const auto arguments = std::make_shared<Arguments>();
    command
        ->add_option("MESH", arguments->mesh,
                     "mesh (.vtu .msh .feb .inp .bdf .nas .xdmf .mesh) or surface (.stl .ply .obj "
                     ".vtp .off)")
        ->required()
        ->type_name("FILE");
    command->add_flag("--json", arguments->json, "print JSON instead of the table");
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
