// SPDX-License-Identifier: Apache-2.0
// Own parser, because VTK 9.1's ends the program on some damaged files.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <pugixml.hpp>

#include "Core/Errors.h"
#include "MeshFiles/Numbers.h"
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/RawSurface.h"
#include "MeshFiles/VtkBytes.h"
#include "MeshFiles/VtuArrays.h"

namespace myotet::meshfiles {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

/// A file's tags, and the numbers of an array when they are asked for.
class VtkFile {
public:
    VtkFile(std::string_view content, const std::filesystem::path& file, const char* type)
        : content_(content), file_(file) {
        parse(split_from_appended());
        const pugi::xml_node root = document_.child("VTKFile");
        if (!root) fail(0, "begins no VTKFile");
        const std::string_view said = root.attribute("type").value();
        if (said != type)
            refuse(root, "is of type '" + std::string(said) + "', but " + type + " is needed");
        read_storage(root);
        grid_ = root.child(type);
    }

    [[nodiscard]] pugi::xml_node grid() const { return grid_; }

    /// The array of this name, or none.
    [[nodiscard]] static pugi::xml_node find(const pugi::xml_node& holder, const char* name) {
        return holder.find_child([&](const pugi::xml_node& node) {
            return is_array(node) && std::string_view(node.attribute("Name").value()) == name;
        });
    }
    [[nodiscard]] pugi::xml_node array(const pugi::xml_node& holder, const char* name) const {
        const pugi::xml_node found = find(holder, name);
        if (!found) refuse(holder, "has no array '" + std::string(name) + "'");
        return found;
    }
    [[nodiscard]] static bool is_array(const pugi::xml_node& node) {
        const std::string_view tag = node.name();
        return tag == "DataArray" || tag == "Array";
    }
    [[nodiscard]] std::vector<double> reals(const pugi::xml_node& array) const {
        const NumberKind kind = kind_of(array);
        return is_text(array) ? parsed<double>(array)
                              : reals_in(bytes_of(array), kind, storage_.big_endian);
    }
    [[nodiscard]] std::vector<std::int64_t> integers(const pugi::xml_node& array) const {
        const NumberKind kind = kind_of(array);
        require(array, kind != NumberKind::float32 && kind != NumberKind::float64,
                "holds real numbers where integers are needed");
        return is_text(array) ? parsed<std::int64_t>(array)
                              : integers_in(bytes_of(array), kind, storage_.big_endian);
    }
    /// Texts end with a zero; none when there is no such array.
    [[nodiscard]] std::vector<std::string> texts(const char* name) const {
        const pugi::xml_node found = find(grid_.child("FieldData"), name);
        if (std::string_view(found.attribute("type").value()) != "String") return {};
        std::string bytes;
        if (is_text(found))
            for (const std::int64_t letter : parsed<std::int64_t>(found))
                bytes.push_back(static_cast<char>(letter));
        else
            bytes = bytes_of(found);
        std::vector<std::string> texts;
        for (std::size_t from = 0; from < bytes.size();) {
            const std::size_t end = std::min(bytes.find('\0', from), bytes.size());
            texts.push_back(bytes.substr(from, end - from));
            from = end + 1;
        }
        return texts;
    }
    [[nodiscard]] std::int64_t number(const pugi::xml_node& node, const char* name,
                                      std::optional<std::int64_t> otherwise = {}) const {
        const std::string_view said = trimmed(node.attribute(name).value());
        std::int64_t value = otherwise.value_or(-1);
        if (!said.empty()) value = to_number<std::int64_t>(node, said);
        if (value < 0)
            refuse(node, "says " + std::string(name) + "=\"" + std::string(said) +
                             "\", but a count is needed");
        return value;
    }
    void require(const pugi::xml_node& node, bool holds, const char* defect) const {
        if (!holds) refuse(node, defect);
    }
    [[noreturn]] void refuse(const pugi::xml_node& node, const std::string& defect) const {
        fail(node.offset_debug(), "(<" + std::string(node.name()) + ">) " + defect);
    }

private:
    /// The tags without the bytes that may follow them, which are kept.
    std::string split_from_appended() {
        const std::size_t tag = content_.find("<AppendedData");
        if (tag == std::string_view::npos) return std::string(content_);
        const std::size_t begin = content_.find('>', tag);
        const std::size_t end = content_.rfind("</AppendedData");
        if (begin == std::string_view::npos || end == std::string_view::npos || end < begin)
            throw IoError(file_.string() +
                          ": ends before its <AppendedData> does; the file is cut short, copy or "
                          "export it again");
        appended_ = content_.substr(begin + 1, end - begin - 1);
        const std::size_t mark = appended_.find_first_not_of(kBlank);
        if (mark == std::string_view::npos || appended_[mark] != '_')
            fail(static_cast<std::ptrdiff_t>(tag), "begins an <AppendedData> without its '_'");
        appended_.remove_prefix(mark + 1);
        return std::string(content_.substr(0, begin + 1)).append(content_.substr(end));
    }
    void parse(std::string tags) {
        tags_ = std::move(tags);
        const auto result = document_.load_buffer_inplace(tags_.data(), tags_.size(),
                                                          pugi::parse_default, pugi::encoding_utf8);
        if (!result)
            fail(result.offset, std::string("is not valid XML (") + result.description() + ")");
    }
    void read_storage(const pugi::xml_node& root) {
        using Compressor = VtkStorage::Compressor;
        static constexpr std::pair<std::string_view, Compressor> kCompressors[] = {
            {"", Compressor::none},
            {"vtkZLibDataCompressor", Compressor::zlib},
            {"vtkLZ4DataCompressor", Compressor::lz4},
            {"vtkLZMADataCompressor", Compressor::lzma}};
        static constexpr std::pair<std::string_view, std::size_t> kHeaders[] = {
            {"", 4}, {"UInt32", 4}, {"UInt64", 8}};
        static constexpr std::pair<std::string_view, bool> kOrders[] = {
            {"", false}, {"LittleEndian", false}, {"BigEndian", true}};
        static constexpr std::pair<std::string_view, bool> kEncodings[] = {
            {"", true}, {"base64", true}, {"raw", false}};
        storage_.compressor = one_of(root, "compressor", kCompressors);
        storage_.header_bytes = one_of(root, "header_type", kHeaders);
        storage_.big_endian = one_of(root, "byte_order", kOrders);
        appended_in_base64_ = one_of(root.child("AppendedData"), "encoding", kEncodings);
    }
    template <class Value, std::size_t N>
    Value one_of(const pugi::xml_node& node, const char* name,
                 const std::pair<std::string_view, Value> (&known)[N]) const {
        const std::string_view said = node.attribute(name).value();
        for (const auto& [word, value] : known)
            if (word == said) return value;
        fail(node.offset_debug(),
             "says " + std::string(name) + "=\"" + std::string(said) + "\", which is not known");
    }
    NumberKind kind_of(const pugi::xml_node& array) const {
        static constexpr std::pair<std::string_view, NumberKind> kKinds[] = {
            {"Int8", NumberKind::int8},       {"UInt8", NumberKind::uint8},
            {"Int16", NumberKind::int16},     {"UInt16", NumberKind::uint16},
            {"Int32", NumberKind::int32},     {"UInt32", NumberKind::uint32},
            {"Int64", NumberKind::int64},     {"UInt64", NumberKind::uint64},
            {"Float32", NumberKind::float32}, {"Float64", NumberKind::float64}};
        return one_of(array, "type", kKinds);
    }
    bool is_text(const pugi::xml_node& array) const {
        static constexpr std::pair<std::string_view, bool> kFormats[] = {
            {"", true}, {"ascii", true}, {"binary", false}, {"appended", false}};
        return one_of(array, "format", kFormats);
    }
    std::string bytes_of(const pugi::xml_node& array) const {
        const std::string where = file_.string() + ": line " +
                                  std::to_string(line_at(content_, array.offset_debug())) +
                                  ": array '" + array.attribute("Name").value() + "'";
        if (std::string_view(array.attribute("format").value()) == "binary")
            return vtk_array_bytes(array.text().get(), true, storage_, where);
        const auto offset = static_cast<std::size_t>(number(array, "offset"));
        require(array, offset <= appended_.size(), "lies behind the end of the file");
        return vtk_array_bytes(appended_.substr(offset), appended_in_base64_, storage_, where);
    }
    template <class Number>
    std::vector<Number> parsed(const pugi::xml_node& array) const {
        std::vector<Number> numbers;
        std::string_view text = array.text().get();
        for (std::size_t from = text.find_first_not_of(kBlank); from != std::string_view::npos;
             from = text.find_first_not_of(kBlank)) {
            text.remove_prefix(from);
            const std::string_view word = text.substr(0, text.find_first_of(kBlank));
            numbers.push_back(to_number<Number>(array, word));
            text.remove_prefix(word.size());
        }
        return numbers;
    }
    template <class Number>
    Number to_number(const pugi::xml_node& node, std::string_view word) const {
        Number value{};
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc{} || end != word.data() + word.size())
            refuse(node,
                   "holds '" + std::string(word.substr(0, 40)) + "' where a number should stand");
        return value;
    }
    static std::string_view trimmed(std::string_view text) {
        const std::size_t from = text.find_first_not_of(kBlank);
        if (from == std::string_view::npos) return {};
        return text.substr(from, text.find_last_not_of(kBlank) - from + 1);
    }
    [[noreturn]] void fail(std::ptrdiff_t offset, const std::string& defect) const {
        throw InputError(file_.string() + ": line " + std::to_string(line_at(content_, offset)) +
                         " " + defect +
                         "; the file is damaged or of a kind that is not read, export it again");
    }

    std::string_view content_;
    const std::filesystem::path& file_;
    std::string_view appended_;  ///< all after the '_'
    bool appended_in_base64_ = true;
    VtkStorage storage_;
    std::string tags_;
    pugi::xml_document document_;  ///< points into tags_
    pugi::xml_node grid_;
};

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
