// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "Core/TetMesh.h"

namespace myotet::meshfiles {

/// A surface as its file says it: indices not yet checked, points not merged.
struct RawSurface {
    std::vector<Vec3> points;
    std::vector<std::array<std::int64_t, 3>> triangles;
    std::vector<std::int32_t> tags;                 ///< one a triangle, or none
    std::map<std::int32_t, std::string> tag_names;  ///< of the tags that have one
    std::string space;  ///< patient frame that the file names (LPS, RAS), or empty

    /// Adds a polygon as a fan around its first corner.
    void add_polygon(std::span<const std::int64_t> corners) {
        for (std::size_t i = 2; i < corners.size(); ++i)
            triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
};

/// The frame in a text that says `SPACE=LPS` or `SPACE=RAS`, or empty.
[[nodiscard]] std::string space_said_by(std::string_view text);

/// Each takes the whole content of a file; `file` is for messages.
[[nodiscard]] RawSurface parse_obj(std::string_view content, const std::filesystem::path& file);
[[nodiscard]] RawSurface parse_off(std::string_view content, const std::filesystem::path& file);
[[nodiscard]] RawSurface parse_stl(std::string_view content, const std::filesystem::path& file);
[[nodiscard]] RawSurface parse_ply(std::string_view content, const std::filesystem::path& file);
[[nodiscard]] RawSurface parse_vtp(std::string_view content, const std::filesystem::path& file);

/// A face set's name as a group of an .obj.
[[nodiscard]] std::string obj_group(std::string name);

}  // namespace myotet::meshfiles
