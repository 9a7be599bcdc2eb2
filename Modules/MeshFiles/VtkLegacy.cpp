// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstring>

#include "Core/AtomicFile.h"
#include "MeshFiles/MeshFiles.h"
#include "MeshFiles/TextWriter.h"

namespace myotet::meshfiles {
namespace {

/// The format's binary numbers are big-endian.
template <class Number>
void put(std::string& bytes, Number number) {
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), &number, sizeof number);
    if constexpr (std::endian::native == std::endian::little) std::ranges::reverse(raw);
    bytes.append(raw.data(), raw.size());
}

}  // namespace

void write_vtk(const TriMesh& surface, const std::filesystem::path& file) {
    TextWriter head, middle;
    head.line("# vtk DataFile Version 3.0").line(kFacts).line("BINARY").line("DATASET POLYDATA");
    head.line("POINTS ", surface.points.size(), " double");
    middle.line().line("POLYGONS ", surface.triangles.size(), ' ', 4 * surface.triangles.size());
    std::string bytes = head.text();
    for (const Vec3& p : surface.points)
        for (int i = 0; i < 3; ++i) put(bytes, p[i]);
    bytes += middle.text();
    for (const Triangle& t : surface.triangles) {
        put(bytes, std::int32_t{3});
        for (const std::int32_t v : t) put(bytes, v);
    }
    bytes += '\n';
    write_atomically(file, bytes);
}

}  // namespace myotet::meshfiles
