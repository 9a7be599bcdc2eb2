// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/Extract.h"

#include <algorithm>
#include <unordered_map>

#include "Core/Errors.h"
#include "LevelSet/ExtractTable.h"

namespace myotet::levelset {
namespace {

constexpr int kCells = LevelSet::kBrickCells, kSamples = LevelSet::kBrickSamples;
// Rounds of evening out, and the share of a spacing that one may move a vertex:
// enough for triangles without needles.
constexpr int kRounds = 3;
constexpr double kMostMove = 0.5;

class Extractor {
public:
    explicit Extractor(const LevelSet& phi)
        : phi_(phi),
          first_(phi.values.size() / LevelSet::kBrickSize * kCells * kCells * kCells, -1) {}

    TriMesh run() {
        place_vertices();
        join_quads();
        for (Vec3& p : mesh_.points) pull(p);
        for (int round = 0; round < kRounds; ++round) even_out();
        return std::move(mesh_);
    }

private:
    // Cells and samples are numbered through all bricks, i fastest.
    [[nodiscard]] std::int64_t cell_key(const Index3& c) const {
        return (static_cast<std::int64_t>(c[2]) * phi_.bricks[1] * kCells + c[1]) * phi_.bricks[0] *
                   kCells +
               c[0];
    }
    [[nodiscard]] std::int32_t brick_at(const Index3& c) const {
        for (int a = 0; a < 3; ++a)
            if (c[a] < 0 || c[a] >= phi_.bricks[a] * kCells) return -1;
        return phi_
            .brick_of[(static_cast<std::size_t>(c[2] / kCells) * phi_.bricks[1] + c[1] / kCells) *
                          phi_.bricks[0] +
                      c[0] / kCells];
    }
    [[nodiscard]] const float* samples(std::int32_t brick, const Index3& c) const {
        return phi_.values.data() + static_cast<std::size_t>(brick) * LevelSet::kBrickSize +
               (c[2] % kCells * kSamples + c[1] % kCells) * kSamples + c[0] % kCells;
    }
    [[nodiscard]] static std::size_t place(std::int32_t brick, const Index3& c) {
        return static_cast<std::size_t>(brick) * kCells * kCells * kCells +
               (c[2] % kCells * kCells + c[1] % kCells) * kCells + c[0] % kCells;
    }
    [[nodiscard]] static int offset(int corner) {
        return ((corner >> 2) * kSamples + (corner >> 1 & 1)) * kSamples + (corner & 1);
    }
    [[nodiscard]] static int inside_of(const float* s) {
        int inside = 0;
        for (int c = 0; c < 8; ++c) inside |= (s[offset(c)] < 0) << c;
        return inside;
    }
    // Where an edge of the cell crosses zero, in spacings from the cell's corner.
    [[nodiscard]] static Vec3 crossing(const float* s, int edge) {
        const int axis = edge / 4, low = edge_low(edge);
        const double a = s[offset(low)], b = s[offset(low | 1 << axis)];
        Vec3 p(low & 1, low >> 1 & 1, low >> 2);
        p[axis] = a / (a - b);
        return p;
    }
    [[nodiscard]] Vec3 position(const Index3& c, const Vec3& within) const {
        return phi_.origin + phi_.spacing * (Vec3(c[0], c[1], c[2]) + within);
    }

    template <class Body>
    void each_cell(Body&& body) const {
        for (int bk = 0; bk < phi_.bricks[2]; ++bk)
            for (int bj = 0; bj < phi_.bricks[1]; ++bj)
                for (int bi = 0; bi < phi_.bricks[0]; ++bi) {
                    const Index3 low{bi * kCells, bj * kCells, bk * kCells};
                    const std::int32_t brick = brick_at(low);
                    if (brick < 0) continue;
                    for (int at = 0; at < kCells * kCells * kCells; ++at) {
                        const Index3 c{low[0] + at % kCells, low[1] + at / kCells % kCells,
                                       low[2] + at / (kCells * kCells)};
                        const float* s = samples(brick, c);
                        const int inside = inside_of(s);
                        if (inside != 0 && inside != 255) body(c, s, inside);
                    }
                }
    }

    // One vertex a loop, at the mean of its crossings.
    void place_vertices() {
        const auto& cuts = cell_cuts();
        each_cell([&](const Index3& c, const float* s, int inside) {
            const CellCut& cut = cuts[inside];
            std::array<Vec3, 3> sum;
            std::array<int, 3> count{};
            sum.fill(Vec3::Zero());
            for (int edge = 0; edge < 12; ++edge)
                if (const int loop = cut.loop_of[edge]; loop != CellCut::kUncut) {
                    sum[loop] += crossing(s, edge);
                    ++count[loop];
                }
            first_[place(brick_at(c), c)] = static_cast<std::int32_t>(mesh_.points.size());
            for (int loop = 0; loop < cut.loops; ++loop)
                mesh_.points.push_back(position(c, sum[loop] / count[loop]));
        });
        MYOTET_CHECK(mesh_.points.size() < (std::size_t{1} << 31), "a surface has too many nodes");
    }

    struct Cut {
        std::int32_t first;  // vertex of loop 0
        int inside;
    };
    [[nodiscard]] Cut cut_of(const Index3& c) const {
        const std::int32_t brick = brick_at(c);
        MYOTET_CHECK(brick >= 0, "the zero set leaves the bricks that hold it");
        return {first_[place(brick, c)], inside_of(samples(brick, c))};
    }

    // Each cell makes the quadrilaterals around the edges at its lowest corner,
    // which all cut edges are of some cell.
    void join_quads() {
        each_cell([&](const Index3& c, const float*, int inside) {
            for (int axis = 0; axis < 3; ++axis) {
                const bool low = inside & 1, high = inside >> (1 << axis) & 1;
                if (low != high) join_around(c, axis, low);
            }
        });
    }

    void join_around(const Index3& c, int axis, bool outward_is_up) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        constexpr int step[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        std::array<Index3, 4> cell;
        std::array<Cut, 4> cut;
        std::array<int, 4> edge;
        for (int q = 0; q < 4; ++q) {
            cell[q] = c;
            cell[q][u] -= step[q][0];
            cell[q][v] -= step[q][1];
            cut[q] = cut_of(cell[q]);
            edge[q] = edge_of(axis, step[q][0] << u | step[q][1] << v);
        }
        const auto& cuts = cell_cuts();
        std::array<std::int32_t, 8> polygon;
        int n = 0, at_middle = 0;
        for (int q = 0; q < 4; ++q) {
            const int r = (q + 1) % 4, across = step[q][0] != step[r][0] ? u : v;
            polygon[n++] = cut[q].first + cuts[cut[q].inside].loop_of[edge[q]];
            // The lower side of the upper cell is the upper side of the lower.
            const bool up = cell[q][across] > cell[r][across];
            const Index3& upper = up ? cell[q] : cell[r];
            const Cut &above = up ? cut[q] : cut[r], &below = up ? cut[r] : cut[q];
            if ((cuts[above.inside].twice >> (2 * across) & 1) &&
                (cuts[below.inside].twice >> (2 * across + 1) & 1))
                polygon[at_middle = n++] = middle(upper, across, up ? edge[q] : edge[r]);
        }
        if (!outward_is_up) {
            std::reverse(polygon.begin(), polygon.begin() + n);
            at_middle = n - 1 - at_middle;
        }
        fill(polygon, n, at_middle);
    }

    // Two cells that meet twice in one face get a vertex on each of its two
    // curves, or one edge would have four triangles. Each curve goes round one
    // corner beside the face's diagonal.
    std::int32_t middle(const Index3& cell, int across, int edge) {
        const int axis = edge / 4, other = 3 - across - axis;
        // The edge runs from the low corner or into the high one.
        const bool from_low = (edge_low(edge) >> other & 1) == 0;
        const int beside = from_low ? axis : other;  // the corner, seen from the low one
        const auto [it, is_new] = middles_.try_emplace(3 * (3 * cell_key(cell) + across) + beside,
                                                       static_cast<std::int32_t>(0));
        if (is_new) {
            const float* s = samples(brick_at(cell), cell);
            it->second = static_cast<std::int32_t>(mesh_.points.size());
            const int second = beside == axis ? other : axis;
            mesh_.points.push_back(
                position(cell, 0.5 * (crossing(s, edge_of(beside, 0)) +
                                      crossing(s, edge_of(second, 1 << beside)))));
        }
        return it->second;
    }

    // A quadrilateral is split across its shorter diagonal. A larger polygon
    // opens as a fan from a middle: cells that need one must not be joined.
    void fill(const std::array<std::int32_t, 8>& polygon, int n, int middle) {
        const auto& p = mesh_.points;
        int start = middle;
        if (n == 4)
            start = (p[polygon[0]] - p[polygon[2]]).squaredNorm() >
                    (p[polygon[1]] - p[polygon[3]]).squaredNorm();
        for (int i = 1; i + 1 < n; ++i)
            mesh_.triangles.push_back(
                {polygon[start], polygon[(start + i) % n], polygon[(start + i + 1) % n]});
    }

    // Newton steps along the gradient of the interpolant; a point that does not
    // get nearer stays where it was.
    void pull(Vec3& p) const {
        Vec3 q = p;
        const double before = std::abs(phi_.value(p));
        for (int step = 0; step < 3; ++step) {
            const Sample s = phi_.sample(q);
            const double slope = s.gradient.squaredNorm();
            if (!(slope > 0.01)) break;
            q -= s.value / slope * s.gradient;
        }
        if ((q - p).norm() < kMostMove * phi_.spacing && std::abs(phi_.value(q)) < before) p = q;
    }

    void even_out() {
        std::vector<Vec3> sum(mesh_.points.size(), Vec3::Zero());
        std::vector<int> count(mesh_.points.size(), 0);
        for (const Triangle& t : mesh_.triangles)
            for (int e = 0; e < 3; ++e) {
                sum[t[e]] += mesh_.points[t[(e + 1) % 3]];
                ++count[t[e]];
            }
        for (std::size_t i = 0; i < sum.size(); ++i) {
            Vec3& p = mesh_.points[i];
            const Vec3 normal = phi_.sample(p).gradient.normalized();
            Vec3 move = sum[i] / count[i] - p;
            move -= move.dot(normal) * normal;
            const double most = kMostMove * phi_.spacing;
            if (!(move.norm() < most)) continue;
            p += 0.5 * move;
            pull(p);
        }
    }

    const LevelSet& phi_;
    TriMesh mesh_;
    std::vector<std::int32_t> first_;  // per cell of stored bricks: its first vertex
    std::unordered_map<std::int64_t, std::int32_t> middles_;
};

}  // namespace

TriMesh extract_surface(const LevelSet& phi) { return Extractor(phi).run(); }

}  // namespace myotet::levelset
