// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/FarField.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Core/Parallel.h"
#include "LevelSet/Redistance.h"

namespace myotet::levelset {
namespace {

using Point = Eigen::Vector3f;  // in fine spacings from the band's origin

constexpr float kUnknown = std::numeric_limits<float>::infinity();

// Nearest interface points of the coarse samples.
struct Lattice {
    Index3 size;
    std::vector<Point> foot;
    std::vector<float> squared;  // distance to the foot, fine spacings squared
    std::vector<float> value;    // what is returned, mm; only its sign counts until finish()
    std::vector<char> known;     // the band holds the value

    [[nodiscard]] std::size_t at(int i, int j, int k) const {
        return (static_cast<std::size_t>(k) * size[1] + j) * size[0] + i;
    }
    static Point place(int i, int j, int k) {
        return Point(float(i), float(j), float(k)) * float(kCoarseStep);
    }
};

void seed(const Band& band, Lattice& lattice, int k) {
    constexpr int n = Band::kSide;
    for (int j = 0; j < lattice.size[1]; ++j)
        for (int i = 0; i < lattice.size[0]; ++i) {
            const std::size_t here = lattice.at(i, j, k);
            const int x = i * kCoarseStep, y = j * kCoarseStep, z = k * kCoarseStep;
            const std::int32_t number = band.find({x / n, y / n, z / n});
            const float v = number >= 0 ? band.block(number)[((z % n) * n + y % n) * n + x % n]
                                        : band.empty_value(number);
            lattice.value[here] = v;
            lattice.known[here] = std::abs(v) < band.width;
            lattice.squared[here] = kUnknown;
            if (!lattice.known[here]) continue;
            const Point p = Lattice::place(i, j, k);
            Vec3 foot = band.origin + band.spacing * p.cast<double>();
            if (!pull(band, foot)) continue;
            lattice.foot[here] = ((foot - band.origin) / band.spacing).cast<float>();
            lattice.squared[here] = (p - lattice.foot[here]).squaredNorm();
        }
}

// One pass in the direction (sx, sy, sz): every sample tries the feet of its
// three neighbours upstream.
void sweep(Lattice& lattice, const Index3& direction) {
    const auto range = [&](int a, int step) {
        return direction[a] > 0 ? step : lattice.size[a] - 1 - step;
    };
    for (int c = 0; c < lattice.size[2]; ++c)
        for (int b = 0; b < lattice.size[1]; ++b)
            for (int a = 0; a < lattice.size[0]; ++a) {
                const int i = range(0, a), j = range(1, b), k = range(2, c);
                const std::size_t here = lattice.at(i, j, k);
                const Point p = Lattice::place(i, j, k);
                const auto offer = [&](std::size_t from) {
                    if (lattice.squared[from] == kUnknown) return;
                    const float d = (p - lattice.foot[from]).squaredNorm();
                    if (d < lattice.squared[here]) {
                        lattice.squared[here] = d;
                        lattice.foot[here] = lattice.foot[from];
                    }
                };
                if (a > 0) offer(lattice.at(i - direction[0], j, k));
                if (b > 0) offer(lattice.at(i, j - direction[1], k));
                if (c > 0) offer(lattice.at(i, j, k - direction[2]));
            }
}

void sweep_all(Lattice& lattice) {
    for (int code = 0; code < 8; ++code)
        sweep(lattice, {code & 1 ? -1 : 1, code & 2 ? -1 : 1, code & 4 ? -1 : 1});
}

// A foot inherited from a neighbour is a few fine spacings off along the
// interface.
void slide_feet(const Band& band, Lattice& lattice, int k) {
    constexpr int kSteps = 3;
    for (int j = 0; j < lattice.size[1]; ++j)
        for (int i = 0; i < lattice.size[0]; ++i) {
            const std::size_t here = lattice.at(i, j, k);
            if (lattice.squared[here] == kUnknown) continue;
            const Point p = Lattice::place(i, j, k);
            const auto in_mm = [&](const Point& q) {
                return Vec3(band.origin + band.spacing * q.cast<double>());
            };
            Vec3 foot = in_mm(lattice.foot[here]);
            slide(band, in_mm(p), kSteps, foot);
            lattice.foot[here] = ((foot - band.origin) / band.spacing).cast<float>();
            lattice.squared[here] = (p - lattice.foot[here]).squaredNorm();
        }
}

}  // namespace

FarField far_field(const Band& band) {
    Lattice lattice;
    constexpr int per_block = Band::kSide / kCoarseStep;
    for (int a = 0; a < 3; ++a) lattice.size[a] = per_block * band.blocks[a] + 1;
    const std::size_t count =
        static_cast<std::size_t>(lattice.size[0]) * lattice.size[1] * lattice.size[2];
    lattice.foot.assign(count, Point::Zero());
    lattice.squared.assign(count, kUnknown);
    lattice.value.assign(count, 0.0f);
    lattice.known.assign(count, 0);
    const auto each_layer = [&](auto&& body) {
        parallel_for(0, lattice.size[2], 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t k = first; k < last; ++k) body(static_cast<int>(k));
        });
    };
    each_layer([&](int k) { seed(band, lattice, k); });
    sweep_all(lattice);
    each_layer([&](int k) { slide_feet(band, lattice, k); });
    sweep_all(lattice);
    each_layer([&](int k) { slide_feet(band, lattice, k); });
    for (std::size_t i = 0; i < count; ++i)
        if (!lattice.known[i]) {
            const double d = std::sqrt(double(lattice.squared[i])) * band.spacing;
            // What lies beyond the band is at least its width away.
            const double far = std::max(d, double(band.width));
            lattice.value[i] = static_cast<float>(lattice.value[i] < 0 ? -far : far);
        }
    return {lattice.size, std::move(lattice.value), std::move(lattice.foot)};
}

}  // namespace myotet::levelset
