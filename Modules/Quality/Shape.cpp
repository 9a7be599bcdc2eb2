// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "Core/Parallel.h"
#include "Quality/Quality.h"

namespace myotet::quality {
namespace {

constexpr std::size_t kGrain = 4096;

struct Partial {
    ShapeSummary worst{180, 0, 0, 0, 0};
    double sum = 0;
};

Partial measure_range(const TetMesh& mesh, std::size_t first, std::size_t last) {
    Partial p;
    for (std::size_t i = first; i < last; ++i) {
        const Tet& t = mesh.tets[i];
        const Shape s =
            measure(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]], mesh.points[t[3]]);
        p.worst.min_dihedral_deg = std::min(p.worst.min_dihedral_deg, s.min_dihedral_deg);
        p.worst.max_dihedral_deg = std::max(p.worst.max_dihedral_deg, s.max_dihedral_deg);
        p.worst.max_aspect_ratio = std::max(p.worst.max_aspect_ratio, s.aspect_ratio);
        p.sum += s.aspect_ratio;
        if (!(s.volume > 0)) ++p.worst.inverted_tets;
    }
    return p;
}

}  // namespace

Shape measure(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3* x[4] = {&a, &b, &c, &d};
    // Area vectors: |normal| = 2 * area of the face opposite node i.
    const Vec3 normal[4] = {(d - b).cross(c - b), (c - a).cross(d - a), (d - a).cross(b - a),
                            (b - a).cross(c - a)};
    const double six_volume = (b - a).cross(c - a).dot(d - a);
    double length[4], largest = 0;
    for (int i = 0; i < 4; ++i) {
        length[i] = normal[i].norm();
        largest = std::max(largest, length[i]);
    }
    Shape s;
    s.volume = six_volume / 6;
    s.min_dihedral_deg = 180;
    double longest = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j) {
            longest = std::max(longest, (*x[i] - *x[j]).squaredNorm());
            int k = 0;
            while (k == i || k == j) ++k;
            const int l = 6 - i - j - k;
            // Dihedral at edge (i, j): between the half planes of k and l.
            const Vec3 e = (*x[j] - *x[i]).normalized();
            const Vec3 u = (*x[k] - *x[i]) - e * e.dot(*x[k] - *x[i]);
            const Vec3 v = (*x[l] - *x[i]) - e * e.dot(*x[l] - *x[i]);
            const double angle = std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::numbers::pi;
            s.min_dihedral_deg = std::min(s.min_dihedral_deg, angle);
            s.max_dihedral_deg = std::max(s.max_dihedral_deg, angle);
        }
    // Shortest altitude = 3 V / largest face area = six_volume / largest.
    s.aspect_ratio = six_volume > 0 ? std::sqrt(longest) * largest / six_volume
                                    : std::numeric_limits<double>::infinity();
    return s;
}

ShapeSummary measure_shapes(const TetMesh& mesh) {
    const std::size_t pieces = (mesh.tets.size() + kGrain - 1) / kGrain;
    std::vector<Partial> parts(pieces);
    parallel_for(0, pieces, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            parts[i] =
                measure_range(mesh, i * kGrain, std::min(mesh.tets.size(), (i + 1) * kGrain));
    });
    ShapeSummary total{180, 0, 0, 0, 0};
    double sum = 0;
    for (const Partial& p : parts) {
        total.min_dihedral_deg = std::min(total.min_dihedral_deg, p.worst.min_dihedral_deg);
        total.max_dihedral_deg = std::max(total.max_dihedral_deg, p.worst.max_dihedral_deg);
        total.max_aspect_ratio = std::max(total.max_aspect_ratio, p.worst.max_aspect_ratio);
        total.inverted_tets += p.worst.inverted_tets;
        sum += p.sum;
    }
    if (!mesh.tets.empty()) total.mean_aspect_ratio = sum / static_cast<double>(mesh.tets.size());
    return total;
}

}  // namespace myotet::quality
