// SPDX-License-Identifier: Apache-2.0
#include "Lattice/Patterns.h"

#include <bit>

#include "Core/Errors.h"

namespace myotet::lattice {
namespace {

constexpr unsigned face_pattern(int face) {
    unsigned p = 0;
    for (const int e : kFaceEdges[face]) p |= 1u << e;
    return p;
}

constexpr std::array<unsigned, 64> make_closure() {
    std::array<unsigned, 64> closed{};
    for (unsigned p = 0; p < 64; ++p) {
        closed[p] = kAllEdges;
        if (std::popcount(p) <= 1) closed[p] = p;
        for (int e = 0; e < 3; ++e)
            if (p == ((1u << e) | (1u << (5 - e)))) closed[p] = p;
        if (std::popcount(p) == 2 || std::popcount(p) == 3)
            for (int f = 0; f < 4; ++f)
                if ((p & ~face_pattern(f)) == 0) closed[p] = face_pattern(f);
    }
    return closed;
}

constexpr std::array<unsigned, 64> kClosure = make_closure();

Tet replaced(Tet t, int at, std::int32_t node) {
    t[at] = node;
    return t;
}

}  // namespace

unsigned closed_pattern(unsigned pattern) { return kClosure[pattern & kAllEdges]; }

std::array<Tet, 8> red_children(const Tet& t, const std::array<std::int32_t, 6>& m) {
    // m01, m02, m03, m12, m13, m23. Long edges stay at places (0, 1) and (2, 3);
    // the octahedron's diagonal m01 m23 is the shortest.
    return {{{t[0], m[0], m[1], m[2]},
             {m[0], t[1], m[3], m[4]},
             {m[1], m[3], t[2], m[5]},
             {m[2], m[4], m[5], t[3]},
             {m[0], m[5], m[1], m[2]},
             {m[0], m[5], m[2], m[4]},
             {m[0], m[5], m[4], m[3]},
             {m[0], m[5], m[3], m[1]}}};
}

void append_green_children(const Tet& t, unsigned pattern, const std::array<std::int32_t, 6>& m,
                           std::vector<Tet>& children) {
    if (std::popcount(pattern) == 1) {
        const int e = std::countr_zero(pattern);
        children.push_back(replaced(t, kEdge[e][0], m[e]));
        children.push_back(replaced(t, kEdge[e][1], m[e]));
        return;
    }
    if (std::popcount(pattern) == 2) {
        const int e = std::countr_zero(pattern), o = 5 - e;
        for (const int a : kEdge[e])
            for (const int b : kEdge[o])
                children.push_back(replaced(replaced(t, a, m[e]), b, m[o]));
        return;
    }
    for (int f = 0; f < 4; ++f) {
        if (pattern != face_pattern(f)) continue;
        // Each corner of the face keeps its two half edges; the fourth child
        // stands on the three midpoints. The apex stays where it was.
        Tet inner = t;
        for (int corner = 0; corner < 4; ++corner) {
            if (corner == f) continue;
            Tet child = t;
            for (const int e : kFaceEdges[f]) {
                if (kEdge[e][0] == corner) child[kEdge[e][1]] = m[e];
                if (kEdge[e][1] == corner) child[kEdge[e][0]] = m[e];
                if (kEdge[e][0] != corner && kEdge[e][1] != corner) inner[corner] = m[e];
            }
            children.push_back(child);
        }
        // Point-reflecting a triangle onto its midpoints keeps its orientation.
        children.push_back(inner);
        return;
    }
    MYOTET_CHECK(false, "a green pattern is closed");
}

}  // namespace myotet::lattice
