// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "MeshFiles/MeshFiles.h"
#include "MeshFiles/RawMesh.h"

namespace myotet::meshfiles {
namespace fs = std::filesystem;

namespace {

using Parse = RawMesh (*)(std::string_view, const fs::path&);
using Compose = std::string (*)(const NamedMesh&);

/// The formats of one file that one function parses, and most of which one composes.
struct Plain {
    std::string_view extension;
    Parse parse;
    Compose text = nullptr;
    Compose binary = nullptr;
};
constexpr Plain kPlain[] = {{".msh", parse_gmsh, gmsh_text, gmsh_binary},
                            {".feb", parse_febio, febio_text},
                            {".inp", parse_abaqus, abaqus_text},
                            {".bdf", parse_nastran, nastran_text},
                            {".nas", parse_nastran, nastran_text},
                            {".mesh", parse_medit, medit_text},
                            {".vtu", parse_vtu},
                            {".xdmf", parse_xdmf}};

const Plain* plain_format(const std::string& extension) {
    const auto found = std::ranges::find(kPlain, extension, &Plain::extension);
    return found == std::end(kPlain) ? nullptr : found;
}

const Format* format_of(const std::string& extension) {
    const auto& all = formats();
    const auto found = std::ranges::find(all, extension, &Format::extension);
    return found == all.end() ? nullptr : &*found;
}

void refuse_control_characters(const std::string& name) {
    const auto control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
    if (std::ranges::any_of(name, control))
        throw MeshError("the name '" + name +
                        "' holds a line break or another control character, which no mesh format "
                        "takes; rename it");
}

void check(const NamedMesh& mesh, const fs::path& file) {
    if (!mesh.mesh.labels.empty() && mesh.mesh.labels.size() != mesh.mesh.tets.size())
        throw MeshError(file.string() + ": the mesh has " +
                        std::to_string(mesh.mesh.labels.size()) + " labels for " +
                        std::to_string(mesh.mesh.tets.size()) +
                        " tetrahedra; give one label each or none");
    for (const auto& [label, name] : mesh.names) refuse_control_characters(name);
    for (const FaceSet& set : mesh.faces) refuse_control_characters(set.name);
    for (const NodeSet& set : mesh.nodes) refuse_control_characters(set.name);
}

std::string list_of_extensions() {
    std::string list;
    for (const Format& format : formats()) list += " " + std::string(format.extension);
    return list;
}

}  // namespace

std::string lower_extension(const fs::path& file) {
    std::string extension = file.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return std::tolower(c); });
    return extension;
}

std::string read_bytes(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream content;
    content << in.rdbuf();
    if (!in || fs::is_directory(file))
        throw IoError(file.string() + ": cannot be read; check its name and permissions");
    return std::move(content).str();
}

std::span<const Format> formats() {
    static constexpr Format kAll[] = {
        {".vtu", Holds::tetrahedra},  {".msh", Holds::tetrahedra},  {".feb", Holds::tetrahedra},
        {".inp", Holds::tetrahedra},  {".bdf", Holds::tetrahedra},  {".nas", Holds::tetrahedra},
        {".xdmf", Holds::tetrahedra}, {".mesh", Holds::tetrahedra}, {".stl", Holds::surface},
        {".ply", Holds::surface},     {".obj", Holds::surface},     {".vtp", Holds::surface}};
    return kAll;
}

std::vector<fs::path> files_of(const fs::path& file) {
    if (lower_extension(file) != ".xdmf") return {file};
    fs::path heavy = file;
    return {heavy.replace_extension(".h5"), file};
}

NamedMesh read_mesh(const fs::path& file) {
    const std::string extension = lower_extension(file);
    if (is_surface_file(file)) return read_named_surface(file);
    const Plain* plain = plain_format(extension);
    if (!plain)
        throw InputError(file.string() + ": '" + extension +
                         "' is no mesh format that is read; use one of .off" +
                         list_of_extensions());
    const std::string content = read_bytes(file);
    if (content.empty()) throw InputError(file.string() + ": is empty; a mesh is needed");
    return checked(plain->parse(content, file), file);
}

TetMesh read_vtu(const fs::path& file) {
    return checked(parse_vtu(read_bytes(file), file), file).mesh;
}

void write_mesh(const NamedMesh& mesh, const fs::path& file, Encoding encoding) {
    const std::string extension = lower_extension(file);
    const Format* format = format_of(extension);
    if (!format)
        throw InputError(file.string() + ": '" + extension +
                         "' is no mesh format that is written; use one of" + list_of_extensions());
    check(mesh, file);
    if (format->holds == Holds::tetrahedra && mesh.mesh.tets.empty())
        throw InputError(file.string() + ": " + extension +
                         " holds tetrahedra, but the mesh is a surface; mesh it first");
    if (const Plain* plain = plain_format(extension); plain && plain->text)
        return write_atomically(
            file,
            (encoding == Encoding::binary && plain->binary ? plain->binary : plain->text)(mesh));
    if (extension == ".vtu") return write_vtu(mesh.mesh, mesh.names, file);
    if (extension == ".xdmf") return write_xdmf(mesh, file);
    if (extension == ".ply") return write_atomically(file, ply_bytes(mesh));
    if (extension == ".obj") return write_atomically(file, obj_text(mesh));
    const TriMesh surface =
        mesh.mesh.tets.empty() ? tagged_surface(mesh).surface : boundary_surface(mesh.mesh);
    if (extension == ".stl") return write_stl(surface, file);
    write_vtp(surface, mesh.names, file);
}

}  // namespace myotet::meshfiles
