// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "MeshFiles/MeshFiles.h"
#include "Outputs.h"
#include "TissueMesh.h"

namespace myotet::app {

/// In which formats meshes are written.
struct MeshFormats {
    std::vector<std::string> extensions = {"vtu", "stl"};  ///< without dot
    bool together = false;  ///< besides, all tissues in one file a format
    bool binary = false;    ///< .msh holds bytes instead of text
};

/// --format, --together and --binary.
void add_format_options(CLI::App& command, MeshFormats& formats);

/// Throws InputError when all tissues are to stand in one file but two of them,
/// of different layers, have the same label value.
void require_distinct_labels(const std::vector<Tissue>& tissues, const MeshFormats& formats);

/// Writes meshes in the formats asked for.
class MeshOutput {
public:
    MeshOutput(const MeshFormats& formats, OutputFolder& out) : formats_(formats), out_(out) {}

    /// Writes the tissue's mesh in each format and notes the files' names;
    /// takes the mesh.
    void write_tissue(TissueMesh& tissue);
    /// Writes `all.<extension>` when together was asked for and there is a
    /// tissue; the names of the files.
    std::vector<std::string> write_together();

private:
    std::vector<std::string> write(const meshfiles::NamedMesh& mesh, const std::string& stem);

    const MeshFormats& formats_;
    OutputFolder& out_;
    meshfiles::NamedMesh all_;
};

}  // namespace myotet::app
