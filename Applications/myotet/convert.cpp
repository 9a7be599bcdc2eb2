// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "CommandLine.h"
#include "Commands.h"
#include "MeshFiles/MeshFiles.h"
#include "Outputs.h"
#include "Text.h"

namespace myotet::app {
namespace {

namespace fs = std::filesystem;

struct Arguments {
    fs::path mesh, output;
    bool binary = false;
};

/// What a file does not name is named by neighbour.
void name_boundary(meshfiles::NamedMesh& mesh) {
    if (mesh.faces.empty()) mesh.faces = meshfiles::faces_by_neighbour(mesh.mesh, mesh.names);
    if (mesh.nodes.empty()) mesh.nodes = meshfiles::nodes_of_faces(mesh.faces);
}

ExitCode run(const Arguments& a) {
    using meshfiles::Encoding;
    OutputFolder out(a.output.has_parent_path() ? a.output.parent_path() : ".");
    meshfiles::NamedMesh mesh = meshfiles::read_mesh(a.mesh);
    name_boundary(mesh);
    out.write(a.output.filename().string(), [&](const fs::path& file) {
        write_mesh(mesh, file, a.binary ? Encoding::binary : Encoding::text);
    });
    out.keep();
    for (const fs::path& file : meshfiles::files_of(a.output))
        std::cout << "wrote " << file.string() << "\n";
    const auto count = [](const auto& list) { return static_cast<std::int64_t>(list.size()); };
    std::cout << mesh.mesh.tets.size() << " tetrahedra, "
              << counted(count(meshfiles::tets_by_label(mesh.mesh)), "tissue") << ", "
              << counted(count(mesh.faces), "face set") << std::endl;
    return ExitCode::done;
}

}  // namespace

void add_convert(CLI::App& program, ExitCode& code) {
    CLI::App* command = program.add_subcommand("convert", "a mesh in another format");
    const auto arguments = std::make_shared<Arguments>();
    command
        ->add_option("MESH", arguments->mesh,
                     "mesh (.vtu .msh .feb .inp .bdf .nas .xdmf .mesh) or surface (.stl .ply .obj "
                     ".vtp .off)")
        ->required()
        ->type_name("FILE");
    command
        ->add_option("-o,--output", arguments->output,
                     "file to write; its extension, one of those above but .off, says the format")
        ->required()
        ->type_name("FILE");
    command->add_flag("--binary", arguments->binary, "numbers in .msh as bytes instead of text");
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
