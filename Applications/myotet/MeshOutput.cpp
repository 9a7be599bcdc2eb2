// SPDX-License-Identifier: Apache-2.0
#include "MeshOutput.h"

#include <algorithm>
#include <set>

#include "Core/Errors.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

std::vector<std::string> known_extensions() {
    std::vector<std::string> known;
    for (const meshfiles::Format& format : meshfiles::formats())
        known.emplace_back(format.extension.substr(1));
    return known;
}

/// Formats that hold no named faces are spared the search for them.
bool wants_named_faces(const std::vector<std::string>& extensions) {
    return std::ranges::any_of(extensions, [](const std::string& extension) {
        return extension != "vtu" && extension != "stl" && extension != "vtp";
    });
}

}  // namespace

void add_format_options(CLI::App& command, MeshFormats& formats) {
    command
        .add_option("--format", formats.extensions,
                    "formats of the meshes: vtu, msh, feb, inp, bdf, nas, xdmf, mesh; of the "
                    "surfaces: stl, ply, obj, vtp (default: vtu,stl)")
        ->delimiter(',')
        ->check(CLI::IsMember(known_extensions()))
        ->type_name("LIST");
    command.add_flag("--together", formats.together,
                     "besides, all tissues in one file a format, all.msh and so on");
    command.add_flag("--binary", formats.binary, "numbers in .msh as bytes instead of text");
}

void require_distinct_labels(const std::vector<Tissue>& tissues, const MeshFormats& formats) {
    std::set<std::int32_t> labels;
    for (const Tissue& tissue : tissues)
        if (formats.together && tissue.asked && !labels.insert(tissue.label).second)
            throw InputError("label " + std::to_string(tissue.label) +
                             " is in more than one layer, and one file cannot tell them apart; "
                             "leave --together out, or choose tissues with --labels");
}

void MeshOutput::write_tissue(TissueMesh& tissue) {
    std::map<std::int32_t, std::string> names = {{tissue.report.label, tissue.report.name}};
    const meshfiles::NamedMesh mesh =
        wants_named_faces(formats_.extensions)
            ? meshfiles::with_named_boundary(std::move(tissue.mesh), std::move(names))
            : meshfiles::NamedMesh{std::move(tissue.mesh), std::move(names), {}, {}};
    tissue.report.files =
        write(mesh, file_stem(tissue.report.layer, tissue.report.label, tissue.report.name));
    if (formats_.together) append(all_, mesh);
}

std::vector<std::string> MeshOutput::write_together() {
    return all_.mesh.tets.empty() ? std::vector<std::string>{} : write(all_, "all");
}

std::vector<std::string> MeshOutput::write(const meshfiles::NamedMesh& mesh,
                                           const std::string& stem) {
    using meshfiles::Encoding;
    std::vector<std::string> written;
    for (const std::string& extension : formats_.extensions) {
        const std::string name = stem + "." + extension;
        const std::vector<fs::path> files = meshfiles::files_of(name);
        out_.write(files.front().string(), [&](fs::path file) {
            write_mesh(mesh, file.replace_filename(name),
                       formats_.binary ? Encoding::binary : Encoding::text);
        });
        // The others were made along with the first; this tells the folder.
        for (std::size_t f = 1; f < files.size(); ++f)
            out_.write(files[f].string(), [](const fs::path&) {});
        for (const fs::path& file : files) written.push_back(file.string());
    }
    return written;
}

}  // namespace myotet::app
