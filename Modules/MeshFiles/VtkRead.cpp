// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <pugixml.hpp>

#include "MeshFiles/Numbers.h"
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/RawSurface.h"
#include "MeshFiles/VtkFile.h"
#include "MeshFiles/VtuArrays.h"

namespace myotet::meshfiles {
namespace {

/// Lists of point numbers that follow one another.
struct Cells {
    std::vector<std::int64_t> corners, ends;
    [[nodiscard]] std::span<const std::int64_t> of(std::size_t cell) const {
        const std::int64_t begin = cell == 0 ? 0 : ends[cell - 1];
        return std::span(corners).subspan(static_cast<std::size_t>(begin),
                                          static_cast<std::size_t>(ends[cell] - begin));
    }
};

/// `points`: how many the cells can name.
Cells cells_of(const VtkFile& vtk, const pugi::xml_node& holder, std::int64_t count,
               std::int64_t points) {
    if (count == 0) return {};
    Cells cells{vtk.integers(vtk.array(holder, "connectivity")),
                vtk.integers(vtk.array(holder, "offsets"))};
    vtk.require(holder, static_cast<std::int64_t>(cells.ends.size()) == count,
                "has not one offset a cell");
    const auto corners = static_cast<std::int64_t>(cells.corners.size());
    std::int64_t before = 0;
    for (const std::int64_t end : cells.ends) {
        vtk.require(holder, end >= before && end <= corners,
                    "has cells that point past their own list");
        before = end;
    }
    for (const std::int64_t corner : cells.corners)
        if (corner < 0 || corner >= points)
            vtk.refuse(holder, "names point " + std::to_string(corner) + ", but there are " +
                                   std::to_string(points));
    return cells;
}

std::vector<Vec3> points_of(const VtkFile& vtk, const pugi::xml_node& piece) {
    const auto count = static_cast<std::size_t>(vtk.number(piece, "NumberOfPoints"));
    if (count == 0) return {};
    const auto numbers = vtk.reals(piece.child("Points").find_child(VtkFile::is_array));
    vtk.require(piece, numbers.size() / 3 == count && numbers.size() % 3 == 0,
                "has not three coordinates a point");
    std::vector<Vec3> points(count);
    for (std::size_t p = 0; p < count; ++p)
        points[p] = {numbers[3 * p], numbers[3 * p + 1], numbers[3 * p + 2]};
    return points;
}

/// Cell array `label`, its first component; zeros when there is none.
std::vector<std::int64_t> labels_of(const VtkFile& vtk, const pugi::xml_node& piece,
                                    std::size_t count) {
    std::vector<std::int64_t> labels(count, 0);
    const pugi::xml_node array = VtkFile::find(piece.child("CellData"), "label");
    if (!array || count == 0) return labels;
    const auto numbers = vtk.reals(array);
    vtk.require(array, !numbers.empty() && numbers.size() % count == 0, "has not one label a cell");
    for (std::size_t c = 0; c < count; ++c) {
        const double label = numbers[c * (numbers.size() / count)];
        if (!(std::abs(label) <= std::numeric_limits<std::int32_t>::max()) ||
            label != std::floor(label))
            vtk.refuse(array, "holds " + std::to_string(label) + ", which is no label of 32 bits");
        labels[c] = static_cast<std::int64_t>(label);
    }
    return labels;
}

/// VTK's numbers of cell types: vtkCellType.h.
constexpr std::int64_t kTetrahedron = 10;
bool is_solid(std::int64_t type) {
    constexpr std::int64_t kFlat[] = {21, 22, 23, 28, 30, 34, 35, 36,  // quadratic
                                      51, 52, 60, 61, 62, 68, 69, 70, 75, 76, 77};
    return type > 9 && std::ranges::find(kFlat, type) == std::end(kFlat);
}

void read_piece(const VtkFile& vtk, const pugi::xml_node& piece, RawMesh& mesh) {
    const auto first = static_cast<std::int64_t>(mesh.points.size());
    const auto points = points_of(vtk, piece);
    mesh.reserve(points.size(), 0);
    for (const Vec3& p : points) mesh.add_point(static_cast<std::int64_t>(mesh.points.size()), p);
    const std::int64_t count = vtk.number(piece, "NumberOfCells");
    const pugi::xml_node holder = piece.child("Cells");
    const Cells cells = cells_of(vtk, holder, count, static_cast<std::int64_t>(points.size()));
    const auto types =
        count == 0 ? std::vector<std::int64_t>{} : vtk.integers(vtk.array(holder, "types"));
    vtk.require(holder, types.size() == cells.ends.size(), "has not one type a cell");
    const auto labels = labels_of(vtk, piece, types.size());
    mesh.reserve(0, types.size());
    for (std::size_t c = 0; c < types.size(); ++c) {
        const auto corners = cells.of(c);
        const bool tetrahedron = types[c] == kTetrahedron && corners.size() == 4;
        if (!tetrahedron && is_solid(types[c]))
            vtk.refuse(holder, "holds a cell of VTK's type " + std::to_string(types[c]) + " with " +
                                   std::to_string(corners.size()) +
                                   " points, but of solids only tetrahedra of four are read");
        if (tetrahedron)
            mesh.add_tet(
                static_cast<std::int64_t>(mesh.tets.size()), labels[c],
                {first + corners[0], first + corners[1], first + corners[2], first + corners[3]});
    }
}

void read_piece(const VtkFile& vtk, const pugi::xml_node& piece, RawSurface& surface) {
    const auto first = static_cast<std::int64_t>(surface.points.size());
    const auto points = points_of(vtk, piece);
    surface.points.insert(surface.points.end(), points.begin(), points.end());
    const auto cells = [&](const char* tag, const char* count) {
        Cells found = cells_of(vtk, piece.child(tag), vtk.number(piece, count, 0),
                               static_cast<std::int64_t>(points.size()));
        for (std::int64_t& corner : found.corners) corner += first;
        return found;
    };
    const Cells polygons = cells("Polys", "NumberOfPolys");
    for (std::size_t c = 0; c < polygons.ends.size(); ++c) surface.add_polygon(polygons.of(c));
    const Cells strips = cells("Strips", "NumberOfStrips");
    for (std::size_t c = 0; c < strips.ends.size(); ++c) {
        const auto strip = strips.of(c);
        for (std::size_t i = 2; i < strip.size(); ++i)  // every other triangle is turned
            surface.triangles.push_back({strip[i - 2 + i % 2], strip[i - 1 - i % 2], strip[i]});
    }
}

/// Numbers of all arrays of a piece's points or cells but the labels; texts are passed over.
std::vector<NamedArray> arrays_of(const VtkFile& vtk, const pugi::xml_node& piece, const char* tag,
                                  const char* counted) {
    const auto count = static_cast<std::size_t>(vtk.number(piece, counted));
    std::vector<NamedArray> arrays;
    for (const pugi::xml_node array : piece.child(tag).children()) {
        const std::string name = array.attribute("Name").value();
        if (!VtkFile::is_array(array) || name == "label" ||
            std::string_view(array.attribute("type").value()) == "String")
            continue;
        NamedArray named{.name = name,
                         .components = static_cast<int>(vtk.number(array, "NumberOfComponents", 1)),
                         .values = vtk.reals(array)};
        vtk.require(array,
                    named.values.size() == count * static_cast<std::size_t>(named.components),
                    "has not as many numbers as its components ask for");
        arrays.push_back(std::move(named));
    }
    return arrays;
}

/// The frame that the field array SPACE names, or empty.
std::string space_of(const VtkFile& vtk) {
    const auto said = vtk.texts("SPACE");
    return said.empty() ? "" : said.front();
}

}  // namespace

RawSurface parse_vtp(std::string_view content, const std::filesystem::path& file) {
    const VtkFile vtk(content, file, "PolyData");
    RawSurface surface;
    surface.space = space_of(vtk);
    for (const pugi::xml_node piece : vtk.grid().children("Piece")) read_piece(vtk, piece, surface);
    return surface;
}

RawMesh parse_vtu(std::string_view content, const std::filesystem::path& file) {
    const VtkFile vtk(content, file, "UnstructuredGrid");
    RawMesh mesh;
    mesh.space = space_of(vtk);
    for (const pugi::xml_node piece : vtk.grid().children("Piece")) read_piece(vtk, piece, mesh);
    for (const std::string& said : vtk.texts("label_names")) {
        std::int64_t label = 0;
        std::string name;
        if (parse_value_name(said, label, name)) mesh.names[label] = name;
    }
    return mesh;
}

MeshArrays read_vtu_arrays(const std::filesystem::path& file) {
    const std::string content = read_bytes(file);
    const VtkFile vtk(content, file, "UnstructuredGrid");
    const pugi::xml_node piece = vtk.grid().child("Piece");
    vtk.require(vtk.grid(), piece && !piece.next_sibling("Piece"),
                "has not one piece, which its arrays are read from");
    MeshArrays arrays{.points = arrays_of(vtk, piece, "PointData", "NumberOfPoints"),
                      .cells = arrays_of(vtk, piece, "CellData", "NumberOfCells"),
                      .time = {}};
    if (const pugi::xml_node time = VtkFile::find(vtk.grid().child("FieldData"), "TimeValue"))
        if (const std::vector<double> said = vtk.reals(time); !said.empty())
            arrays.time = said.front();
    return arrays;
}

}  // namespace myotet::meshfiles
