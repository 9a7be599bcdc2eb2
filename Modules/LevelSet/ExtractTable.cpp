// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/ExtractTable.h"

namespace myotet::levelset {
namespace {

// The pairs of cut edges that curves join on face (axis, side). The face's
// diagonal from its lowest to its highest corner splits it into two triangles,
// each of which holds one of the two corners beside the diagonal.
struct FacePairs {
    int count = 0;
    std::array<std::array<int, 2>, 2> edges{};
};

FacePairs pairs_on_face(int inside, int axis, int side) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3, base = side << axis;
    const auto in = [&](int c) { return (inside >> c & 1) != 0; };
    const int low = base, high = base | 1 << u | 1 << v;
    FacePairs pairs;
    std::array<int, 2> lone{};
    for (int which = 0; which < 2; ++which) {
        const int first = which ? v : u, second = which ? u : v;  // low -> beside -> high
        const int beside = base | 1 << first;
        const int a = edge_of(first, low), b = edge_of(second, beside);
        if (in(low) == in(high)) {
            if (in(beside) != in(low)) pairs.edges[pairs.count++] = {a, b};
        } else {
            lone[which] = in(beside) != in(low) ? a : b;
        }
    }
    if (in(low) != in(high)) pairs.edges[pairs.count++] = lone;
    return pairs;
}

CellCut trace(int inside) {
    std::array<std::array<int, 2>, 12> next;  // each cut edge lies on two faces
    std::array<int, 12> links{};
    for (int face = 0; face < 6; ++face) {
        const FacePairs pairs = pairs_on_face(inside, face / 2, face % 2);
        for (int p = 0; p < pairs.count; ++p)
            for (int end = 0; end < 2; ++end) {
                const int edge = pairs.edges[p][end];
                next[edge][links[edge]++] = pairs.edges[p][1 - end];
            }
    }
    CellCut cut;
    cut.loop_of.fill(CellCut::kUncut);
    for (int start = 0; start < 12; ++start) {
        if (links[start] == 0 || cut.loop_of[start] != CellCut::kUncut) continue;
        for (int edge = start;;) {
            cut.loop_of[edge] = cut.loops;
            const auto [a, b] = next[edge];
            if (cut.loop_of[a] == CellCut::kUncut)
                edge = a;
            else if (cut.loop_of[b] == CellCut::kUncut)
                edge = b;
            else
                break;
        }
        ++cut.loops;
    }
    for (int face = 0; face < 6; ++face) {
        const FacePairs pairs = pairs_on_face(inside, face / 2, face % 2);
        if (pairs.count == 2 && cut.loop_of[pairs.edges[0][0]] == cut.loop_of[pairs.edges[1][0]])
            cut.twice |= static_cast<std::uint8_t>(1 << face);
    }
    return cut;
}

}  // namespace

const std::array<CellCut, 256>& cell_cuts() {
    static const std::array<CellCut, 256> table = [] {
        std::array<CellCut, 256> t;
        for (int inside = 0; inside < 256; ++inside) t[inside] = trace(inside);
        return t;
    }();
    return table;
}

}  // namespace myotet::levelset
