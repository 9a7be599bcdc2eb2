// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <map>
#include <vector>

#include "MeshFiles/NamedComments.h"
#include "MeshFiles/RawSurface.h"
#include "MeshFiles/TextReader.h"

namespace myotet::meshfiles {
namespace {

Vec3 read_point(TextReader& text) {
    const double x = text.number<double>("a coordinate");
    const double y = text.number<double>("a coordinate");
    const double z = text.number<double>("a coordinate");
    return {x, y, z};
}

/// The next line that says something; comments begin with '#'.
bool next_statement(TextReader& text, RawSurface& surface) {
    while (text.next_line()) {
        if (surface.space.empty()) surface.space = space_said_by(text.rest());
        text.forget_after('#');
        if (text.rest().find_first_not_of(" \t\r") != std::string_view::npos) return true;
    }
    return false;
}

/// Tags for the groups of an .obj: those that comments `# faces 1007=name`
/// give, or 1, 2, ... in order.
class Groups {
public:
    explicit Groups(std::string_view content) {
        for (const auto& [tag, name] : read_comments(content, '#').faces)
            if (tag > 0 && tag <= std::numeric_limits<std::int32_t>::max()) {
                const auto narrow = static_cast<std::int32_t>(tag);
                tag_of_.emplace(obj_group(name), narrow);
                names_.emplace(narrow, name);
            }
    }
    void begin(std::string_view rest) {
        const std::size_t from = rest.find_first_not_of(" \t");
        std::string name(from == std::string_view::npos ? "" : rest.substr(from));
        while (!name.empty() && (name.back() == '\r' || name.back() == ' ')) name.pop_back();
        const auto [found, fresh] = tag_of_.try_emplace(name, next_);
        if (fresh) names_.emplace(next_++, name);
        tag_ = found->second;
        used_ = true;
    }
    void tag_new_triangles(RawSurface& surface) const {
        surface.tags.resize(surface.triangles.size(), tag_);
    }
    void finish(RawSurface& surface) {
        if (used_)
            surface.tag_names = std::move(names_);
        else
            surface.tags.clear();
    }

private:
    std::map<std::string, std::int32_t> tag_of_;
    std::map<std::int32_t, std::string> names_;
    std::int32_t tag_ = 0, next_ = 1;
    bool used_ = false;
};

}  // namespace

std::string obj_group(std::string name) {
    std::ranges::replace(name, ' ', '_');  // a blank begins another group
    return name;
}

RawSurface parse_obj(std::string_view content, const std::filesystem::path& file) {
    TextReader text(content, file);
    RawSurface surface;
    Groups groups(content);
    std::vector<std::int64_t> corners;
    while (next_statement(text, surface)) {
        const std::string_view keyword = text.word();
        if (keyword == "g") groups.begin(text.rest());
        if (keyword == "v") surface.points.push_back(read_point(text));
        if (keyword != "f") continue;
        corners.clear();
        for (auto word = text.word(); !word.empty(); word = text.word()) {
            // v, v/vt, v//vn or v/vt/vn; from 1, or from the end when negative.
            const auto index =
                text.to_number<std::int64_t>(word.substr(0, word.find('/')), "a vertex number");
            corners.push_back(index > 0 ? index - 1
                                        : static_cast<std::int64_t>(surface.points.size()) + index);
            if (index == 0) text.fail("names vertex 0, but .obj counts from 1");
        }
        if (corners.size() < 3) text.fail("is a face of fewer than three corners");
        surface.add_polygon(corners);
        groups.tag_new_triangles(surface);
    }
    groups.finish(surface);
    return surface;
}

RawSurface parse_off(std::string_view content, const std::filesystem::path& file) {
    TextReader text(content, file);
    RawSurface surface;
    const auto require_line = [&](const char* what) {
        if (!next_statement(text, surface))
            throw IoError(file.string() + ": ends before its last " + what +
                          "; the file is cut short, copy or export it again");
    };
    require_line("header line");
    std::string_view word = text.word();
    if (word != "OFF" && word != "COFF" && word != "NOFF" && word != "CNOFF")
        text.fail("does not begin with OFF");
    word = text.word();  // the counts may stand on the same line
    if (word.empty()) {
        require_line("header line");
        word = text.word();
    }
    if (word == "BINARY")
        throw InputError(file.string() + ": is a binary .off, which is not read; export as text");
    const auto vertices = text.to_number<std::int64_t>(word, "the number of vertices");
    const auto faces = text.number<std::int64_t>("the number of faces");
    if (vertices < 0 || faces < 0) text.fail("counts fewer than zero vertices or faces");

    for (std::int64_t i = 0; i < vertices; ++i) {
        require_line("vertex");
        surface.points.push_back(read_point(text));
    }
    std::vector<std::int64_t> corners;
    for (std::int64_t i = 0; i < faces; ++i) {
        require_line("face");
        const auto count = text.number<std::int64_t>("the number of corners");
        if (count < 3) text.fail("is a face of fewer than three corners");
        corners.clear();
        for (std::int64_t k = 0; k < count; ++k)
            corners.push_back(text.number<std::int64_t>("a vertex number"));
        surface.add_polygon(corners);
    }
    return surface;
}

}  // namespace myotet::meshfiles
