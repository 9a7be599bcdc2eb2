// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "MeshFiles/NamedMesh.h"

namespace myotet::meshfiles {

/// A mesh as its file says it: nodes by the file's own numbers, unchecked.
struct RawMesh {
    struct Faces {
        std::string name;
        std::int64_t tag = 0;
        std::vector<std::array<std::int64_t, 3>> triangles;
    };
    struct Nodes {
        std::string name;
        std::vector<std::int64_t> nodes;
    };
    std::vector<Vec3> points;
    std::vector<std::int64_t> ids;  ///< the points' numbers
    std::vector<std::array<std::int64_t, 4>> tets;
    std::vector<std::int64_t> labels, tet_ids;  ///< one a tetrahedron
    std::map<std::int64_t, std::string> names;
    std::vector<Faces> faces;
    std::vector<Nodes> nodes;
    std::string space;  ///< patient frame that the file names (LPS, RAS), or empty

    void reserve(std::size_t more_points, std::size_t more_tets) {
        ids.reserve(ids.size() + more_points);
        points.reserve(points.size() + more_points);
        tet_ids.reserve(tet_ids.size() + more_tets);
        labels.reserve(labels.size() + more_tets);
        tets.reserve(tets.size() + more_tets);
    }
    void add_point(std::int64_t id, const Vec3& p) {
        ids.push_back(id);
        points.push_back(p);
    }
    void add_tet(std::int64_t id, std::int64_t label, const std::array<std::int64_t, 4>& corners) {
        tet_ids.push_back(id);
        labels.push_back(label);
        tets.push_back(corners);
    }
    /// The face set of this tag; a new one when there is none.
    Faces& faces_tagged(std::int64_t tag);
};

/// Numbers points from 0 and sorts tetrahedra in the order of their ids, turns
/// RAS to LPS, gives face sets of tag 0 the tags of faces_by_neighbour, and
/// checks everything: throws InputError for a coordinate that is not finite, a
/// number given twice or not at all, a label or tag beyond 32 bits, no
/// tetrahedron; ResourceError for more points than 32-bit indices hold.
[[nodiscard]] NamedMesh checked(RawMesh&& raw, const std::filesystem::path& file);

/// A whole file. Throws IoError.
[[nodiscard]] std::string read_bytes(const std::filesystem::path& file);

/// The extension in small letters, with its dot.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& file);

/// The line, from 1, of a place in a text.
[[nodiscard]] std::size_t line_at(std::string_view content, std::ptrdiff_t offset);

/// `7=biceps` as label and name; false when the text is not such.
bool parse_value_name(std::string_view text, std::int64_t& value, std::string& name);

/// Throws MeshError unless every label and face tag is above 0, as `format` wants it.
void require_positive_numbers(const NamedMesh& mesh, std::string_view format);

/// Each takes the whole content of a file; `file` is for messages.
[[nodiscard]] RawMesh parse_gmsh(std::string_view content, const std::filesystem::path& file);
[[nodiscard]] RawMesh parse_febio(std::string_view content, const std::filesystem::path& file);
[[nodiscard]] RawMesh parse_abaqus(std::string_view content, const std::filesystem::path& file);
[[nodiscard]] RawMesh parse_nastran(std::string_view content, const std::filesystem::path& file);
[[nodiscard]] RawMesh parse_medit(std::string_view content, const std::filesystem::path& file);
[[nodiscard]] RawMesh parse_vtu(std::string_view content, const std::filesystem::path& file);
[[nodiscard]] RawMesh parse_xdmf(std::string_view content, const std::filesystem::path& file);

/// Abaqus knows no end of a file: this is the last line of ours, so that one
/// that is cut short can be told.
inline constexpr std::string_view kAbaqusEnd = "** end of mesh";

/// The content of a file for a mesh.
[[nodiscard]] std::string gmsh_text(const NamedMesh& mesh);
[[nodiscard]] std::string gmsh_binary(const NamedMesh& mesh);
[[nodiscard]] std::string febio_text(const NamedMesh& mesh);
[[nodiscard]] std::string abaqus_text(const NamedMesh& mesh);
[[nodiscard]] std::string nastran_text(const NamedMesh& mesh);
[[nodiscard]] std::string medit_text(const NamedMesh& mesh);
[[nodiscard]] std::string ply_bytes(const NamedMesh& mesh);
[[nodiscard]] std::string obj_text(const NamedMesh& mesh);
/// The triangles of all face sets, or the boundary of a mesh that has none, as
/// a surface of their own, and the tag of each.
struct TaggedSurface {
    TriMesh surface;
    std::vector<std::int32_t> tags;
    std::map<std::int32_t, std::string> names;  ///< by tag
};
[[nodiscard]] TaggedSurface tagged_surface(const NamedMesh& mesh);

/// A surface file as face sets without tetrahedra.
[[nodiscard]] NamedMesh read_named_surface(const std::filesystem::path& file);

/// Writes both files: the .xdmf and, beside it, the .h5.
void write_xdmf(const NamedMesh& mesh, const std::filesystem::path& file);

}  // namespace myotet::meshfiles
