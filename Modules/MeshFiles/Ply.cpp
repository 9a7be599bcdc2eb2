// SPDX-License-Identifier: Apache-2.0
// Own parser, because VTK 9.1's crashes on a .ply that is cut short.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "MeshFiles/RawMesh.h"
#include "MeshFiles/RawSurface.h"
#include "MeshFiles/TextReader.h"

namespace myotet::meshfiles {
namespace {

enum class Kind { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
    std::string_view name;
    Kind kind = Kind::float32;
    std::optional<Kind> count_kind;  ///< a list's, else none
};
struct Element {
    std::string_view name;
    std::int64_t count = 0;
    std::vector<Property> properties;
};
enum class Layout { text, little_endian, big_endian };
struct Header {
    Layout layout = Layout::text;
    std::vector<Element> elements;
    std::string space;
    std::map<std::int32_t, std::string> tag_names;
};

Kind read_kind(TextReader& text) {
    static constexpr std::pair<std::string_view, Kind> kKinds[] = {
        {"char", Kind::int8},      {"int8", Kind::int8},       {"uchar", Kind::uint8},
        {"uint8", Kind::uint8},    {"short", Kind::int16},     {"int16", Kind::int16},
        {"ushort", Kind::uint16},  {"uint16", Kind::uint16},   {"int", Kind::int32},
        {"int32", Kind::int32},    {"uint", Kind::uint32},     {"uint32", Kind::uint32},
        {"float", Kind::float32},  {"float32", Kind::float32}, {"double", Kind::float64},
        {"float64", Kind::float64}};
    const std::string_view said = text.word();
    for (const auto& [name, kind] : kKinds)
        if (name == said) return kind;
    text.fail("names the unknown type '" + std::string(said) + "'");
}

Layout read_layout(TextReader& text) {
    const std::string_view said = text.word();
    if (said == "ascii") return Layout::text;
    if (said == "binary_little_endian") return Layout::little_endian;
    if (said == "binary_big_endian") return Layout::big_endian;
    text.fail("names the unknown layout '" + std::string(said) + "'");
}

Property read_property(TextReader& text) {
    Property property;
    TextReader ahead = text;
    if (ahead.word() == "list") {
        text = ahead;
        property.count_kind = read_kind(text);
    }
    property.kind = read_kind(text);
    property.name = text.word();
    return property;
}

[[noreturn]] void fail_short(const std::filesystem::path& file, std::string_view where) {
    throw IoError(file.string() + ": ends in its " + std::string(where) +
                  "; the file is cut short, copy or export it again");
}

/// `SPACE=LPS`, or the name of a tag as `faces 1007=biceps|exterior`.
void read_comment(TextReader& text, Header& header) {
    if (header.space.empty()) header.space = space_said_by(text.rest());
    if (text.word() != "faces") return;
    std::int64_t tag = 0;
    std::string name;
    if (parse_value_name(text.rest(), tag, name))
        header.tag_names[static_cast<std::int32_t>(tag)] = name;
}

Header read_header(TextReader& text, const std::filesystem::path& file) {
    Header header;
    if (!text.next_line() || text.word() != "ply") text.fail("does not begin with ply");
    while (text.next_line()) {
        const std::string_view keyword = text.word();
        if (keyword == "end_header") {
            // An element without properties takes no bytes, however many there are.
            std::erase_if(header.elements, [](const Element& e) { return e.properties.empty(); });
            return header;
        }
        if (keyword == "format") header.layout = read_layout(text);
        if (keyword == "comment") read_comment(text, header);
        if (keyword == "element") {
            const std::string_view name = text.word();
            const auto count = text.number<std::int64_t>("the number of elements");
            if (count < 0) text.fail("counts fewer than zero elements");
            header.elements.push_back({name, count, {}});
        }
        if (keyword == "property") {
            if (header.elements.empty()) text.fail("is a property of no element");
            header.elements.back().properties.push_back(read_property(text));
        }
    }
    fail_short(file, "header");
}

/// Numbers one after another, whichever way they are stored.
class Values {
public:
    Values(TextReader& text, Layout layout, const std::filesystem::path& file)
        : text_(text), bytes_(text.remainder()), layout_(layout), file_(file) {}

    /// Every element of the text layout begins a line.
    void begin_element(std::string_view name) {
        if (layout_ != Layout::text) return;
        do {
            if (!text_.next_line()) fail_short(file_, name);
        } while (text_.rest().find_first_not_of(" \t\r") == std::string_view::npos);
    }
    double next(Kind kind, std::string_view name) {
        if (layout_ == Layout::text) return text_.number<double>("a number");
        switch (kind) {
            case Kind::int8:
                return take<std::int8_t>(name);
            case Kind::uint8:
                return take<std::uint8_t>(name);
            case Kind::int16:
                return take<std::int16_t>(name);
            case Kind::uint16:
                return take<std::uint16_t>(name);
            case Kind::int32:
                return take<std::int32_t>(name);
            case Kind::uint32:
                return take<std::uint32_t>(name);
            case Kind::float32:
                return take<float>(name);
            case Kind::float64:
                break;
        }
        return take<double>(name);
    }

private:
    template <class Number>
    double take(std::string_view name) {
        if (bytes_.size() < sizeof(Number)) fail_short(file_, name);
        std::array<char, sizeof(Number)> raw;
        std::memcpy(raw.data(), bytes_.data(), raw.size());
        bytes_.remove_prefix(raw.size());
        if ((layout_ == Layout::big_endian) != (std::endian::native == std::endian::big))
            std::ranges::reverse(raw);
        return static_cast<double>(std::bit_cast<Number>(raw));
    }

    TextReader& text_;
    std::string_view bytes_;
    Layout layout_;
    const std::filesystem::path& file_;
};

/// A whole number that was read as double, or -1, which no point has.
std::int64_t to_index(double value) {
    return value >= 0 && value < 4294967296.0 && value == std::floor(value)
               ? static_cast<std::int64_t>(value)
               : -1;
}

void read_element(const Element& element, Values& values, RawSurface& surface,
                  std::vector<std::int64_t>& corners) {
    Vec3 point = Vec3::Zero();
    std::int64_t tag = -1;
    for (const Property& property : element.properties) {
        const double first = values.next(property.count_kind.value_or(property.kind), element.name);
        if (!property.count_kind) {
            for (int axis = 0; axis < 3; ++axis)
                if (property.name == std::string_view("xyz").substr(axis, 1)) point[axis] = first;
            if (element.name == "face" && property.name == "tag") tag = to_index(first);
            continue;
        }
        corners.clear();
        for (std::int64_t i = 0, count = to_index(first); i < count; ++i)
            corners.push_back(to_index(values.next(property.kind, element.name)));
        if (element.name == "face" &&
            (property.name == "vertex_indices" || property.name == "vertex_index"))
            surface.add_polygon(corners);
    }
    if (element.name == "vertex") surface.points.push_back(point);
    if (tag >= 0 && tag <= std::numeric_limits<std::int32_t>::max())
        surface.tags.resize(surface.triangles.size(), static_cast<std::int32_t>(tag));
}

}  // namespace

RawSurface parse_ply(std::string_view content, const std::filesystem::path& file) {
    TextReader text(content, file);
    const Header header = read_header(text, file);
    RawSurface surface;
    surface.space = header.space;
    surface.tag_names = header.tag_names;
    Values values(text, header.layout, file);
    std::vector<std::int64_t> corners;
    for (const Element& element : header.elements)
        for (std::int64_t i = 0; i < element.count; ++i) {
            values.begin_element(element.name);
            read_element(element, values, surface, corners);
        }
    if (surface.tags.empty() && header.tag_names.size() == 1)
        surface.tags.assign(surface.triangles.size(), header.tag_names.begin()->first);
    return surface;
}

}  // namespace myotet::meshfiles
