// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <unordered_map>

#include "Core/Errors.h"
#include "MeshFiles/MeshFiles.h"
#include "MeshFiles/RawMesh.h"
#include "MeshFiles/RawSurface.h"

namespace myotet::meshfiles {
namespace fs = std::filesystem;

namespace {

RawSurface read_raw(const fs::path& file) {
    const std::string extension = lower_extension(file);
    if (!is_surface_file(file))
        throw InputError(file.string() + ": '" + extension +
                         "' is no surface format that is read; use .obj .off .stl .ply or .vtp");
    const std::string content = read_bytes(file);
    if (content.empty()) throw InputError(file.string() + ": is empty; a closed surface is needed");
    if (extension == ".obj") return parse_obj(content, file);
    if (extension == ".off") return parse_off(content, file);
    if (extension == ".stl") return parse_stl(content, file);
    return extension == ".ply" ? parse_ply(content, file) : parse_vtp(content, file);
}

void check_numbers(const RawSurface& raw, const fs::path& file) {
    const auto count = static_cast<std::int64_t>(raw.points.size());
    for (std::int64_t i = 0; i < count; ++i)
        if (!raw.points[i].allFinite())
            throw InputError(file.string() + ": point " + std::to_string(i) +
                             " has a coordinate that is not a finite number; repair the surface");
    for (std::size_t f = 0; f < raw.triangles.size(); ++f)
        for (const std::int64_t corner : raw.triangles[f])
            if (!(corner >= 0 && corner < count))
                throw InputError(file.string() + ": triangle " + std::to_string(f) +
                                 " names point " + std::to_string(corner) +
                                 " (from 0), but the file has " + std::to_string(count) +
                                 " points; the file is damaged, export it again");
    if (count > std::numeric_limits<std::int32_t>::max())
        throw ResourceError(file.string() + ": has " + std::to_string(count) +
                            " points, more than 32-bit indices hold; simplify the surface");
}

struct PositionHash {
    std::size_t operator()(const std::array<double, 3>& p) const {
        std::uint64_t h = 0;
        for (const double x : p)
            h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15u + (h >> 29);
        return h ^ (h >> 32);
    }
};

/// One point a position, in the order of first use; triangles that lost a
/// corner are left out, those that stay are listed in `kept`, if given.
TriMesh merge_points(const RawSurface& raw, std::vector<std::size_t>* kept = nullptr) {
    TriMesh mesh;
    std::unordered_map<std::array<double, 3>, std::int32_t, PositionHash> number_at;
    number_at.reserve(raw.points.size());
    const auto number = [&](std::int64_t corner) {
        const Vec3& p = raw.points[corner];
        // Adding zero makes -0 and 0 one place.
        const auto [it, fresh] = number_at.try_emplace(
            {p[0] + 0.0, p[1] + 0.0, p[2] + 0.0}, static_cast<std::int32_t>(mesh.points.size()));
        if (fresh) mesh.points.push_back(p);
        return it->second;
    };
    for (std::size_t f = 0; f < raw.triangles.size(); ++f) {
        const auto& t = raw.triangles[f];
        const auto &a = raw.points[t[0]], &b = raw.points[t[1]], &c = raw.points[t[2]];
        if (a == b || b == c || c == a) continue;
        const std::int32_t i = number(t[0]), j = number(t[1]), k = number(t[2]);
        mesh.triangles.push_back({i, j, k});
        if (kept) kept->push_back(f);
    }
    return mesh;
}

/// In mm and LPS.
TriMesh placed(TriMesh mesh, const RawSurface& raw, double scale, const fs::path& file) {
    if (mesh.triangles.empty())
        throw InputError(file.string() + ": holds no triangles; a closed surface is needed");
    // RAS and LPS differ by half a turn about the third axis.
    const Vec3 to_lps = raw.space == "RAS" ? Vec3(-1, -1, 1) : Vec3(1, 1, 1);
    for (Vec3& p : mesh.points) p = scale * to_lps.cwiseProduct(p);
    return mesh;
}

}  // namespace

std::string space_said_by(std::string_view text) {
    const std::size_t at = text.find("SPACE=");
    return at == std::string_view::npos ? "" : std::string(text.substr(at + 6, 3));
}

bool is_surface_file(const fs::path& file) {
    static constexpr std::string_view kKnown[] = {".obj", ".off", ".stl", ".ply", ".vtp"};
    return std::ranges::find(kKnown, lower_extension(file)) != std::end(kKnown);
}

TriMesh read_surface(const fs::path& file, double scale) {
    if (!(scale > 0) || !std::isfinite(scale))
        throw InputError("scale: " + std::to_string(scale) +
                         " is not a positive number of millimetres a unit");
    const RawSurface raw = read_raw(file);
    check_numbers(raw, file);
    return placed(merge_points(raw), raw, scale, file);
}

NamedMesh read_named_surface(const fs::path& file) {
    const RawSurface raw = read_raw(file);
    check_numbers(raw, file);
    std::vector<std::size_t> kept;
    TriMesh surface = placed(merge_points(raw, &kept), raw, 1, file);
    const bool tagged = raw.tags.size() == raw.triangles.size();
    std::map<std::int32_t, FaceSet> sets;
    for (std::size_t f = 0; f < kept.size(); ++f) {
        const std::int32_t tag = tagged ? raw.tags[kept[f]] : kExteriorTag + 1;
        FaceSet& set = sets[tag];
        if (set.triangles.empty()) {
            const auto name = raw.tag_names.find(tag);
            set.tag = tag;
            set.name = name != raw.tag_names.end() ? name->second
                       : tagged                    ? std::to_string(tag)
                                                   : file.stem().string();
        }
        set.triangles.push_back(surface.triangles[f]);
    }
    NamedMesh named;
    named.mesh.points = std::move(surface.points);
    for (auto& [tag, set] : sets) named.faces.push_back(std::move(set));
    return named;
}

}  // namespace myotet::meshfiles
