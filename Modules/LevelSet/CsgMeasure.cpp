// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/CsgMeasure.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "LevelSet/Csg.h"
#include "LevelSet/CsgTable.h"
#include "LevelSet/Measure.h"

namespace myotet::levelset {
namespace {

constexpr int kSide = Band::kSide;
constexpr int kSize = Band::kSize;

// Calls body(sample, part) for all samples of which a part is inside, samples
// counted along the lattice from the band's origin.
template <class Body>
void each_inside_sample(const Band& band, Body&& body) {
    const float h = static_cast<float>(band.spacing);
    std::size_t slot = 0;
    for (int k = 0; k < band.blocks[2]; ++k)
        for (int j = 0; j < band.blocks[1]; ++j)
            for (int i = 0; i < band.blocks[0]; ++i, ++slot) {
                const std::int32_t number = band.block_of[slot];
                if (number == Band::kOutside) continue;
                for (int at = 0; at < kSize; ++at) {
                    const double part =
                        number == Band::kInside
                            ? 1.0
                            : std::clamp(0.5 - band.block(number)[at] / h, 0.0, 1.0);
                    if (part > 0)
                        body(Vec3(i * kSide + at % kSide, j * kSide + at / kSide % kSide,
                                  k * kSide + at / (kSide * kSide)),
                             part);
                }
            }
}

}  // namespace

double enclosed_volume(const Band& band) {
    constexpr int n = kSide + 1;
    std::array<float, n * n * n> phi;
    double count = 0;
    for (const std::int32_t number : band.block_of)
        if (number == Band::kInside) count += kSize;
    for (std::size_t b = 0; b < band.position.size(); ++b) {
        gather(band, band.position[b], 0, 1, phi.data());
        for (int k = 0; k < kSide; ++k)
            for (int j = 0; j < kSide; ++j)
                for (int i = 0; i < kSide; ++i) {
                    const float* p = phi.data() + (k * n + j) * n + i;
                    count += inside_fraction({p[0], p[1], p[n], p[n + 1], p[n * n], p[n * n + 1],
                                              p[n * n + n], p[n * n + n + 1]});
                }
    }
    return count * std::pow(band.spacing, 3);
}

double volume_beyond(const Band& a, const Band& b) {
    return enclosed_volume(
        merge({&a, &b}, Extent::first, [](const float* v) { return std::max(v[0], -v[1]); }));
}

PrincipalAxes principal_axes(const Band& band) {
    double mass = 0;
    Vec3 first = Vec3::Zero();
    each_inside_sample(band, [&](const Vec3& p, double part) {
        mass += part;
        first += part * p;
    });
    const Vec3 mean = first / mass;
    Mat3 second = Mat3::Zero();
    each_inside_sample(band, [&](const Vec3& p, double part) {
        second += part * (p - mean) * (p - mean).transpose();
    });
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(second / mass);
    PrincipalAxes out;
    out.centroid = band.origin + band.spacing * mean;
    for (int a = 0; a < 3; ++a) {
        out.axes.col(a) = solver.eigenvectors().col(2 - a);
        out.deviation[a] = band.spacing * std::sqrt(std::max(solver.eigenvalues()[2 - a], 0.0));
    }
    if (out.axes.determinant() < 0) out.axes.col(2) = -out.axes.col(2);
    return out;
}

namespace {

constexpr int kApron = 2;
constexpr int kPadded = kSide + 2 * kApron;
constexpr int kSteps[3] = {1, kPadded, kPadded* kPadded};

// |n_axis| of the wall between two neighbouring samples: of the direction in
// which a - b changes most, by central differences at both.
double facing(const std::vector<float>& difference, int here, int there, int axis) {
    Vec3 gradient;
    for (int a = 0; a < 3; ++a)
        gradient[a] = difference[here + kSteps[a]] - difference[here - kSteps[a]] +
                      difference[there + kSteps[a]] - difference[there - kSteps[a]];
    const double length = gradient.norm();
    return length > 0 ? std::abs(gradient[axis]) / length : 0;
}

}  // namespace

Contact contact(const Band& a, const Band& b) {
    constexpr std::size_t count = std::size_t{kPadded} * kPadded * kPadded;
    const Index3 offset = block_offset(a, b);
    std::vector<float> in_a(count), in_b(count), difference(count);
    double faces = 0;
    Vec3 sum = Vec3::Zero();
    for (const Index3& p : a.position) {
        gather(a, p, kApron, kApron, in_a.data());
        gather(b, {p[0] - offset[0], p[1] - offset[1], p[2] - offset[2]}, kApron, kApron,
               in_b.data());
        for (std::size_t i = 0; i < count; ++i) difference[i] = in_a[i] - in_b[i];
        for (int at = 0; at < kSize; ++at) {
            const Vec3 q(at % kSide, at / kSide % kSide, at / (kSide * kSide));
            const int here =
                ((at / (kSide * kSide) + kApron) * kPadded + at / kSide % kSide + kApron) *
                    kPadded +
                at % kSide + kApron;
            if (!(in_a[here] < 0) || in_b[here] < 0) continue;
            for (int axis = 0; axis < 3; ++axis)
                for (const int side : {-1, 1}) {
                    const int there = here + side * kSteps[axis];
                    if (!(in_b[there] < 0) || in_a[there] < 0) continue;
                    const double face = facing(difference, here, there, axis);
                    faces += face;
                    sum +=
                        face * (kSide * Vec3(p[0], p[1], p[2]) + q + 0.5 * side * Vec3::Unit(axis));
                }
        }
    }
    if (!(faces > 0)) return {};
    return {faces * a.spacing * a.spacing, a.origin + a.spacing / faces * sum};
}

}  // namespace myotet::levelset
