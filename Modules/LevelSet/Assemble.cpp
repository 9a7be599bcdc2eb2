// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "Core/Parallel.h"
#include "LevelSet/Band.h"
#include "LevelSet/FarField.h"
#include "LevelSet/Redistance.h"

namespace myotet::levelset {
namespace {

constexpr int kCells = LevelSet::kBrickCells;
constexpr int kSamples = LevelSet::kBrickSamples;
static_assert(kCells == Band::kSide);

using Brick = std::array<float, LevelSet::kBrickSize>;

Index3 place_of(std::size_t slot, const Index3& size) {
    return {static_cast<int>(slot % size[0]), static_cast<int>(slot / size[0] % size[1]),
            static_cast<int>(slot / size[0] / size[1])};
}

bool touches_band(const Band& band, const Index3& b, Brick& samples) {
    bool near = false;
    for (int corner = 0; corner < 8 && !near; ++corner)
        near =
            band.find({b[0] + (corner & 1), b[1] + (corner >> 1 & 1), b[2] + (corner >> 2)}) >= 0;
    if (!near) return false;
    gather(band, b, 0, 1, samples.data());
    return std::any_of(samples.begin(), samples.end(),
                       [&](float v) { return std::abs(v) < band.width; });
}

std::size_t number_bricks(const Band& band, LevelSet& phi) {
    phi.brick_of.assign(band.block_of.size(), -1);
    parallel_for(0, phi.brick_of.size(), 256, [&](std::size_t first, std::size_t last) {
        Brick samples;
        for (std::size_t s = first; s < last; ++s)
            if (touches_band(band, place_of(s, phi.bricks), samples)) phi.brick_of[s] = 0;
    });
    std::int32_t count = 0;
    for (std::int32_t& number : phi.brick_of)
        if (number == 0) number = count++;
    return static_cast<std::size_t>(count);
}

// The coarse field interpolated at a brick's samples.
void interpolate_coarse(const LevelSet& phi, const Index3& b, Brick& out) {
    constexpr int n = kCells / kCoarseStep;
    const std::ptrdiff_t dy = phi.coarse_size[0], dz = dy * phi.coarse_size[1];
    for (int k = 0, at = 0; k < kSamples; ++k)
        for (int j = 0; j < kSamples; ++j)
            for (int i = 0; i < kSamples; ++i, ++at) {
                const Index3 c{std::min(i / kCoarseStep, n - 1), std::min(j / kCoarseStep, n - 1),
                               std::min(k / kCoarseStep, n - 1)};
                const float x = float(i - c[0] * kCoarseStep) / kCoarseStep;
                const float y = float(j - c[1] * kCoarseStep) / kCoarseStep;
                const float z = float(k - c[2] * kCoarseStep) / kCoarseStep;
                const float* p = phi.coarse_values.data() + (b[2] * n + c[2]) * dz +
                                 (b[1] * n + c[1]) * dy + b[0] * n + c[0];
                const auto line = [&](std::ptrdiff_t o) { return p[o] + x * (p[o + 1] - p[o]); };
                const auto plane = [&](std::ptrdiff_t o) {
                    return line(o) + y * (line(o + dy) - line(o));
                };
                out[at] = plane(0) + z * (plane(dz) - plane(0));
            }
}

// Whether every brick that holds sample (i, j, k) of brick b is stored.
struct Neighbours {
    bool stored[3][3][3];
    Neighbours(const LevelSet& phi, const Index3& b) {
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 3; ++j)
                for (int i = 0; i < 3; ++i)
                    stored[k][j][i] = holds(phi, {b[0] + i - 1, b[1] + j - 1, b[2] + k - 1});
    }
    static bool holds(const LevelSet& phi, const Index3& b) {
        for (int a = 0; a < 3; ++a)
            if (b[a] < 0 || b[a] >= phi.bricks[a]) return true;  // nothing to agree with
        return phi.brick_of[(static_cast<std::size_t>(b[2]) * phi.bricks[1] + b[1]) *
                                phi.bricks[0] +
                            b[0]] >= 0;
    }
    [[nodiscard]] bool all(int i, int j, int k) const {
        const auto low = [](int x) { return x == 0 ? 0 : 1; };
        const auto high = [](int x) { return x == kCells ? 2 : 1; };
        for (int c = low(k); c <= high(k); ++c)
            for (int b = low(j); b <= high(j); ++b)
                for (int a = low(i); a <= high(i); ++a)
                    if (!stored[c][b][a]) return false;
        return true;
    }
};

// Distance of sample `at` of brick b, mm, from the nearest of the eight feet
// around it, slid along the interface: unlike values interpolated on the
// coarse lattice, right on ridges too.
float distance_to_feet(const Band& band, const FarField& far, const Index3& b, const Index3& at) {
    constexpr int n = kCells / kCoarseStep;
    Index3 c;
    Eigen::Vector3f p;
    for (int a = 0; a < 3; ++a) {
        c[a] = b[a] * n + std::min(at[a] / kCoarseStep, n - 1);
        p[a] = static_cast<float>(b[a] * kCells + at[a]);
    }
    float nearest = std::numeric_limits<float>::infinity();
    const Eigen::Vector3f* best = nullptr;
    for (int corner = 0; corner < 8; ++corner) {
        const std::size_t i = (static_cast<std::size_t>(c[2] + (corner >> 2)) * far.size[1] + c[1] +
                               (corner >> 1 & 1)) *
                                  far.size[0] +
                              c[0] + (corner & 1);
        const float d = (p - far.foot[i]).squaredNorm();
        if (d >= nearest) continue;
        nearest = d;
        best = &far.foot[i];
    }
    const auto in_mm = [&](const Eigen::Vector3f& q) {
        return Vec3(band.origin + band.spacing * q.cast<double>());
    };
    const Vec3 point = in_mm(p);
    Vec3 foot = in_mm(*best);
    slide(band, point, 1, foot);
    return static_cast<float>((point - foot).norm());
}

// Beyond the band: inside, where depth decides how coarse elements may be, the
// distance to a foot; outside, the coarse field; both no less than the band's
// width. On faces towards bricks that hold nothing but the coarse field, that.
void fill_brick(const Band& band, const FarField& far, const Index3& b, LevelSet& phi, float* out) {
    Brick coarse;
    gather(band, b, 0, 1, out);
    interpolate_coarse(phi, b, coarse);
    const Neighbours neighbours(phi, b);
    const float width = band.width;
    for (int k = 0, at = 0; k < kSamples; ++k)
        for (int j = 0; j < kSamples; ++j)
            for (int i = 0; i < kSamples; ++i, ++at) {
                if (std::abs(out[at]) < width) continue;
                if (!neighbours.all(i, j, k))
                    out[at] = coarse[at];
                else if (out[at] > 0)
                    out[at] = std::max(width, coarse[at]);
                else
                    out[at] = -std::max(width, distance_to_feet(band, far, b, {i, j, k}));
            }
}

}  // namespace

LevelSet assemble(const Band& band) {
    LevelSet phi;
    phi.origin = band.origin;
    phi.spacing = band.spacing;
    phi.band = band.width;
    phi.bricks = band.blocks;
    phi.coarse_spacing = kCoarseStep * band.spacing;
    for (int a = 0; a < 3; ++a) phi.coarse_size[a] = kCells / kCoarseStep * band.blocks[a] + 1;
    FarField far = far_field(band);
    phi.coarse_values = std::move(far.value);
    phi.values.resize(number_bricks(band, phi) * LevelSet::kBrickSize);
    parallel_for(0, phi.brick_of.size(), 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = first; s < last; ++s)
            if (const std::int32_t number = phi.brick_of[s]; number >= 0)
                fill_brick(
                    band, far, place_of(s, phi.bricks), phi,
                    phi.values.data() + static_cast<std::size_t>(number) * LevelSet::kBrickSize);
    });
    return phi;
}

}  // namespace myotet::levelset
