// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>

#include "CommandLine.h"
#include "Commands.h"
#include "Outputs.h"
#include "Phantoms/Phantoms.h"
#include "Segmentation/NameTable.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::app {
namespace {

struct Arguments {
    std::string name;
    std::filesystem::path file;
    std::vector<double> spacing;
};

std::string list_of_phantoms() {
    std::string list = "Phantoms:";
    for (const std::string_view name : phantoms::phantom_names())
        list += "\n  " + std::string(name) + ": " + std::string(phantoms::describe_phantom(name));
    return list;
}

/// FILE without its extension, with "_labels.txt": where read_labels looks.
std::string table_name(const std::string& file) {
    for (const std::string extension : {".nii.gz", ".nii", ".nrrd", ".mha"})
        if (file.ends_with(extension))
            return file.substr(0, file.size() - extension.size()) + "_labels.txt";
    return file + "_labels.txt";
}

ExitCode run(const Arguments& a) {
    const Vec3 spacing =
        a.spacing.empty() ? Vec3(Vec3::Zero()) : Vec3(a.spacing[0], a.spacing[1], a.spacing[2]);
    OutputFolder out(a.file.has_parent_path() ? a.file.parent_path() : ".");
    const phantoms::Phantom phantom = phantoms::make_phantom(a.name, spacing);
    const std::string table = table_name(a.file.filename().string());
    out.write(a.file.filename().string(), [&](const std::filesystem::path& file) {
        segmentation::write_labels(phantom.volume, file);
    });
    out.write(table, [&](const std::filesystem::path& file) {
        segmentation::write_name_table(phantom.volume.names, file);
    });
    out.keep();
    std::cout << "wrote " << a.file.string() << " and " << (a.file.parent_path() / table).string()
              << std::endl;
    return ExitCode::done;
}

}  // namespace

void add_phantom(CLI::App& program, ExitCode& code) {
    CLI::App* command =
        program.add_subcommand("phantom", "a labelled scan of which the truth is known");
    const auto arguments = std::make_shared<Arguments>();
    command->add_option("NAME", arguments->name, "which phantom, see below")
        ->required()
        ->type_name("");
    command
        ->add_option("-o,--output", arguments->file,
                     "label file (.nii.gz .nii .nrrd .mha); the table of names goes beside it")
        ->required()
        ->type_name("FILE");
    command
        ->add_option("--spacing", arguments->spacing, "voxel size, mm (default: the phantom's own)")
        ->delimiter(',')
        ->expected(3)
        ->check(kPositive)
        ->type_name("X,Y,Z");
    command->footer(list_of_phantoms());
    command->callback([arguments, &code] { code = run(*arguments); });
}

}  // namespace myotet::app
