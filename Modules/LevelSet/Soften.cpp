// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Soften.h"

#include <algorithm>
#include <cmath>

namespace myotet::levelset {
namespace {

constexpr int kBisections = 30;
constexpr int kCells = LevelSet::kBrickCells, kSamples = LevelSet::kBrickSamples;

std::int32_t brick_at(const LevelSet& phi, const Index3& b) {
    for (int a = 0; a < 3; ++a)
        if (b[a] < 0 || b[a] >= phi.bricks[a]) return -1;
    return phi
        .brick_of[(static_cast<std::size_t>(b[2]) * phi.bricks[1] + b[1]) * phi.bricks[0] + b[0]];
}

Vec3 place_of(const LevelSet& phi, const Index3& s) {
    return phi.origin + phi.spacing * Vec3(s[0], s[1], s[2]);
}

/// Where sample `s` is kept in brick `b`, which must have it and be stored.
std::size_t slot(const Index3& s, const Index3& b, std::int32_t number) {
    return static_cast<std::size_t>(number) * LevelSet::kBrickSize +
           ((s[2] - kCells * b[2]) * kSamples + s[1] - kCells * b[1]) * kSamples + s[0] -
           kCells * b[0];
}

double read(const LevelSet& phi, const Index3& s) {
    Index3 b;
    for (int a = 0; a < 3; ++a) b[a] = std::min(s[a] / kCells, phi.bricks[a] - 1);
    const std::int32_t number = brick_at(phi, b);
    return number >= 0 ? phi.values[slot(s, b, number)] : phi.value(place_of(phi, s));
}

/// In all bricks that have the sample: a layer is kept by the bricks on both its sides.
void write(LevelSet& phi, const Index3& s, double value) {
    for (int side = 0; side < 8; ++side) {
        Index3 b;
        bool has = true;
        for (int a = 0; a < 3; ++a) {
            const bool lower = side >> a & 1;
            has &= !lower || s[a] % kCells == 0;
            b[a] = s[a] / kCells - lower;
        }
        const std::int32_t number = has ? brick_at(phi, b) : -1;
        if (number >= 0) phi.values[slot(s, b, number)] = static_cast<float>(value);
    }
}

/// Samples about a spot, with a layer around them that does not change.
struct Block {
    Index3 low{}, size{};
    std::vector<double> values, weights;
    [[nodiscard]] std::size_t at(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * size[1] + j) * size[0] + i;
    }
    template <class Use>
    void each_inner(const Use& use) const {
        for (int k = 1; k + 1 < size[2]; ++k)
            for (int j = 1; j + 1 < size[1]; ++j)
                for (int i = 1; i + 1 < size[0]; ++i)
                    use(at(i, j, k), Index3{low[0] + i, low[1] + j, low[2] + k});
    }
};

/// 1 in the inner half of a ball, then (1 - u^2)^2, u from 0 to 1 at its surface.
double weight(double part_of_radius) {
    const double u = std::clamp(2 * part_of_radius - 1, 0.0, 1.0);
    return (1 - u * u) * (1 - u * u);
}

Block read_block(const LevelSet& phi, const Spot& spot) {
    Block block;
    for (int a = 0; a < 3; ++a) {
        const double centre = (spot.centre[a] - phi.origin[a]) / phi.spacing;
        const double reach = spot.radius / phi.spacing;
        const int last = phi.bricks[a] * kCells;
        block.low[a] = std::clamp(static_cast<int>(std::floor(centre - reach)) - 1, 0, last);
        const int high = std::clamp(static_cast<int>(std::ceil(centre + reach)) + 1, 0, last);
        block.size[a] = high - block.low[a] + 1;
    }
    for (int k = 0; k < block.size[2]; ++k)
        for (int j = 0; j < block.size[1]; ++j)
            for (int i = 0; i < block.size[0]; ++i) {
                const Index3 s{block.low[0] + i, block.low[1] + j, block.low[2] + k};
                block.values.push_back(read(phi, s));
                block.weights.push_back(
                    weight((place_of(phi, s) - spot.centre).norm() / spot.radius));
            }
    return block;
}

void smooth(Block& block) {
    const std::vector<double> v = block.values;
    const std::size_t dy = block.size[0], dz = dy * block.size[1];
    block.each_inner([&](std::size_t n, const Index3&) {
        const double mean =
            (v[n - 1] + v[n + 1] + v[n - dy] + v[n + dy] + v[n - dz] + v[n + dz]) / 6;
        block.values[n] += 0.5 * block.weights[n] * (mean - v[n]);
    });
}

/// What samples enclose, in cells: each stands for the part of a cell that a wall
/// across an axis at its distance leaves. phi is lowered by `shift` times the weights.
double enclosed(const Block& block, double spacing, double shift) {
    double sum = 0;
    block.each_inner([&](std::size_t n, const Index3&) {
        sum += std::clamp(0.5 - (block.values[n] - shift * block.weights[n]) / spacing, 0.0, 1.0);
    });
    return sum;
}

/// Lowers or raises phi, by at most a spacing, until it encloses what it did. By
/// bisection: `enclosed` only grows with the shift.
void give_back(Block& block, double spacing, double before) {
    double low = -spacing, high = spacing;
    for (int i = 0; i < kBisections; ++i) {
        const double middle = 0.5 * (low + high);
        (enclosed(block, spacing, middle) < before ? low : high) = middle;
    }
    block.each_inner(
        [&](std::size_t n, const Index3&) { block.values[n] -= high * block.weights[n]; });
}

bool meets_any(std::span<const Spot> spots, const Vec3& centre, double half_diagonal) {
    return std::ranges::any_of(spots, [&](const Spot& s) {
        return (centre - s.centre).norm() < s.radius + half_diagonal;
    });
}

/// Leaves the cells that meet a spot to their samples.
void drop_pieces(LevelSet& phi, std::span<const Spot> spots) {
    const double half_diagonal = 0.5 * std::sqrt(3.0) * phi.spacing;
    std::vector<std::uint32_t> pieces_of{0};
    std::vector<std::array<float, 8>> pieces;
    std::vector<Index3> place(phi.seamed.size());
    for (std::size_t slot = 0; slot < phi.brick_of.size(); ++slot)
        if (phi.brick_of[slot] >= phi.first_seamed) {
            const int b = static_cast<int>(slot);
            place[phi.brick_of[slot] - phi.first_seamed] = {b % phi.bricks[0],
                                                            b / phi.bricks[0] % phi.bricks[1],
                                                            b / phi.bricks[0] / phi.bricks[1]};
        }
    for (std::size_t s = 0; s < phi.seamed.size(); ++s)
        for (int at = 0; at < kCells * kCells * kCells; ++at) {
            const int i = at % kCells, j = at / kCells % kCells, k = at / (kCells * kCells);
            if (!(phi.seamed[s].cells[k] >> (kCells * j + i) & 1)) continue;
            const Index3& b = place[s];
            const Vec3 centre =
                place_of(phi, {kCells * b[0] + i, kCells * b[1] + j, kCells * b[2] + k}) +
                Vec3::Constant(0.5 * phi.spacing);
            const auto own =
                phi.pieces_at(phi.first_seamed + static_cast<std::int32_t>(s), i, j, k);
            if (!meets_any(spots, centre, half_diagonal))
                pieces.insert(pieces.end(), own.begin(), own.end());
            pieces_of.push_back(static_cast<std::uint32_t>(pieces.size()));
        }
    phi.pieces_of = std::move(pieces_of);
    phi.pieces = std::move(pieces);
}

}  // namespace

void soften(LevelSet& phi, std::span<const Spot> spots, const Softening& how) {
    if (!phi.seamed.empty()) drop_pieces(phi, spots);
    for (const Spot& spot : spots) {
        Block block = read_block(phi, spot);
        const double before = enclosed(block, phi.spacing, 0);
        for (int step = 0; step < how.steps; ++step) smooth(block);
        if (how.keeps_volume) give_back(block, phi.spacing, before);
        block.each_inner([&](std::size_t n, const Index3& s) { write(phi, s, block.values[n]); });
    }
}

}  // namespace myotet::levelset
