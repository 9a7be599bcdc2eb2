// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace myotet::report {

/// Red, green, blue of sRGB, in [0, 1].
using Colour = std::array<double, 3>;

inline constexpr Colour kWhite{1, 1, 1};
inline constexpr Colour kBlack{0, 0, 0};

/// Pixels of sRGB, 8 bits a channel.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;  ///< 3 * width * height: rows from the top, pixels from the left

    [[nodiscard]] std::size_t offset(int x, int y) const {
        return 3 * (static_cast<std::size_t>(y) * width + x);
    }
};

/// A picture of one colour. Throws InputError when a side is not from 1 to kLongestSide.
[[nodiscard]] Picture blank(int width, int height, const Colour& colour = kWhite);

/// Sets a pixel; beyond the picture's sides nothing happens.
void set_pixel(Picture& picture, int x, int y, const Colour& colour);

/// The pictures from left to right in rows of `columns`, each in a cell as large as the
/// largest of them, on white: a contact sheet. Throws InputError when there is no picture, no
/// column, or the sheet's side would pass kLongestSide.
[[nodiscard]] Picture tile(std::span<const Picture> pictures, int columns);

/// Writes .png: 8-bit sRGB without transparency. The bytes depend on the picture and the
/// zlib at hand alone. Throws IoError.
void write_png(const Picture& picture, const std::filesystem::path& file);

/// The bytes that write_png would write. Throws IoError.
[[nodiscard]] std::string encode_png(const Picture& picture);

/// Reads a .png of any kind as 8-bit sRGB, transparent pixels on white. Throws IoError.
[[nodiscard]] Picture read_png(const std::filesystem::path& file);

/// Of a picture's sides, pixels.
inline constexpr int kLongestSide = 16384;

}  // namespace myotet::report
