// SPDX-License-Identifier: Apache-2.0
#include "Report/Raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Core/Parallel.h"

namespace myotet::report {
namespace {

constexpr int kSamples = 3;   // a pixel, along x and along y
constexpr int kBandRows = 8;  // of pixels, drawn by one thread

// Twice the signed area of (a, b, p). Always computed from the same end of the edge, so that
// of two triangles at an edge each sample is in one at least: no cracks.
double edge(const Vec3& a, const Vec3& b, double x, double y) {
    const bool swapped = b.x() < a.x() || (b.x() == a.x() && b.y() < a.y());
    const Vec3 &from = swapped ? b : a, &to = swapped ? a : b;
    const double area = (to.x() - from.x()) * (y - from.y()) - (to.y() - from.y()) * (x - from.x());
    return swapped ? -area : area;
}

// First and last of `count` samples within [least, most] pixels; none: first > last.
std::array<int, 2> samples_within(double least, double most, int count) {
    const double end = count;
    return {static_cast<int>(std::ceil(std::clamp(kSamples * least - 0.5, 0.0, end))),
            static_cast<int>(std::floor(std::clamp(kSamples * most - 0.5, -1.0, end - 1)))};
}

double place(int sample) { return (sample + 0.5) / kSamples; }

// Some rows of the picture, sample by sample.
class Band {
public:
    Band(int first_row, int rows, int width)
        : first_(kSamples * first_row),
          rows_(kSamples * rows),
          width_(kSamples * width),
          depth_(static_cast<std::size_t>(rows_) * width_, std::numeric_limits<double>::infinity()),
          drawn_(depth_.size(), nullptr) {}

    void add(const FlatTriangle& triangle) {
        const auto& [a, b, c] = triangle.corners;
        const double area = edge(a, b, c.x(), c.y());
        if (area == 0) return;  // seen edge-on
        const auto [left, right] = samples_within(std::min({a.x(), b.x(), c.x()}),
                                                  std::max({a.x(), b.x(), c.x()}), width_);
        const auto [top, bottom] = samples_within(std::min({a.y(), b.y(), c.y()}),
                                                  std::max({a.y(), b.y(), c.y()}), first_ + rows_);
        for (int j = std::max(top, first_); j <= bottom; ++j)
            for (int i = left; i <= right; ++i) {
                const double x = place(i), y = place(j);
                const double u = edge(b, c, x, y), v = edge(c, a, x, y), w = edge(a, b, x, y);
                const bool inside = area > 0 ? u >= 0 && v >= 0 && w >= 0  //
                                             : u <= 0 && v <= 0 && w <= 0;
                if (!inside) continue;
                const double depth = (u * a.z() + v * b.z() + w * c.z()) / (u + v + w);
                const std::size_t at = static_cast<std::size_t>(j - first_) * width_ + i;
                if (!(depth < depth_[at])) continue;
                depth_[at] = depth;
                drawn_[at] = &triangle;
            }
    }

    // The mean of a pixel's samples; what none of them covers stays.
    void paint(Picture& picture) const {
        for (int y = 0; y < rows_ / kSamples; ++y)
            for (int x = 0; x < picture.width; ++x) paint_pixel(picture, x, y);
    }

private:
    void paint_pixel(Picture& picture, int x, int y) const {
        std::uint8_t* pixel = picture.rgb.data() + picture.offset(x, first_ / kSamples + y);
        int covered = 0;
        std::array<double, 3> sum{};
        for (int k = 0; k < kSamples * kSamples; ++k) {
            const std::size_t row = static_cast<std::size_t>(kSamples * y + k / kSamples);
            const FlatTriangle* triangle = drawn_[row * width_ + kSamples * x + k % kSamples];
            if (!triangle) continue;
            ++covered;
            for (int c = 0; c < 3; ++c) sum[c] += 255.0 * triangle->colour[c];
        }
        constexpr int all = kSamples * kSamples;
        for (int c = 0; c < 3; ++c)
            pixel[c] =
                static_cast<std::uint8_t>(std::lround((sum[c] + (all - covered) * pixel[c]) / all));
    }

    int first_, rows_, width_;  // in samples
    std::vector<double> depth_;
    std::vector<const FlatTriangle*> drawn_;
};

// Of each band the triangles that may touch it, in their order.
std::vector<std::vector<std::size_t>> sort_into_bands(std::span<const FlatTriangle> triangles,
                                                      int height) {
    const int bands = (height + kBandRows - 1) / kBandRows;
    std::vector<std::vector<std::size_t>> sorted(bands);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto& [a, b, c] = triangles[t].corners;
        const auto [top, bottom] = samples_within(
            std::min({a.y(), b.y(), c.y()}), std::max({a.y(), b.y(), c.y()}), kSamples * height);
        if (top > bottom) continue;
        constexpr int step = kSamples * kBandRows;
        for (int band = top / step; band <= bottom / step; ++band) sorted[band].push_back(t);
    }
    return sorted;
}

}  // namespace

void rasterise(std::span<const FlatTriangle> triangles, Picture& picture) {
    const auto sorted = sort_into_bands(triangles, picture.height);
    parallel_for(0, sorted.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            const int row = static_cast<int>(b) * kBandRows;
            Band band(row, std::min(kBandRows, picture.height - row), picture.width);
            for (const std::size_t t : sorted[b]) band.add(triangles[t]);
            band.paint(picture);
        }
    });
}

}  // namespace myotet::report
