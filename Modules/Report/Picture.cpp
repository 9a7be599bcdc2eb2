// SPDX-License-Identifier: Apache-2.0
#include "Report/Picture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "Core/Errors.h"

namespace myotet::report {
namespace {

std::uint8_t byte_of(double share) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0, 1.0)));
}

void require_side(const char* name, std::int64_t side) {
    if (!(side >= 1 && side <= kLongestSide))
        throw InputError("a picture's " + std::string(name) + " is " + std::to_string(side) +
                         " pixels but must be from 1 to " + std::to_string(kLongestSide) +
                         "; choose another size");
}

}  // namespace

Picture blank(int width, int height, const Colour& colour) {
    require_side("width", width);
    require_side("height", height);
    Picture made{width, height, {}};
    made.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (std::size_t i = 0; i < made.rgb.size(); ++i) made.rgb[i] = byte_of(colour[i % 3]);
    return made;
}

void set_pixel(Picture& picture, int x, int y, const Colour& colour) {
    if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
    for (int c = 0; c < 3; ++c) picture.rgb[picture.offset(x, y) + c] = byte_of(colour[c]);
}

Picture tile(std::span<const Picture> pictures, int columns) {
    if (pictures.empty() || columns < 1)
        throw InputError("a contact sheet of " + std::to_string(pictures.size()) + " pictures in " +
                         std::to_string(columns) + " columns; give at least one of either");
    int width = 0, height = 0;
    for (const Picture& picture : pictures) {
        width = std::max(width, picture.width);
        height = std::max(height, picture.height);
    }
    const auto count = static_cast<std::int64_t>(pictures.size());
    const std::int64_t across = std::min<std::int64_t>(columns, count);
    const std::int64_t down = (count + across - 1) / across;
    require_side("width", across * width);
    require_side("height", down * height);
    Picture sheet = blank(static_cast<int>(across) * width, static_cast<int>(down) * height);
    for (std::int64_t i = 0; i < count; ++i) {
        const Picture& picture = pictures[i];
        const int left = static_cast<int>(i % across) * width;
        const int top = static_cast<int>(i / across) * height;
        for (int y = 0; y < picture.height; ++y)
            std::copy_n(
                picture.rgb.begin() + static_cast<std::ptrdiff_t>(picture.offset(0, y)),
                3 * picture.width,
                sheet.rgb.begin() + static_cast<std::ptrdiff_t>(sheet.offset(left, top + y)));
    }
    return sheet;
}

}  // namespace myotet::report
