// SPDX-License-Identifier: Apache-2.0
#include "Surface/Crossings.h"

#include <algorithm>
#include <cmath>

#include "Core/Parallel.h"

namespace myotet::surface {
namespace {

using Pair = std::array<std::int32_t, 2>;

constexpr std::size_t kGrain = 512;

/// A triangle's box in one of the cells that it touches.
struct Entry {
    Index3 cell{};
    std::int32_t triangle = 0;
    auto operator<=>(const Entry&) const = default;
};

struct Soup {
    std::span<const Vec3> points;
    std::span<const Triangle> triangles;
};

struct Boxes {
    std::vector<Box> of;  ///< a triangle
    double cell = 1;      ///< side, mm
    [[nodiscard]] Index3 cell_of(const Vec3& p) const {
        const Vec3 c = (p / cell).array().floor();
        return {static_cast<int>(c[0]), static_cast<int>(c[1]), static_cast<int>(c[2])};
    }
};

Boxes boxes_of(const Soup& mesh) {
    Boxes boxes;
    boxes.of.resize(mesh.triangles.size());
    double sum = 0, count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (mesh.triangles[t][0] < 0) continue;
        for (const std::int32_t v : mesh.triangles[t]) boxes.of[t].include(mesh.points[v]);
        sum += boxes.of[t].extent().maxCoeff();
        ++count;
    }
    // Most triangles then touch a few cells, and most cells hold a few triangles.
    if (sum > 0) boxes.cell = 1.5 * sum / count;
    return boxes;
}

std::vector<Entry> entries_of(const Boxes& boxes) {
    std::vector<Entry> entries;
    entries.reserve(3 * boxes.of.size());
    for (std::size_t t = 0; t < boxes.of.size(); ++t) {
        if (boxes.of[t].empty()) continue;
        const Index3 low = boxes.cell_of(boxes.of[t].min), high = boxes.cell_of(boxes.of[t].max);
        for (int k = low[2]; k <= high[2]; ++k)
            for (int j = low[1]; j <= high[1]; ++j)
                for (int i = low[0]; i <= high[0]; ++i)
                    entries.push_back({{i, j, k}, static_cast<std::int32_t>(t)});
    }
    std::ranges::sort(entries);
    return entries;
}

/// Whether the line through p and q meets the inside of the triangle (a, b, c).
bool line_meets(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
    const double ab = signed_volume(p, q, t[0], t[1]), bc = signed_volume(p, q, t[1], t[2]);
    if (!(ab * bc > 0)) return false;
    return signed_volume(p, q, t[2], t[0]) * ab > 0;
}

bool has(const Triangle& t, std::int32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

/// Whether an edge of `s` with no end on `t` passes through `t`.
bool pierces(const Placed& s, const Placed& t) {
    const Vec3 normal = (t.at[1] - t.at[0]).cross(t.at[2] - t.at[0]);
    std::array<double, 3> side;
    for (int i = 0; i < 3; ++i) side[i] = normal.dot(s.at[i] - t.at[0]);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (side[i] * side[j] < 0 && !has(t.points, s.points[i]) && !has(t.points, s.points[j]) &&
            line_meets(s.at[i], s.at[j], t.at))
            return true;
    }
    return false;
}

Placed placed(const Soup& mesh, std::int32_t t) {
    const Triangle& f = mesh.triangles[t];
    return {f, {mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]}};
}

/// Whether two boxes meet, and this is the one cell in which to say so.
bool meet_first_in(const Index3& cell, const Boxes& boxes, std::int32_t a, std::int32_t b) {
    const Vec3 low = boxes.of[a].min.cwiseMax(boxes.of[b].min);
    const Vec3 high = boxes.of[a].max.cwiseMin(boxes.of[b].max);
    return (low.array() <= high.array()).all() && boxes.cell_of(low) == cell;
}

}  // namespace

bool cross(const Placed& a, const Placed& b) {
    const int shared =
        has(b.points, a.points[0]) + has(b.points, a.points[1]) + has(b.points, a.points[2]);
    return shared < 2 && (pierces(a, b) || pierces(b, a));
}

std::vector<Pair> crossings(std::span<const Vec3> points, std::span<const Triangle> triangles) {
    const Soup mesh{points, triangles};
    const Boxes boxes = boxes_of(mesh);
    const std::vector<Entry> entries = entries_of(boxes);
    std::vector<std::vector<Pair>> found(entries.size() / kGrain + 1);
    parallel_for(0, found.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t part = first; part < last; ++part) {
            const std::size_t end = std::min(entries.size(), (part + 1) * kGrain);
            for (std::size_t i = part * kGrain; i < end; ++i)
                for (std::size_t j = i + 1;
                     j < entries.size() && entries[j].cell == entries[i].cell; ++j) {
                    const std::int32_t a = entries[i].triangle, b = entries[j].triangle;
                    if (meet_first_in(entries[i].cell, boxes, a, b) &&
                        cross(placed(mesh, a), placed(mesh, b)))
                        found[part].push_back({a, b});
                }
        }
    });
    std::vector<Pair> pairs;
    for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
    std::ranges::sort(pairs);
    return pairs;
}

void append(TriMesh& whole, const TriMesh& part) {
    const auto first = static_cast<std::int32_t>(whole.points.size());
    whole.points.insert(whole.points.end(), part.points.begin(), part.points.end());
    for (const Triangle& t : part.triangles)
        whole.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

TriMesh joined(std::span<const Vec3> points, std::span<const Triangle> triangles,
               const TriMesh& beside) {
    TriMesh both{{points.begin(), points.end()}, {triangles.begin(), triangles.end()}};
    append(both, beside);
    return both;
}

std::vector<Pair> crossings(std::span<const Vec3> points, std::span<const Triangle> triangles,
                            const TriMesh& beside) {
    if (beside.triangles.empty()) return crossings(points, triangles);
    const TriMesh both = joined(points, triangles, beside);
    std::vector<Pair> pairs = crossings(both.points, both.triangles);
    std::erase_if(pairs, [own = static_cast<std::int32_t>(triangles.size())](const Pair& pair) {
        return pair[0] >= own;
    });
    return pairs;
}

}  // namespace myotet::surface
