// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/LevelSet.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace myotet::levelset {
namespace {

// A cell of eight samples and where in it a point lies.
struct Cell {
    const float* corner;  // sample (0, 0, 0)
    std::ptrdiff_t dy, dz;
    Vec3 t;  // fractions in [0, 1]
    double inverse_spacing;
};

// Inlined by force: the hot loop of all meshing.
[[gnu::always_inline]] inline Sample interpolate(const Cell& cell) {
    const float* p = cell.corner;
    const double x = cell.t.x(), y = cell.t.y(), z = cell.t.z();
    const double d00 = p[1] - p[0];
    const double d10 = p[cell.dy + 1] - p[cell.dy];
    const double d01 = p[cell.dz + 1] - p[cell.dz];
    const double d11 = p[cell.dy + cell.dz + 1] - p[cell.dy + cell.dz];
    const double v00 = p[0] + x * d00, v10 = p[cell.dy] + x * d10;
    const double v01 = p[cell.dz] + x * d01, v11 = p[cell.dy + cell.dz] + x * d11;
    const double v0 = v00 + y * (v10 - v00), v1 = v01 + y * (v11 - v01);
    const double dx0 = d00 + y * (d10 - d00), dx1 = d01 + y * (d11 - d01);
    Sample s;
    s.value = v0 + z * (v1 - v0);
    s.gradient =
        cell.inverse_spacing *
        Vec3(dx0 + z * (dx1 - dx0), (v10 - v00) + z * ((v11 - v01) - (v10 - v00)), v1 - v0);
    return s;
}

// The largest of the pieces at t.
Sample largest_piece(std::span<const std::array<float, 8>> pieces, const Vec3& t,
                     double inverse_spacing) {
    Sample largest;
    largest.value = -std::numeric_limits<double>::infinity();
    for (const auto& piece : pieces) {
        const Sample s = interpolate({piece.data(), 2, 4, t, inverse_spacing});
        if (s.value > largest.value) largest = s;
    }
    return largest;
}

Sample sample_coarse(const LevelSet& phi, const Vec3& point) {
    const Vec3 c = (point - phi.origin) / phi.coarse_spacing;
    Index3 coarse;
    for (int a = 0; a < 3; ++a)
        coarse[a] = std::clamp(static_cast<int>(c[a]), 0, phi.coarse_size[a] - 2);
    const std::ptrdiff_t dy = phi.coarse_size[0], dz = dy * phi.coarse_size[1];
    return interpolate({phi.coarse_values.data() + coarse[2] * dz + coarse[1] * dy + coarse[0], dy,
                        dz, c - Vec3(coarse[0], coarse[1], coarse[2]), 1 / phi.coarse_spacing});
}

// At a point of the box.
[[gnu::always_inline]] inline Sample sample_inside(const LevelSet& phi, const Vec3& point) {
    const double per_spacing = 1 / phi.spacing;
    const Vec3 g = (point - phi.origin) * per_spacing;
    Index3 cell, brick;
    for (int a = 0; a < 3; ++a) {
        cell[a] = std::clamp(static_cast<int>(g[a]), 0, phi.bricks[a] * LevelSet::kBrickCells - 1);
        brick[a] = cell[a] / LevelSet::kBrickCells;
    }
    const std::size_t slot =
        (static_cast<std::size_t>(brick[2]) * phi.bricks[1] + brick[1]) * phi.bricks[0] + brick[0];
    const std::int32_t number = phi.brick_of[slot];
    if (number < 0) return sample_coarse(phi, point);
    constexpr int n = LevelSet::kBrickSamples, m = LevelSet::kBrickCells - 1;
    const Vec3 t = g - Vec3(cell[0], cell[1], cell[2]);
    for (int& c : cell) c &= m;
    if (number >= phi.first_seamed)
        if (const auto pieces = phi.pieces_at(number, cell[0], cell[1], cell[2]); !pieces.empty())
            return largest_piece(pieces, t, per_spacing);
    const std::size_t at = (static_cast<std::size_t>(cell[2]) * n + cell[1]) * n + cell[0];
    return interpolate(
        {phi.values.data() + static_cast<std::size_t>(number) * LevelSet::kBrickSize + at, n, n * n,
         t, per_spacing});
}

}  // namespace

Box LevelSet::box() const {
    Box b;
    b.min = origin;
    b.max = origin + spacing * kBrickCells * Vec3(bricks[0], bricks[1], bricks[2]);
    return b;
}

std::size_t LevelSet::memory() const {
    return sizeof(float) * (values.capacity() + coarse_values.capacity()) +
           sizeof(std::int32_t) * brick_of.capacity() + sizeof(Seamed) * seamed.capacity() +
           sizeof(std::uint32_t) * pieces_of.capacity() +
           sizeof(std::array<float, 8>) * pieces.capacity();
}

Sample LevelSet::sample(const Vec3& point) const {
    const Vec3 g = point - origin;
    const double brick = spacing * kBrickCells;
    if (g.x() >= 0 && g.y() >= 0 && g.z() >= 0 && g.x() <= brick * bricks[0] &&
        g.y() <= brick * bricks[1] && g.z() <= brick * bricks[2])
        return sample_inside(*this, point);
    const Box b = box();
    const Vec3 inside = point.cwiseMax(b.min).cwiseMin(b.max);
    Sample s = sample_inside(*this, inside);
    const Vec3 away = point - inside;
    const double distance = away.norm();
    if (distance > 0) {
        s.value += distance;
        s.gradient = away / distance;
    }
    return s;
}

double LevelSet::value(const Vec3& point) const { return sample(point).value; }

std::array<double, 2> principal_curvatures(const LevelSet& phi, const Vec3& point, double step) {
    // H: Hessian of phi; N = grad phi / |grad phi|; P = I - N N^T; the two
    // eigenvalues of P H P / |grad phi| that do not belong to N [Teran05, sec. 5].
    const double centre = phi.value(point);
    Vec3 gradient;
    Mat3 hessian;
    std::array<double, 6> axis;
    for (int a = 0; a < 3; ++a) {
        const Vec3 e = step * Vec3::Unit(a);
        axis[2 * a] = phi.value(point + e);
        axis[2 * a + 1] = phi.value(point - e);
        gradient[a] = (axis[2 * a] - axis[2 * a + 1]) / (2 * step);
        hessian(a, a) = (axis[2 * a] - 2 * centre + axis[2 * a + 1]) / (step * step);
    }
    for (int a = 0; a < 3; ++a)
        for (int b = a + 1; b < 3; ++b) {
            const Vec3 p = step * (Vec3::Unit(a) + Vec3::Unit(b));
            const Vec3 m = step * (Vec3::Unit(a) - Vec3::Unit(b));
            hessian(a, b) = hessian(b, a) = (phi.value(point + p) + phi.value(point - p) -
                                             phi.value(point + m) - phi.value(point - m)) /
                                            (4 * step * step);
        }
    const double length = gradient.norm();
    if (!(length > 1e-6)) return {0, 0};
    const Vec3 n = gradient / length;
    const Vec3 u = n.unitOrthogonal(), v = n.cross(u);
    Eigen::Matrix2d s;
    s << u.dot(hessian * u), u.dot(hessian * v), v.dot(hessian * u), v.dot(hessian * v);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(s / length, Eigen::EigenvaluesOnly);
    return {solver.eigenvalues()[1], solver.eigenvalues()[0]};
}

}  // namespace myotet::levelset
