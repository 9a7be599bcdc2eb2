// SPDX-License-Identifier: Apache-2.0
#include "Cage/StarShape.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace myotet::cage {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Beyond this an exponential is less than 1e-5 of an angle at the level.
constexpr double kFaint = -12;

double grown(double x) { return x < kFaint ? 0 : std::exp(std::min(x, 300.0)); }

/// What the measures need: cosines of dihedral angles, and the aspect ratio.
struct Measures {
    std::array<double, 6> cosines;
    double aspect = 0;
};

// False when the tetrahedron is not positive.
bool measure(const Corners4& t, Measures& m) {
    const Vec3 a = t[1] - t[0], b = t[2] - t[0], c = t[3] - t[0];
    const Vec3 d = t[2] - t[1], e = t[3] - t[1], f = t[3] - t[2];
    // Outward normals opposite each corner, twice the face's area long; six times the volume.
    std::array<Vec3, 4> n{d.cross(e), c.cross(b), a.cross(c), b.cross(a)};
    const double volume = -n[3].dot(c);
    if (!(volume > 0)) return false;
    double widest = 0;
    for (Vec3& normal : n) {
        const double square = normal.squaredNorm();
        widest = std::max(widest, square);
        normal *= 1 / std::sqrt(square);
    }
    int k = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j) m.cosines[k++] = -n[i].dot(n[j]);
    const double longest = std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm(),
                                     d.squaredNorm(), e.squaredNorm(), f.squaredNorm()});
    m.aspect = std::sqrt(longest * widest) / volume;
    return true;
}

}  // namespace

Level level_of(double score, const Scale& scale) {
    return {std::cos(score * kDegree), std::cos((180 - score / scale.large) * kDegree),
            scale.slenderness / score};
}

double score_deg(const Corners4& t, const Scale& scale) {
    Measures m;
    if (!measure(t, m)) return 0;
    const auto [least, most] = std::ranges::minmax(m.cosines);
    const double smallest = std::acos(std::clamp(most, -1.0, 1.0)) / kDegree;
    const double largest = std::acos(std::clamp(least, -1.0, 1.0)) / kDegree;
    return std::min({smallest, scale.large * (180 - largest), scale.slenderness / m.aspect});
}

double badness(const Corners4& t, const Level& level) {
    Measures m;
    if (!measure(t, m)) return std::numeric_limits<double>::infinity();
    double sum = grown((m.aspect / level.aspect - 1) / (3 * kWidth));
    for (const double c : m.cosines)
        sum += grown((c - level.low) / kWidth) + grown((level.high - c) / kWidth);
    return sum;
}

Vec3 circumcentre(const Corners4& t) {
    const Vec3 a = t[1] - t[0], b = t[2] - t[0], c = t[3] - t[0];
    const Vec3 sum =
        a.squaredNorm() * b.cross(c) + b.squaredNorm() * c.cross(a) + c.squaredNorm() * a.cross(b);
    return t[0] + sum / (2 * a.dot(b.cross(c)));
}

}  // namespace myotet::cage
