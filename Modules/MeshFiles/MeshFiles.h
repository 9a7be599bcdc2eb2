// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "MeshFiles/NamedMesh.h"

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

/// Numbers at points or at tetrahedra.
struct NamedArray {
    std::string name;
    int components = 1;          ///< of each; 3: a vector, 9: a tensor row by row
    std::vector<double> values;  ///< components of the first, then of the second, ...
};

/// What a .vtu tells besides its mesh, such as one moment of a simulation.
struct MeshArrays {
    std::vector<NamedArray> points;  ///< at mesh.points
    std::vector<NamedArray> cells;   ///< at mesh.tets
    std::optional<double> time;      ///< field data TimeValue, s
};

/// The same with more arrays, as 64-bit numbers and in their order, after `label`.
/// Throws MeshError when an array has no name or another's, has not one value a
/// component, or holds a number that is not finite; IoError.
void write_vtu(const TetMesh& mesh, const std::map<std::int32_t, std::string>& label_names,
               const MeshArrays& arrays, const std::filesystem::path& file);

/// Triangles in a .vtu, as of a membrane in motion; arrays.cells are at the triangles. The
/// rest as for tetrahedra, but there is no array `label` unless it is given. Throws the same.
void write_vtu(const TriMesh& surface, const std::map<std::int32_t, std::string>& label_names,
               const MeshArrays& arrays, const std::filesystem::path& file);

/// Writes .vtp: triangles; field data and form as write_vtu. Throws IoError.
void write_vtp(const TriMesh& surface, const std::map<std::int32_t, std::string>& label_names,
               const std::filesystem::path& file);

/// Reads the tetrahedra of a .vtu (labels from cell array `label`, else 0).
/// Throws IoError, or InputError when there is no tetrahedron.
[[nodiscard]] TetMesh read_vtu(const std::filesystem::path& file);

/// Writes binary .stl whose header says SPACE=LPS and UNIT=mm; coordinates
/// become 32-bit numbers. Throws IoError.
void write_stl(const TriMesh& surface, const std::filesystem::path& file);

/// Writes binary legacy .vtk, polydata, whose title says SPACE=LPS and UNIT=mm;
/// coordinates are 64-bit numbers. Throws IoError.
void write_vtk(const TriMesh& surface, const std::filesystem::path& file);

/// What a format can hold.
enum class Holds { tetrahedra, surface };
struct Format {
    std::string_view extension;  ///< with its dot, small letters
    Holds holds = Holds::tetrahedra;
};

/// The formats that write_mesh writes, and read_mesh reads.
[[nodiscard]] std::span<const Format> formats();

/// How .msh holds its numbers; the other formats know one way only.
enum class Encoding { text, binary };

/// Reads a mesh with its names by its extension: those of formats(), and .off.
/// Tetrahedra and points are numbered as the file numbers them. Tissues that a
/// file does not number are labelled 1, 2, ... in its order; of a mesh file
/// that tells faces' names but no tags, `A|exterior` gets kExteriorTag + A and
/// the others follow. A surface file becomes face sets without tetrahedra. A
/// file that says SPACE=RAS is turned to LPS, any other is taken as LPS, mm.
/// Throws IoError when it cannot be read or is cut short, InputError when it
/// is damaged (with the line where there is one), holds no tetrahedra or
/// elements of another kind, ResourceError beyond 32-bit indices.
[[nodiscard]] NamedMesh read_mesh(const std::filesystem::path& file);

/// Writes a mesh by the file's extension, one of formats(). Surface formats
/// get the face sets (.ply, .obj) or the boundary (.stl, .vtp). Names, face
/// sets and node sets are kept as the README's table says. The bytes depend on
/// the arguments alone. Throws InputError for an unknown extension and for a
/// surface in a format of tetrahedra, MeshError for labels, tags or names that
/// the format cannot hold, IoError.
void write_mesh(const NamedMesh& mesh, const std::filesystem::path& file,
                Encoding encoding = Encoding::text);

/// The files that write_mesh makes: the file itself, for .xdmf its .h5 first.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const std::filesystem::path& file);

}  // namespace myotet::meshfiles
