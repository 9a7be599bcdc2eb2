// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "Core/TetMesh.h"

namespace myotet::meshfiles {

/// Reads a surface: .obj .off .stl .ply .vtp. Polygons become fans of
/// triangles, points at exactly the same place become one, triangles with two
/// corners at one place and points that no triangle uses are left out.
/// Coordinates are multiplied by `scale` (to mm); a file that says SPACE=RAS
/// is turned to LPS, any other is taken as LPS.
/// Throws IoError when it cannot be read or is cut short, InputError when it
/// holds no triangles, a coordinate that is not a number or an index out of
/// range.
[[nodiscard]] TriMesh read_surface(const std::filesystem::path& file, double scale = 1);

/// True when the extension is one that read_surface knows.
[[nodiscard]] bool is_surface_file(const std::filesystem::path& file);

/// Writes .vtu: cell array `label`; field data SPACE = LPS, units = mm,
/// label_names (one text `value=name` a label, by value); appended, zlib,
/// 64-bit headers. The bytes depend on the arguments alone. Throws IoError.
void write_vtu(const TetMesh& mesh, const std::map<std::int32_t, std::string>& label_names,
               const std::filesystem::path& file);

/// Writes .vtp: triangles; field data and form as write_vtu. Throws IoError.
void write_vtp(const TriMesh& surface, const std::map<std::int32_t, std::string>& label_names,
               const std::filesystem::path& file);

/// Reads the tetrahedra of a .vtu (labels from cell array `label`, else 0).
/// Throws IoError, or InputError when there is no tetrahedron.
[[nodiscard]] TetMesh read_vtu(const std::filesystem::path& file);

/// Writes binary .stl whose header says SPACE=LPS and UNIT=mm; coordinates
/// become 32-bit numbers. Throws IoError.
void write_stl(const TriMesh& surface, const std::filesystem::path& file);

}  // namespace myotet::meshfiles
