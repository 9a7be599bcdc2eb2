// SPDX-License-Identifier: Apache-2.0
#include "Report/Draw.h"

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "Core/Text.h"
#include "Report/ColourMap.h"
#include "Report/Raster.h"
#include "Report/Text.h"

namespace myotet::report {
namespace {

constexpr double kAmbient = 0.35;
constexpr int kShortestSide = 64;        // pixels
constexpr int kSidePerLetterSize = 240;  // text grows with the picture
constexpr double kMargin = 0.03;         // of what the shapes may fill, on each side
constexpr double kParallel = 1e-6;       // sine of the angle of view and up
constexpr double kFarthest = 1e9;        // mm; beyond, squares of lengths lose what is near
constexpr double kNoExtent = 1e-9;       // mm; a smaller box is a point, drawn at any scale

[[noreturn]] void refuse(const std::string& why) {
    throw InputError("a view cannot be drawn: " + why);
}

void validate(const View& view) {
    const double sine = view.direction.normalized().cross(view.up.normalized()).norm();
    if (!(view.direction.allFinite() && view.up.allFinite() && sine > kParallel))
        refuse("'direction' and 'up' span no plane; give two that differ, neither of them zero");
    if (!(std::min(view.width, view.height) >= kShortestSide &&
          std::max(view.width, view.height) <= kLongestSide))
        refuse("it has " + std::to_string(view.width) + " x " + std::to_string(view.height) +
               " pixels, but sides are from " + std::to_string(kShortestSide) + " to " +
               std::to_string(kLongestSide));
    if (!(std::isfinite(view.least) && std::isfinite(view.most) && view.least < view.most))
        refuse("the colours' range from " + std::to_string(view.least) + " to " +
               std::to_string(view.most) + " has no extent; let 'most' be above 'least'");
    const Box& fit = view.fit;
    if (!fit.empty() &&
        !((fit.min.array() >= -kFarthest).all() && (fit.max.array() <= kFarthest).all()))
        refuse("'fit' is not finite or reaches beyond 1e9 mm; give the box that shall be shown");
}

void validate(const Shape& shape, std::size_t number) {
    const std::string where = "shape " + std::to_string(number) + ": ";
    const auto& [points, triangles] = shape.surface;
    if (!shape.values.empty() && shape.values.size() != triangles.size())
        refuse(where + std::to_string(shape.values.size()) + " values for " +
               std::to_string(triangles.size()) + " triangles; give each one, or none");
    for (const Vec3& p : points)
        if (!(p.array().abs() <= kFarthest).all())
            refuse(where + "a point is not finite or beyond 1e9 mm; leave it out");
    for (const Triangle& t : triangles)
        for (const std::int32_t n : t)
            if (n < 0 || static_cast<std::size_t>(n) >= points.size())
                refuse(where + "a triangle names point " + std::to_string(n) + " of " +
                       std::to_string(points.size()) + "; points are counted from 0");
}

// Where what goes, pixels.
struct Layout {
    int letter = 1;  // side of a letter's square
    int left = 0, top = 0, right = 0, bottom = 0;
};

Layout layout_of(const View& view, bool bar) {
    Layout layout;
    layout.letter = std::max(1, std::min(view.width, view.height) / kSidePerLetterSize);
    const int line = layout.letter * (kLetterHeight + 4);
    layout.top = view.title.empty() ? 0 : line;
    layout.right = view.width;
    layout.bottom = bar ? view.height - 3 * line : view.height;
    return layout;
}

// From the patient to the picture: scale * axes * x + shift.
struct Camera {
    Mat3 axes;  // right, down, away
    double scale = 1;
    Vec3 shift = Vec3::Zero();

    [[nodiscard]] Vec3 operator()(const Vec3& x) const { return scale * (axes * x) + shift; }
};

Box box_of(std::span<const Shape> shapes) {
    Box box;
    for (const Shape& shape : shapes)
        for (const Vec3& p : shape.surface.points) box.include(p);
    return box;
}

Camera camera_of(const View& view, const Box& box, const Layout& layout) {
    Camera camera;
    const Vec3 away = view.direction.normalized();
    const Vec3 right = away.cross(view.up).normalized();
    camera.axes << right.transpose(), away.cross(right).transpose(), away.transpose();
    if (box.empty()) return camera;

    Box seen;  // of the box's corners
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 p;
        for (int c = 0; c < 3; ++c) p[c] = (corner >> c & 1) ? box.max[c] : box.min[c];
        seen.include(camera.axes * p);
    }
    const double width = layout.right - layout.left, height = layout.bottom - layout.top;
    const double room = 1 - 2 * kMargin;
    const Vec3 extent = seen.extent();
    if (extent.maxCoeff() > kNoExtent)
        camera.scale =
            room / std::max({extent.x() / width, extent.y() / height, kNoExtent / width});
    const Vec3 middle(0.5 * (layout.left + layout.right), 0.5 * (layout.top + layout.bottom), 0);
    camera.shift = middle - camera.scale * seen.centre();
    return camera;
}

// Lambert's law with the light behind the viewer; both sides are lit.
double brightness(const Vec3& normal, const Vec3& away) {
    const double length = normal.norm();
    const double cosine = length > 0 ? std::abs(normal.dot(away)) / length : 0;
    return kAmbient + (1 - kAmbient) * cosine;
}

std::vector<FlatTriangle> flatten(std::span<const Shape> shapes, const View& view,
                                  const Camera& camera) {
    std::size_t count = 0;
    for (const Shape& shape : shapes) count += shape.surface.triangles.size();
    std::vector<FlatTriangle> flat;
    flat.reserve(count);
    const Vec3 away = camera.axes.row(2);
    for (const Shape& shape : shapes) {
        const std::vector<Vec3>& x = shape.surface.points;
        std::vector<Vec3> seen(x.size());
        std::transform(x.begin(), x.end(), seen.begin(), camera);
        for (std::size_t t = 0; t < shape.surface.triangles.size(); ++t) {
            const auto [a, b, c] = shape.surface.triangles[t];
            const double value = shape.values.empty() ? std::nan("") : shape.values[t];
            const Colour colour = std::isnan(value)
                                      ? shape.colour
                                      : map_colour((value - view.least) / (view.most - view.least));
            const double light = brightness((x[b] - x[a]).cross(x[c] - x[a]), away);
            FlatTriangle& made = flat.emplace_back(FlatTriangle{{seen[a], seen[b], seen[c]}, {}});
            for (int k = 0; k < 3; ++k)
                made.colour[k] = static_cast<float>(light * std::clamp(colour[k], 0.0, 1.0));
        }
    }
    return flat;
}

std::string shown(double number) { return formatted("%.4g", number); }

// At the bottom: the name, the bar, its ends' numbers.
void draw_bar(Picture& picture, const View& view, const Layout& layout) {
    const int size = layout.letter, line = size * (kLetterHeight + 4);
    const int width = view.width / 2, left = (view.width - width) / 2;
    const int top = view.height - 2 * line, height = line - 2 * size;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            set_pixel(picture, left + x, top + y, map_colour((x + 0.5) / width));
    const auto centred = [&](const std::string& text, int middle, int y) {
        draw_text(picture, text, {middle - text_width(text, size) / 2, y}, size);
    };
    centred(view.values_name, view.width / 2, top - line + size);
    centred(shown(view.least), left, top + line);
    centred(shown(0.5 * (view.least + view.most)), view.width / 2, top + line);
    centred(shown(view.most), left + width, top + line);
}

}  // namespace

Picture draw(std::span<const Shape> shapes, const View& view) {
    validate(view);
    for (std::size_t s = 0; s < shapes.size(); ++s) validate(shapes[s], s);
    const bool bar = std::ranges::any_of(shapes, [](const Shape& s) { return !s.values.empty(); });
    const Layout layout = layout_of(view, bar);
    const Camera camera = camera_of(view, view.fit.empty() ? box_of(shapes) : view.fit, layout);
    Picture picture = blank(view.width, view.height);
    rasterise(flatten(shapes, view, camera), picture);
    const int width = text_width(view.title, layout.letter);
    draw_text(picture, view.title, {std::max(0, (view.width - width) / 2), 2 * layout.letter},
              layout.letter);
    if (bar) draw_bar(picture, view, layout);
    return picture;
}

}  // namespace myotet::report
