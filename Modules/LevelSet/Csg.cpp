// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Csg.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "LevelSet/CsgTable.h"
#include "LevelSet/Redistance.h"

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;
constexpr int kSize = Band::kSize;

Index3 place_of(std::size_t slot, const Index3& size) {
    return {static_cast<int>(slot % size[0]), static_cast<int>(slot / size[0] % size[1]),
            static_cast<int>(slot / size[0] / size[1])};
}

// Wide enough that a blend's arc begins inside the band.
Band widened(const Band& band, double blend) {
    return settle(band, kCsgWidth + std::ceil(blend / band.spacing));
}

float round_min(float a, float b, float r) {
    const float u = std::max(r - a, 0.0f), v = std::max(r - b, 0.0f);
    return std::max(r, std::min(a, b)) - std::sqrt(u * u + v * v);
}

// Keeps small changes out: where `made` differs from `was` by less than
// kUnmoved samples it is numerical, and the wall stays as it was; changes of
// twice that are made in full.
float unless_small(float was, float made, float spacing) {
    constexpr float kUnmoved = 0.15f;
    const float change = made - was, tolerance = kUnmoved * spacing;
    if (std::abs(change) <= tolerance) return was;
    if (std::abs(change) >= 2 * tolerance) return made;
    return was + 2 * (change - std::copysign(tolerance, change));
}

}  // namespace

Band to_band(const LevelSet& phi) {
    constexpr int n = LevelSet::kBrickSamples;
    Band band;
    band.origin = phi.origin;
    band.spacing = phi.spacing;
    band.width = static_cast<float>(std::min(phi.band, kCsgWidth * phi.spacing));
    band.blocks = phi.bricks;
    band.block_of.assign(phi.brick_of.size(), Band::kOutside);
    for (std::size_t s = 0; s < phi.brick_of.size(); ++s) {
        const Index3 b = place_of(s, phi.bricks);
        const std::int32_t number = phi.brick_of[s];
        if (number < 0) {
            const std::size_t middle =
                ((2 * static_cast<std::size_t>(b[2]) + 1) * phi.coarse_size[1] + 2 * b[1] + 1) *
                    phi.coarse_size[0] +
                2 * b[0] + 1;
            if (phi.coarse_values[middle] < 0) band.block_of[s] = Band::kInside;
            continue;
        }
        band.block_of[s] = static_cast<std::int32_t>(band.position.size());
        band.position.push_back(b);
        const float* from =
            phi.values.data() + static_cast<std::size_t>(number) * LevelSet::kBrickSize;
        for (int k = 0; k < kSide; ++k)
            for (int j = 0; j < kSide; ++j)
                for (int i = 0; i < kSide; ++i)
                    band.values.push_back(
                        std::clamp(from[(k * n + j) * n + i], -band.width, band.width));
    }
    return band;
}

Band sample_solid(const Distance& distance, const Box& box, const CsgLattice& lattice) {
    const double block = kSide * lattice.spacing;
    const double width = kCsgWidth * lattice.spacing;
    Band band;
    band.spacing = lattice.spacing;
    band.width = static_cast<float>(width);
    for (int a = 0; a < 3; ++a) {
        const double low = std::floor((box.min[a] - width - lattice.anchor[a]) / block) - 1;
        const double high = std::ceil((box.max[a] + width - lattice.anchor[a]) / block) + 1;
        band.origin[a] = lattice.anchor[a] + low * block;
        band.blocks[a] = static_cast<int>(high - low);
    }
    const std::size_t slots =
        static_cast<std::size_t>(band.blocks[0]) * band.blocks[1] * band.blocks[2];
    band.block_of.assign(slots, Band::kOutside);
    // No sample lies farther from a block's middle than this.
    const double reach = std::sqrt(3.0) * (kSide - 1) / 2 * lattice.spacing + width;
    const auto corner = [&](const Index3& b) {
        return Vec3(band.origin + block * Vec3(b[0], b[1], b[2]));
    };
    parallel_for(0, slots, 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = first; s < last; ++s) {
            const Vec3 middle = corner(place_of(s, band.blocks)) +
                                Vec3::Constant((kSide - 1) / 2.0 * lattice.spacing);
            const double d = distance(middle);
            band.block_of[s] = std::abs(d) <= reach ? 0 : d < 0 ? Band::kInside : Band::kOutside;
        }
    });
    for (std::size_t s = 0; s < slots; ++s)
        if (band.block_of[s] == 0) {
            band.block_of[s] = static_cast<std::int32_t>(band.position.size());
            band.position.push_back(place_of(s, band.blocks));
        }
    const float on_surface = 1e-5f * static_cast<float>(lattice.spacing);
    band.values.resize(band.position.size() * kSize);
    parallel_for(0, band.position.size(), 16, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            const Vec3 low = corner(band.position[b]);
            float* values = band.block(static_cast<std::int32_t>(b));
            for (int at = 0; at < kSize; ++at) {
                const Vec3 p(at % kSide, at / kSide % kSide, at / (kSide * kSide));
                const float d = static_cast<float>(distance(low + lattice.spacing * p));
                // A sample on the surface belongs to the solid, and so not to what is cut off.
                values[at] =
                    std::abs(d) < on_surface ? -on_surface : std::clamp(d, -band.width, band.width);
            }
        }
    });
    return band;
}

Band settle(const Band& band, double width) {
    const float mm = static_cast<float>(width * band.spacing);
    const int margin = static_cast<int>(std::ceil(width / kSide)) + 1;
    Band out = refit(framed(band, margin), mm);
    redistance(out, Seeds::keep_cells, 2);
    for (float& v : out.values) v = std::clamp(v, -mm, mm);
    return out;
}

Band unite(const Band& a, const Band& b, double blend) {
    if (!(blend > 0))
        return settle(
            merge({&a, &b}, Extent::all, [](const float* v) { return std::min(v[0], v[1]); }));
    const Band wide_a = widened(a, blend), wide_b = widened(b, blend);
    const float r = static_cast<float>(blend);
    return settle(merge({&wide_a, &wide_b}, Extent::all,
                        [r](const float* v) { return round_min(v[0], v[1], r); }));
}

Band intersect(const Band& a, const Band& b, double blend) {
    if (!(blend > 0))
        return settle(
            merge({&a, &b}, Extent::first, [](const float* v) { return std::max(v[0], v[1]); }));
    const Band wide_a = widened(a, blend), wide_b = widened(b, blend);
    const float r = static_cast<float>(blend);
    return settle(merge({&wide_a, &wide_b}, Extent::first,
                        [r](const float* v) { return -round_min(-v[0], -v[1], r); }));
}

Band subtract(const Band& a, const Band& b, double blend) {
    if (!(blend > 0))
        return settle(
            merge({&a, &b}, Extent::first, [](const float* v) { return std::max(v[0], -v[1]); }));
    const Band wide_a = widened(a, blend), wide_b = widened(b, blend);
    const float r = static_cast<float>(blend);
    return settle(merge({&wide_a, &wide_b}, Extent::first,
                        [r](const float* v) { return -round_min(-v[0], v[1], r); }));
}

Band offset(const Band& band, double distance) {
    Band wide = settle(band, kCsgWidth + std::ceil(std::abs(distance) / band.spacing));
    const float shift = static_cast<float>(distance);
    for (float& v : wide.values) v -= shift;
    wide.width = static_cast<float>(kCsgWidth * band.spacing);
    for (float& v : wide.values) v = std::clamp(v, -wide.width, wide.width);
    return settle(wide);
}

Band opened(const Band& band, double distance) {
    const Band made = offset(offset(band, -distance), distance);
    const float h = static_cast<float>(band.spacing);
    return settle(merge({&band, &made}, Extent::first, [h](const float* v) {
        return unless_small(v[0], std::max(v[0], v[1]), h);
    }));
}

Band closed(const Band& band, double distance) {
    const Band made = offset(offset(band, distance), -distance);
    const float h = static_cast<float>(band.spacing);
    return settle(merge({&band, &made}, Extent::all, [h](const float* v) {
        return unless_small(v[0], std::min(v[0], v[1]), h);
    }));
}

Band yielding(const Band& changed, const Band& before, const std::vector<const Band*>& others) {
    std::vector<const Band*> bands{&changed, &before};
    bands.insert(bands.end(), others.begin(), others.end());
    const std::size_t count = bands.size();
    return settle(merge(std::move(bands), Extent::first, [count](const float* v) {
        float limit = -std::numeric_limits<float>::infinity();
        for (std::size_t i = 2; i < count; ++i) limit = std::max(limit, -v[i]);
        return std::max(v[0], std::min(v[1], limit));
    }));
}

}  // namespace myotet::levelset
