// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstring>

#include "Core/AtomicFile.h"
#include "MeshFiles/MeshFiles.h"
#include "MeshFiles/RawSurface.h"
#include "MeshFiles/TextReader.h"

namespace myotet::meshfiles {
namespace {

// A binary .stl: 80 bytes of text, the number of facets, 50 bytes a facet
// (normal, three corners, 2 bytes unused), all little-endian.
static_assert(std::endian::native == std::endian::little);
constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kFacetBytes = 50;
constexpr std::size_t kFirstFacet = kHeaderBytes + sizeof(std::uint32_t);

void add_facet(RawSurface& surface, const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::int64_t>(surface.points.size());
    surface.points.insert(surface.points.end(), {a, b, c});
    surface.triangles.push_back({first, first + 1, first + 2});
}

RawSurface parse_binary(std::string_view content, std::uint32_t facets) {
    RawSurface surface;
    surface.space = space_said_by(content.substr(0, kHeaderBytes));
    surface.points.reserve(3 * std::size_t{facets});
    for (std::uint32_t f = 0; f < facets; ++f) {
        std::array<float, 12> x;  // the normal, which the corners imply, and the corners
        std::memcpy(x.data(), content.data() + kFirstFacet + f * kFacetBytes, sizeof x);
        add_facet(surface, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}, {x[9], x[10], x[11]});
    }
    return surface;
}

RawSurface parse_text(std::string_view content, const std::filesystem::path& file) {
    TextReader text(content, file);
    RawSurface surface;
    std::vector<Vec3> corners;
    bool ended = false;
    while (text.next_line()) {
        if (surface.space.empty()) surface.space = space_said_by(text.rest());
        const std::string_view keyword = text.word();
        ended = keyword == "endsolid" || (ended && keyword.empty());
        if (keyword == "vertex") {
            const double x = text.number<double>("a coordinate");
            const double y = text.number<double>("a coordinate");
            const double z = text.number<double>("a coordinate");
            corners.emplace_back(x, y, z);
        } else if (keyword == "endfacet") {
            if (corners.size() != 3) text.fail("ends a facet that has not three corners");
            add_facet(surface, corners[0], corners[1], corners[2]);
            corners.clear();
        }
    }
    if (!ended)
        throw IoError(file.string() +
                      ": ends without 'endsolid'; the file is cut short, copy or export it again");
    return surface;
}

}  // namespace

RawSurface parse_stl(std::string_view content, const std::filesystem::path& file) {
    // Some binary files begin with "solid" too: the length decides.
    std::uint32_t facets = 0;
    if (content.size() >= kFirstFacet) {
        std::memcpy(&facets, content.data() + kHeaderBytes, sizeof facets);
        if (content.size() == kFirstFacet + facets * kFacetBytes)
            return parse_binary(content, facets);
    }
    if (content.starts_with("solid")) return parse_text(content, file);
    throw IoError(file.string() + ": holds " + std::to_string(content.size()) +
                  " bytes, but a binary .stl of " + std::to_string(facets) + " facets needs " +
                  std::to_string(kFirstFacet + facets * kFacetBytes) +
                  "; the file is cut short or damaged, copy or export it again");
}

void write_stl(const TriMesh& surface, const std::filesystem::path& file) {
    // Must not begin with "solid", which marks the text form.
    constexpr std::string_view kHeader = "Myotet; SPACE=LPS; UNIT=mm";
    std::string bytes(kFirstFacet + surface.triangles.size() * kFacetBytes, '\0');
    kHeader.copy(bytes.data(), kHeader.size());
    const auto facets = static_cast<std::uint32_t>(surface.triangles.size());
    std::memcpy(bytes.data() + kHeaderBytes, &facets, sizeof facets);

    char* to = bytes.data() + kFirstFacet;
    for (const Triangle& t : surface.triangles) {
        const Vec3 &a = surface.points[t[0]], &b = surface.points[t[1]], &c = surface.points[t[2]];
        const Vec3 normal = (b - a).cross(c - a).normalized();
        std::array<float, 12> x;
        for (int i = 0; i < 3; ++i) {
            x[i] = static_cast<float>(normal[i]);
            x[3 + i] = static_cast<float>(a[i]);
            x[6 + i] = static_cast<float>(b[i]);
            x[9 + i] = static_cast<float>(c[i]);
        }
        std::memcpy(to, x.data(), sizeof x);
        to += kFacetBytes;
    }
    write_atomically(file, bytes);
}

}  // namespace myotet::meshfiles
