// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Redistance.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "Core/Parallel.h"

namespace myotet::levelset {
namespace {

using Foot = Eigen::Vector3f;  // in spacings from the band's origin

constexpr int kSide = Band::kSide;
constexpr int kSize = Band::kSize;
constexpr int kApron = kSide + 2;
constexpr std::size_t kGrain = 32;  // blocks a task

// The 27 blocks around one, by (dz + 1) * 9 + (dy + 1) * 3 + dx + 1.
using Around = std::array<std::int32_t, 27>;

Around around(const Band& band, std::size_t b) {
    const Index3 p = band.position[b];
    Around numbers;
    for (int i = 0; i < 27; ++i)
        numbers[i] = band.find({p[0] + i % 3 - 1, p[1] + i / 3 % 3 - 1, p[2] + i / 9 - 1});
    return numbers;
}

// One bit a sample: plane k of a block, bit 8 j + i.
using Mask = std::array<std::uint64_t, kSide>;

struct Work {
    std::vector<Foot> foot;
    std::vector<Mask> kept;     // samples whose values stay or are scaled
    std::vector<float> scaled;  // their new values, where they do not stay
    std::vector<Mask> known;    // samples with a foot when the current layer began
    std::vector<Mask> grown;    // and now

    explicit Work(std::size_t blocks)
        : foot(blocks * kSize),
          kept(blocks, Mask{}),
          known(blocks, Mask{}),
          grown(blocks, Mask{}) {}
};

// Bits of a block with an apron of one sample: row (k, j), bit i, counted from
// the apron's first.
using Rows = std::array<std::array<std::uint16_t, kApron>, kApron>;

Rows rows_around(const Around& blocks, const std::vector<Mask>& masks) {
    constexpr Mask kNone{};
    Rows rows;
    for (int k = 0; k < kApron; ++k)
        for (int j = 0; j < kApron; ++j) {
            const auto side = [](int x) { return (x + kSide - 1) / kSide; };
            const auto local = [](int x) { return (x + kSide - 1) % kSide; };
            const auto row = [&](int dx) -> unsigned {
                const std::int32_t b = blocks[(side(k) * 3 + side(j)) * 3 + dx];
                const Mask& mask = b >= 0 ? masks[b] : kNone;
                return static_cast<unsigned>(mask[local(k)] >> (8 * local(j))) & 0xffu;
            };
            rows[k][j] = static_cast<std::uint16_t>(row(0) >> 7 | row(1) << 1 | (row(2) & 1u) << 9);
        }
    return rows;
}

// Position of a block's sample in spacings, and in mm.
Foot place(const Band& band, std::size_t b, int at) {
    const Index3 p = band.position[b];
    return Foot(float(p[0] * kSide + at % kSide), float(p[1] * kSide + at / kSide % kSide),
                float(p[2] * kSide + at / (kSide * kSide)));
}
Vec3 in_mm(const Band& band, const Foot& p) {
    return band.origin + band.spacing * p.cast<double>();
}
Foot in_spacings(const Band& band, const Vec3& p) {
    return ((p - band.origin) / band.spacing).cast<float>();
}

// Foot of a sample next to the interface, as an offset in spacings: along the
// gradient by central differences, x - phi grad phi / |grad phi|^2, or, where
// that leads farther, on the nearest of the edges to neighbours of the other
// sign.
Foot first_offset(const float* phi, float inverse_spacing, const Foot& edge) {
    constexpr int steps[3] = {1, kApron, kApron * kApron};
    Foot gradient;
    for (int a = 0; a < 3; ++a)
        gradient[a] = 0.5f * inverse_spacing * (phi[steps[a]] - phi[-steps[a]]);
    const float slope2 = gradient.squaredNorm();
    const Foot newton = -inverse_spacing * phi[0] / std::max(slope2, 1e-6f) * gradient;
    return slope2 > 0.1f && newton.squaredNorm() <= edge.squaredNorm() ? newton : edge;
}

// Gives samples with a neighbour of the other sign their foot.
void seed_block(const Band& band, std::size_t b, int slides, Work& work) {
    std::array<float, kApron * kApron * kApron> phi;
    gather(band, band.position[b], 1, 1, phi.data());
    constexpr int steps[3] = {1, kApron, kApron * kApron};
    for (int at = 0; at < kSize; ++at) {
        const int here = ((at / 64 + 1) * kApron + at / 8 % 8 + 1) * kApron + at % 8 + 1;
        const float v = phi[here];
        float nearest = std::numeric_limits<float>::infinity();
        Foot edge = Foot::Zero();
        for (int a = 0; a < 3; ++a)
            for (const int side : {-1, 1}) {
                const float w = phi[here + side * steps[a]];
                if ((v < 0) == (w < 0)) continue;
                const float t = v == w ? 0.5f : v / (v - w);
                if (t < nearest) {
                    nearest = t;
                    edge = side * t * Foot::Unit(a);
                }
            }
        if (!(nearest <= 1)) continue;
        const Foot p = place(band, b, at);
        Foot& out = work.foot[b * kSize + at];
        if (slides > 0) {
            Vec3 foot = in_mm(band, p + edge);
            slide(band, in_mm(band, p), slides, foot);
            out = in_spacings(band, foot);
        } else {
            out = p + first_offset(phi.data() + here, 1 / float(band.spacing), edge);
        }
        work.known[b][at / 64] |= std::uint64_t{1} << (at % 64);
    }
    work.grown[b] = work.known[b];
}

// |grad phi| by central differences, within a quarter of one; one where phi has
// a kink, which no gradient describes.
float slope_of(const float* phi, float spacing) {
    constexpr int steps[3] = {1, kApron, kApron * kApron};
    constexpr float kKink = 0.3f;  // half the jump of the slope; smooth parts have spacing / radius
    float slope2 = 0, jump2 = 0;
    for (const int s : steps) {
        const float up = phi[s] - phi[0], down = phi[0] - phi[-s];
        slope2 += 0.25f * (up + down) * (up + down);
        jump2 += 0.25f * (up - down) * (up - down);
    }
    if (jump2 > kKink * kKink * spacing * spacing) return 1;
    return std::clamp(std::sqrt(slope2) / spacing, 0.8f, 1.25f);
}

// The interface inside a cell depends on all its corners: those of cells with
// corners on both sides stay as they are.
void keep_block(const Band& band, std::size_t b, Work& work) {
    std::array<float, kApron * kApron * kApron> phi;
    gather(band, band.position[b], 1, 1, phi.data());
    for (int k = 0; k < kApron - 1; ++k)
        for (int j = 0; j < kApron - 1; ++j)
            for (int i = 0; i < kApron - 1; ++i) {
                const float* p = phi.data() + (k * kApron + j) * kApron + i;
                int negative = 0;
                for (int n = 0; n < 8; ++n)
                    negative += p[((n >> 2) * kApron + (n >> 1 & 1)) * kApron + (n & 1)] < 0;
                if (negative == 0 || negative == 8) continue;
                for (int n = 0; n < 8; ++n) {
                    const int x = i + (n & 1) - 1, y = j + (n >> 1 & 1) - 1, z = k + (n >> 2) - 1;
                    if (x < 0 || y < 0 || z < 0 || x >= kSide || y >= kSide || z >= kSide) continue;
                    work.kept[b][z] |= std::uint64_t{1} << (y * kSide + x);
                }
            }
    if (work.scaled.empty()) return;
    for (int at = 0; at < kSize; ++at) {
        if (!(work.kept[b][at / 64] >> (at % 64) & 1)) continue;
        const int here = ((at / 64 + 1) * kApron + at / 8 % 8 + 1) * kApron + at % 8 + 1;
        work.scaled[b * kSize + at] = phi[here] / slope_of(phi.data() + here, float(band.spacing));
    }
}

// The foot nearest to p among the known neighbours of sample (i, j, k), whose
// bits stand in `rows`.
Foot nearest_foot(const Foot& p, const Index3& at, const Around& blocks, const Rows& rows,
                  const Work& work) {
    float nearest = std::numeric_limits<float>::infinity();
    Foot best = p;
    for (int dk = 0; dk < 3; ++dk)
        for (int dj = 0; dj < 3; ++dj)
            for (unsigned bits = rows[at[2] + dk][at[1] + dj] >> at[0] & 7u; bits;
                 bits &= bits - 1) {
                const int q[3] = {at[0] + std::countr_zero(bits) + kSide - 1,
                                  at[1] + dj + kSide - 1, at[2] + dk + kSide - 1};
                const std::int32_t block =
                    blocks[(q[2] / kSide * 3 + q[1] / kSide) * 3 + q[0] / kSide];
                const Foot& foot =
                    work.foot[static_cast<std::size_t>(block) * kSize +
                              (q[2] % kSide * kSide + q[1] % kSide) * kSide + q[0] % kSide];
                const float d = (p - foot).squaredNorm();
                if (d < nearest) {
                    nearest = d;
                    best = foot;
                }
            }
    return best;
}

// Gives a foot to every sample without one that touches one with.
void grow_block(const Band& band, std::size_t b, int slides, Work& work) {
    const Around blocks = around(band, b);
    const Rows rows = rows_around(blocks, work.known);
    for (int k = 0; k < kSide; ++k)
        for (int j = 0; j < kSide; ++j) {
            unsigned any = 0;
            for (int n = 0; n < 9; ++n) any |= rows[k + n / 3][j + n % 3];
            const unsigned own = static_cast<unsigned>(work.known[b][k] >> (8 * j)) & 0xffu;
            const unsigned touched = (any | any >> 1 | any >> 2) & 0xffu & ~own;
            for (unsigned bits = touched; bits; bits &= bits - 1) {
                const int i = std::countr_zero(bits);
                const int at = (k * kSide + j) * kSide + i;
                const Foot p = place(band, b, at);
                Foot& out = work.foot[b * kSize + at];
                out = nearest_foot(p, {i, j, k}, blocks, rows, work);
                if (slides == 0) continue;
                Vec3 foot = in_mm(band, out);
                slide(band, in_mm(band, p), slides, foot);
                out = in_spacings(band, foot);
            }
            work.grown[b][k] |= std::uint64_t{touched} << (8 * j);
        }
}

void write_block(Band& band, std::size_t b, const Work& work) {
    float* values = band.block(static_cast<std::int32_t>(b));
    for (int at = 0; at < kSize; ++at) {
        const auto bit = [&](const Mask& mask) { return mask[at / 64] >> (at % 64) & 1; };
        if (bit(work.kept[b])) {
            if (!work.scaled.empty()) values[at] = work.scaled[b * kSize + at];
            continue;
        }
        float d = band.width;
        if (bit(work.grown[b]))
            d = std::min(
                d, float(band.spacing * (place(band, b, at) - work.foot[b * kSize + at]).norm()));
        values[at] = values[at] < 0 ? -d : d;
    }
}

}  // namespace

void redistance(Band& band, Seeds seeds, int slides, double reach) {
    const std::size_t blocks = band.position.size();
    Work work(blocks);
    if (seeds == Seeds::scale) work.scaled.resize(blocks * kSize);
    const auto each_block = [&](auto&& body) {
        parallel_for(0, blocks, kGrain, [&](std::size_t first, std::size_t last) {
            for (std::size_t b = first; b < last; ++b) body(b);
        });
    };
    each_block([&](std::size_t b) {
        seed_block(band, b, slides, work);
        if (seeds == Seeds::keep_ends) work.kept[b] = work.known[b];
        if (seeds == Seeds::keep_cells || seeds == Seeds::scale) keep_block(band, b, work);
    });
    const int layers =
        static_cast<int>(std::ceil(std::min(reach, double(band.width)) / band.spacing));
    for (int layer = 1; layer <= layers; ++layer) {
        each_block([&](std::size_t b) { grow_block(band, b, slides, work); });
        work.known = work.grown;
    }
    each_block([&](std::size_t b) { write_block(band, b, work); });
}

namespace {

// The box of a block's samples next to the interface, grown by `reach`;
// empty when max < min.
struct Reach {
    Index3 min{kSide, kSide, kSide}, max{-1, -1, -1};
};

Reach interface_box(const Band& band, std::size_t b, int reach) {
    std::array<float, kApron * kApron * kApron> phi;
    gather(band, band.position[b], 1, 1, phi.data());
    constexpr int steps[3] = {1, kApron, kApron * kApron};
    Reach box;
    for (int at = 0; at < kSize; ++at) {
        const Index3 p{at % kSide, at / kSide % kSide, at / (kSide * kSide)};
        const int here = ((p[2] + 1) * kApron + p[1] + 1) * kApron + p[0] + 1;
        bool near = false;
        for (const int s : steps)
            near = near || (phi[here] < 0) != (phi[here - s] < 0) ||
                   (phi[here] < 0) != (phi[here + s] < 0);
        if (!near) continue;
        for (int a = 0; a < 3; ++a) {
            box.min[a] = std::min(box.min[a], p[a] - reach);
            box.max[a] = std::max(box.max[a], p[a] + reach);
        }
    }
    return box;
}

}  // namespace

Band refit(const Band& band, float width) {
    Band out;
    out.origin = band.origin;
    out.spacing = band.spacing;
    out.width = width;
    out.beyond = band.beyond;
    out.blocks = band.blocks;
    std::vector<char> wanted(band.block_of.size(), 0);
    const int reach = static_cast<int>(std::ceil(width / band.spacing));
    for (std::size_t b = 0; b < band.position.size(); ++b) {
        const Reach box = interface_box(band, b, reach);
        if (box.max[0] < box.min[0]) continue;
        const auto block = [](int x) { return (x + 4 * kSide) / kSide - 4; };
        const Index3 p = band.position[b];
        for (int k = block(box.min[2]); k <= block(box.max[2]); ++k)
            for (int j = block(box.min[1]); j <= block(box.max[1]); ++j)
                for (int i = block(box.min[0]); i <= block(box.max[0]); ++i) {
                    const Index3 q{p[0] + i, p[1] + j, p[2] + k};
                    bool within = true;
                    for (int a = 0; a < 3; ++a)
                        within = within && q[a] >= 0 && q[a] < out.blocks[a];
                    if (within) wanted[band.slot(q)] = 1;
                }
    }
    out.block_of.resize(band.block_of.size());
    for (std::size_t s = 0; s < wanted.size(); ++s) {
        const std::int32_t old = band.block_of[s];
        // An unwanted block is of one sign: the interface is farther than width.
        const float value = old >= 0 ? band.block(old)[0] : band.empty_value(old);
        out.block_of[s] = value < 0 ? Band::kInside : Band::kOutside;
        if (!wanted[s]) continue;
        out.block_of[s] = static_cast<std::int32_t>(out.position.size());
        out.position.push_back({static_cast<int>(s % out.blocks[0]),
                                static_cast<int>(s / out.blocks[0] % out.blocks[1]),
                                static_cast<int>(s / out.blocks[0] / out.blocks[1])});
        if (old >= 0)
            out.values.insert(out.values.end(), band.block(old), band.block(old) + kSize);
        else
            out.values.insert(out.values.end(), kSize, value < 0 ? -width : width);
    }
    return out;
}

}  // namespace myotet::levelset
