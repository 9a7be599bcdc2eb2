// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Seams.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "LevelSet/Measure.h"

namespace myotet::levelset {
namespace {

using Corners = Seams::Corners;

// Whether `a` is nowhere above `b`; its interpolant then is not either.
bool below(const Corners& a, const Corners& b) {
    for (int c = 0; c < 8; ++c)
        if (a[c] > b[c]) return false;
    return true;
}

void keep_largest(const Corners& piece, std::vector<Corners>& pieces) {
    for (const Corners& p : pieces)
        if (below(piece, p)) return;
    std::erase_if(pieces, [&](const Corners& p) { return below(p, piece); });
    pieces.push_back(piece);
}

std::size_t slot_of(const LevelSet& phi, const Index3& brick) {
    return (static_cast<std::size_t>(brick[2]) * phi.bricks[1] + brick[1]) * phi.bricks[0] +
           brick[0];
}

// Sorts cells by brick and by their place in it.
struct Entry {
    std::size_t slot;
    int place;  // in the brick, i fastest, of 8 x 8 x 8
    std::size_t cell;
};

std::vector<Entry> sorted_cells(const LevelSet& phi, const Seams& seams) {
    constexpr int n = LevelSet::kBrickCells;
    std::vector<Entry> out;
    for (std::size_t i = 0; i < seams.cell.size(); ++i) {
        const Index3& c = seams.cell[i];
        const std::size_t slot = slot_of(phi, {c[0] / n, c[1] / n, c[2] / n});
        if (phi.brick_of[slot] >= 0)
            out.push_back({slot, ((c[2] % n) * n + c[1] % n) * n + c[0] % n, i});
    }
    std::sort(out.begin(), out.end(), [](const Entry& a, const Entry& b) {
        return a.slot != b.slot ? a.slot < b.slot : a.place < b.place;
    });
    return out;
}

// Moves the bricks of `slots` behind all others, in their order.
void move_behind(LevelSet& phi, const std::vector<std::size_t>& slots) {
    constexpr std::size_t size = LevelSet::kBrickSize;
    const std::size_t count = phi.values.size() / size;
    std::vector<std::size_t> slot_of_brick(count);
    for (std::size_t s = 0; s < phi.brick_of.size(); ++s)
        if (phi.brick_of[s] >= 0) slot_of_brick[phi.brick_of[s]] = s;
    for (std::size_t i = slots.size(); i-- > 0;) {
        const auto from = static_cast<std::size_t>(phi.brick_of[slots[i]]);
        const std::size_t to = count - slots.size() + i;
        if (from == to) continue;
        std::swap_ranges(phi.values.begin() + from * size, phi.values.begin() + (from + 1) * size,
                         phi.values.begin() + to * size);
        std::swap(slot_of_brick[from], slot_of_brick[to]);
        phi.brick_of[slot_of_brick[from]] = static_cast<std::int32_t>(from);
        phi.brick_of[slot_of_brick[to]] = static_cast<std::int32_t>(to);
    }
}

}  // namespace

void find_pieces(std::span<const Corners> regions, std::size_t own, float margin,
                 std::vector<Corners>& pieces) {
    pieces.clear();
    for (std::size_t r = 0; r < regions.size(); ++r) {
        if (r == own) continue;
        Corners piece;
        for (int c = 0; c < 8; ++c) piece[c] = 0.5f * (regions[own][c] - regions[r][c]);
        if (std::all_of(piece.begin(), piece.end(), [&](float v) { return v > margin; })) {
            pieces.clear();
            return;
        }
        keep_largest(piece, pieces);
    }
    const bool inside = std::all_of(pieces.begin(), pieces.end(), [&](const Corners& piece) {
        return std::all_of(piece.begin(), piece.end(), [&](float v) { return v < -margin; });
    });
    if (pieces.size() < 2 || inside) pieces.clear();
}

double inside_fraction(std::span<const Corners> pieces) {
    constexpr int n = kSeamSplit, m = n + 1;
    std::array<float, m * m * m> phi;  // at the corners of the small cells, i fastest
    phi.fill(-std::numeric_limits<float>::infinity());
    for (const Corners& p : pieces)
        for (int at = 0; at < m * m * m; ++at) {
            const float x = float(at % m) / n, y = float(at / m % m) / n,
                        z = float(at / (m * m)) / n;
            const auto line = [&](int c) { return p[c] + x * (p[c + 1] - p[c]); };
            const auto plane = [&](int c) { return line(c) + y * (line(c + 2) - line(c)); };
            phi[at] = std::max(phi[at], plane(0) + z * (plane(4) - plane(0)));
        }
    double sum = 0;
    for (int c = 0; c < n * n * n; ++c) {
        const float* p = phi.data() + ((c / (n * n)) * m + c / n % n) * m + c % n;
        sum += inside_fraction(Corners{p[0], p[1], p[m], p[m + 1], p[m * m], p[m * m + 1],
                                       p[m * m + m], p[m * m + m + 1]});
    }
    return sum / (n * n * n);
}

void attach_seams(LevelSet& phi, const Seams& seams) {
    const std::vector<Entry> cells = sorted_cells(phi, seams);
    std::vector<std::size_t> slots;
    for (const Entry& e : cells)
        if (slots.empty() || slots.back() != e.slot) slots.push_back(e.slot);
    move_behind(phi, slots);
    phi.first_seamed =
        static_cast<std::int32_t>(phi.values.size() / LevelSet::kBrickSize - slots.size());
    phi.seamed.assign(slots.size(), {});
    phi.pieces_of.clear();
    phi.pieces.clear();
    std::size_t next = 0;
    for (std::size_t b = 0; b < slots.size(); ++b) {
        LevelSet::Seamed& brick = phi.seamed[b];
        for (int plane = 0; plane < LevelSet::kBrickCells; ++plane) {
            brick.first[plane] = static_cast<std::uint32_t>(phi.pieces_of.size());
            for (; next < cells.size() && cells[next].slot == slots[b] &&
                   cells[next].place / 64 == plane;
                 ++next) {
                brick.cells[plane] |= std::uint64_t{1} << (cells[next].place % 64);
                phi.pieces_of.push_back(static_cast<std::uint32_t>(phi.pieces.size()));
                const std::size_t cell = cells[next].cell;
                const std::size_t last =
                    cell + 1 < seams.first.size() ? seams.first[cell + 1] : seams.piece.size();
                phi.pieces.insert(phi.pieces.end(), seams.piece.begin() + seams.first[cell],
                                  seams.piece.begin() + static_cast<std::ptrdiff_t>(last));
            }
        }
    }
    phi.pieces_of.push_back(static_cast<std::uint32_t>(phi.pieces.size()));
}

}  // namespace myotet::levelset
