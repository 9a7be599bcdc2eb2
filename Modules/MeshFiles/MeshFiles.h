// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/TetMesh.h"

#include <filesystem>
#include <map>
#include <string>

namespace myotet::meshfiles {

/// Reads a surface: .obj .off .stl .ply .vtp. Polygons become triangles,
/// points at the same place become one; coordinates are multiplied by `scale`
/// (to mm). Throws IoError when it cannot be read, InputError when it holds no
/// triangles or a coordinate that is not a number.
[[nodiscard]] TriMesh read_surface(const std::filesystem::path& file, double scale = 1);

/// True when the extension is one that read_surface knows.
[[nodiscard]] bool is_surface_file(const std::filesystem::path& file);

/// Writes .vtu: cell array `label`; field data SPACE = LPS, units = mm,
/// label_names; appended, zlib, 64-bit headers. Throws IoError.
void write_vtu(const TetMesh& mesh, const std::map<std::int32_t, std::string>& label_names,
               const std::filesystem::path& file);

/// Reads the tetrahedra of a .vtu (labels from cell array `label`, else 0).
/// Throws IoError, or InputError when there is no tetrahedron.
[[nodiscard]] TetMesh read_vtu(const std::filesystem::path& file);

/// Writes binary .stl whose header says SPACE=LPS and mm. Throws IoError.
void write_stl(const TriMesh& surface, const std::filesystem::path& file);

}  // namespace myotet::meshfiles
