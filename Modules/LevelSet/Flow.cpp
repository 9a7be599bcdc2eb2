// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Flow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "Core/Parallel.h"
#include "LevelSet/GiveBack.h"
#include "LevelSet/Redistance.h"
#include "LevelSet/VoxelBand.h"

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;
constexpr int kApron = kSide + 2;
constexpr int kStepsBetweenRedistancing = 5;
// The flow acts in full up to this far from the band's edge, in samples, and
// fades out to nothing at the edge, where stencils reach clamped values. A
// narrower window bends the slope near the interface: a sphere then shrinks
// a tenth too fast.
constexpr float kFade = 0.7f;
// What redistancing must renew for that, in samples.
constexpr double kReach = 2;

// kappa |grad phi| by central differences in units of the spacing:
//   [phi_x^2 (phi_yy + phi_zz) + ... - 2 phi_x phi_y phi_xy - ...] / |grad phi|^2
float curvature_term(const float* p) {
    constexpr int x = 1, y = kApron, z = kApron * kApron;
    const float px = 0.5f * (p[x] - p[-x]), py = 0.5f * (p[y] - p[-y]), pz = 0.5f * (p[z] - p[-z]);
    const float twice = 2 * p[0];
    const float xx = p[x] - twice + p[-x], yy = p[y] - twice + p[-y], zz = p[z] - twice + p[-z];
    const float xy = 0.25f * (p[x + y] - p[y - x] - p[x - y] + p[-x - y]);
    const float xz = 0.25f * (p[x + z] - p[z - x] - p[x - z] + p[-x - z]);
    const float yz = 0.25f * (p[y + z] - p[z - y] - p[y - z] + p[-y - z]);
    const float x2 = px * px, y2 = py * py, z2 = pz * pz;
    const float top = x2 * (yy + zz) + y2 * (xx + zz) + z2 * (xx + yy) -
                      2 * (px * py * xy + px * pz * xz + py * pz * yz);
    return top / (x2 + y2 + z2 + 1e-6f);
}

// One explicit step of a block; `step` is b dt / spacing^2.
std::int64_t step_block(const Band& band, std::size_t b, float step, const Locks& locks,
                        float* out) {
    std::array<float, kApron * kApron * kApron> phi;
    gather(band, band.position[b], 1, 1, phi.data());
    const float h = static_cast<float>(band.spacing), unit = static_cast<float>(locks.unit);
    const float inverse = 1 / h;
    for (float& v : phi) v *= inverse;
    const float width = band.width * inverse;
    std::int64_t stopped = 0;
    int at = 0;
    for (int k = 1; k <= kSide; ++k)
        for (int j = 1; j <= kSide; ++j) {
            const float* row = phi.data() + (k * kApron + j) * kApron + 1;
            if (std::all_of(row, row + kSide, [&](float v) { return std::abs(v) >= width; })) {
                for (int i = 0; i < kSide; ++i, ++at) out[at] = h * row[i];
                continue;
            }
            for (int i = 0; i < kSide; ++i, ++at) {
                const float v = row[i];
                const float speed = std::min((width - std::abs(v)) / kFade, 1.0f);
                const float moved = v + speed * step * curvature_term(row + i);
                out[at] = h * std::clamp(moved, -width, width);
            }
        }
    if (locks.of_sample.empty()) return 0;
    const std::int8_t* lock = locks.of_sample.data() + b * Band::kSize;
    for (at = 0; at < Band::kSize; ++at) {
        const float bounded = locked(out[at], lock[at], unit);
        stopped += bounded != out[at] && lock[at] % 2 != 0;
        out[at] = bounded;
    }
    return stopped;
}

// A few steps and their redistancing, without leaving the stored blocks.
std::int64_t flow_for(Band& band, int steps, float step, const Locks& locks, double reach) {
    const std::size_t blocks = band.position.size();
    std::vector<float> next(band.values.size());
    std::vector<std::int64_t> stopped(blocks, 0);
    for (int s = 0; s < steps; ++s) {
        parallel_for(0, blocks, 32, [&](std::size_t first, std::size_t last) {
            for (std::size_t b = first; b < last; ++b)
                stopped[b] += step_block(band, b, step, locks, next.data() + b * Band::kSize);
        });
        band.values.swap(next);
    }
    next = {};
    redistance(band, Seeds::scale, 0, reach);
    return std::accumulate(stopped.begin(), stopped.end(), std::int64_t{0});
}

// Lays blocks anew around the interface; locks go with their samples.
void lay_anew(Band& band, const Locks& locks) {
    Band fresh = refit(band, band.width);
    if (!locks.of_sample.empty()) {
        std::vector<std::int8_t> moved(fresh.values.size(), 0);
        for (std::size_t b = 0; b < fresh.position.size(); ++b)
            if (const std::int32_t old = band.find(fresh.position[b]); old >= 0)
                std::copy_n(
                    locks.of_sample.begin() + static_cast<std::ptrdiff_t>(old) * Band::kSize,
                    Band::kSize, moved.begin() + b * Band::kSize);
        locks.of_sample = std::move(moved);
    }
    band = std::move(fresh);
    redistance(band, Seeds::keep_cells, 0);
}

}  // namespace

double flow_time(double distance) {
    // A right angle is carried along by the self-similar solution of curve
    // shortening, its tip moving by kTip * sqrt(b t).
    constexpr double kTip = 1.04;
    return distance * distance / (kTip * kTip);
}

void apply_locks(Band& band, const Locks& locks) {
    const float unit = static_cast<float>(locks.unit);
    for (std::size_t i = 0; i < locks.of_sample.size(); ++i)
        band.values[i] = locked(band.values[i], locks.of_sample[i], unit);
}

std::int64_t flow_by_mean_curvature(Band& band, const Locks& locks, const FlowOptions& options,
                                    const ProgressSink& progress) {
    if (!(options.time > 0)) return 0;
    // Stable up to b dt = spacing^2 / 4 for this stencil; a fifth keeps kinks calm.
    const double largest = band.spacing * band.spacing / 5;
    const int steps = static_cast<int>(std::ceil(options.time / largest));
    const auto step = static_cast<float>(options.time / steps / (band.spacing * band.spacing));
    const bool keep_volume = options.give_back_radius > 0;
    std::int64_t stopped = 0;
    std::vector<float> before;
    for (int done = 0; done < steps;) {
        progress.check();
        const int now = std::min(kStepsBetweenRedistancing, steps - done);
        done += now;
        if (options.wanders) lay_anew(band, locks);
        if (keep_volume) before = band.values;
        stopped +=
            flow_for(band, now, step, locks, done == steps ? band.width : kReach * band.spacing);
        if (keep_volume) give_back(band, before, options.give_back_radius);
    }
    return stopped;
}

}  // namespace myotet::levelset
