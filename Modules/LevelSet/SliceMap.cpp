// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/SliceMap.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace myotet::levelset {
namespace {

// Rounds of evening out. Each carries a step's height one pixel along the wall.
constexpr int kRounds = 4;
// How far a value may be moved, in pixels: a centre on the side of a wall, half
// a pixel off, keeps a seventh of a pixel to it.
constexpr float kMost = 0.36f;
// A part is thin where no value nearby is this deep, in pixels.
constexpr float kThick = 1.2f;

// Along a row: how many pixels away the nearest one with `kind` is.
void scan_rows(const SliceMask& mask, std::uint8_t kind, std::vector<float>& steps) {
    const int nx = mask.size[0];
    const float far = std::numeric_limits<float>::infinity();
    for (int y = 0; y < mask.size[1]; ++y) {
        const std::uint8_t* row = mask.inside.data() + static_cast<std::size_t>(y) * nx;
        float* out = steps.data() + static_cast<std::size_t>(y) * nx;
        float run = far;
        for (int x = 0; x < nx; ++x) out[x] = run = row[x] == kind ? 0 : run + 1;
        run = far;
        for (int x = nx - 1; x >= 0; --x) {
            run = row[x] == kind ? 0 : run + 1;
            out[x] = std::min(out[x], run);
        }
    }
}

// The lower envelope of the parabolas (hx steps_j)^2 + (hy (y - j))^2 over the
// rows j of one column names the nearest row for each y.
struct Envelope {
    std::vector<int> row;
    std::vector<double> until;

    template <class Height>
    void build(int count, double hy2, Height&& height) {
        row.clear();
        until.clear();
        for (int j = 0; j < count; ++j) {
            const double h = height(j);
            if (!std::isfinite(h)) continue;
            while (!row.empty()) {
                const int i = row.back();
                const double meet =
                    0.5 * ((h - height(i)) / hy2 + double(j) * j - double(i) * i) / (j - i);
                const double from = row.size() > 1 ? until[row.size() - 2]
                                                   : -std::numeric_limits<double>::infinity();
                if (meet > from) {
                    until.back() = meet;
                    break;
                }
                row.pop_back();
                until.pop_back();
            }
            row.push_back(j);
            until.push_back(std::numeric_limits<double>::infinity());
        }
    }
};

// Distance from each pixel of the other kind to the walls of those of `kind`.
void measure(const SliceMask& mask, std::uint8_t kind, SliceMap& map) {
    const int nx = mask.size[0], ny = mask.size[1];
    const double hx = map.spacing[0], hy = map.spacing[1];
    std::vector<float> steps(mask.inside.size());
    scan_rows(mask, kind, steps);
    Envelope envelope;
    for (int x = 0; x < nx; ++x) {
        const auto at = [&](int y) { return static_cast<std::size_t>(y) * nx + x; };
        envelope.build(ny, hy * hy, [&](int j) { return std::pow(hx * steps[at(j)], 2); });
        if (envelope.row.empty()) continue;
        std::size_t piece = 0;
        for (int y = 0; y < ny; ++y) {
            if (mask.inside[at(y)] == kind) continue;
            while (envelope.until[piece] < y) ++piece;
            const int j = envelope.row[piece];
            const double dx = hx * std::max(0.0, steps[at(j)] - 0.5);
            const double dy = hy * std::max(0.0, std::abs(y - j) - 0.5);
            const auto d = static_cast<float>(std::hypot(dx, dy));
            map.phi[at(y)] = kind ? d : -d;
        }
    }
}

// Which pixels have something thick of their own kind within two pixels.
std::vector<std::uint8_t> thick_pixels(const SliceMap& map, float thick) {
    const int nx = map.size[0], ny = map.size[1];
    std::vector<std::uint8_t> out(map.phi.size(), 0);
    for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x) {
            const float v = map.phi[static_cast<std::size_t>(y) * nx + x];
            if (std::abs(v) < thick) continue;
            for (int b = std::max(0, y - 2); b <= std::min(ny - 1, y + 2); ++b)
                for (int a = std::max(0, x - 2); a <= std::min(nx - 1, x + 2); ++a) {
                    const std::size_t at = static_cast<std::size_t>(b) * nx + a;
                    if ((map.phi[at] < 0) == (v < 0)) out[at] = 1;
                }
        }
    return out;
}

// (1 2 1) / 4 along both axes, held within kMost of the distances.
void even_out(SliceMap& map) {
    const int nx = map.size[0], ny = map.size[1];
    const auto pixel = static_cast<float>(std::min(map.spacing[0], map.spacing[1]));
    const auto thick = thick_pixels(map, kThick * pixel);
    const std::vector<float> exact = map.phi;
    std::vector<float> rows(map.phi.size());
    for (int round = 0; round < kRounds; ++round) {
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x) {
                const float* v = map.phi.data() + static_cast<std::size_t>(y) * nx + x;
                const float low = x > 0 ? v[-1] : v[0], high = x + 1 < nx ? v[1] : v[0];
                rows[static_cast<std::size_t>(y) * nx + x] = 0.25f * (low + high) + 0.5f * v[0];
            }
        for (int y = 0; y < ny; ++y)
            for (int x = 0; x < nx; ++x) {
                const std::size_t at = static_cast<std::size_t>(y) * nx + x;
                if (!thick[at]) continue;
                const float low = rows[y > 0 ? at - nx : at],
                            high = rows[y + 1 < ny ? at + nx : at];
                const float v = 0.25f * (low + high) + 0.5f * rows[at];
                map.phi[at] = std::clamp(v, exact[at] - kMost * pixel, exact[at] + kMost * pixel);
            }
    }
}

}  // namespace

double SliceMap::value(const Point2& p) const {
    double beyond = 0, t[2];
    int low[2];
    for (int a = 0; a < 2; ++a) {
        const double g = p[a] - first[a];
        const double held = std::clamp(g, 0.0, static_cast<double>(size[a] - 1));
        beyond += std::pow((g - held) * spacing[a], 2);
        low[a] = std::min(static_cast<int>(held), std::max(0, size[a] - 2));
        t[a] = held - low[a];
    }
    const float* v = phi.data() + static_cast<std::size_t>(low[1]) * size[0] + low[0];
    const int right = size[0] > 1 ? 1 : 0, up = size[1] > 1 ? size[0] : 0;
    const double bottom = v[0] + t[0] * (v[right] - v[0]);
    const double top = v[up] + t[0] * (v[up + right] - v[up]);
    const double inner = bottom + t[1] * (top - bottom);
    return beyond > 0 ? inner + std::sqrt(beyond) : inner;
}

SliceMap slice_distances(const SliceMask& mask, const Point2& spacing) {
    SliceMap map{.first = mask.first, .size = mask.size, .spacing = spacing};
    map.phi.assign(mask.inside.size(), 0.0f);
    measure(mask, 1, map);
    measure(mask, 0, map);
    even_out(map);
    for (const float v : map.phi) map.depth = std::max(map.depth, -double(v));
    return map;
}

}  // namespace myotet::levelset
