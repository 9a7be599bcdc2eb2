// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/Spline.h"

#include <Eigen/Dense>
#include <algorithm>
#include <string>

#include "Core/Errors.h"
#include "Core/Text.h"

namespace myotet::skeleton {
namespace {

// The least integral of s''^2 (s'''^2) over the slopes (and bends) at the knots, the pieces
// being Hermite's. Its equations say that s'' (s''' and s'''') does not jump at a knot and is
// 0 at a natural end. D: slope between a piece's points, h: its length, p, m: slope and bend.

/// A piece's part of the equations of its two knots: [a b; b^T c] (first, second) = (f, g).
template <int N>
struct Piece {
    using Block = Eigen::Matrix<double, N, N>;
    using Column = Eigen::Matrix<double, N, 1>;
    Block a, b, c;
    Column f, g;
};

/// s''(0) = 6 D / h - (4 p0 + 2 p1) / h,  s''(h) = -6 D / h + (2 p0 + 4 p1) / h
void set_piece(double h, double d, Piece<1>& piece) {
    piece.a << 4 / h;
    piece.b << 2 / h;
    piece.c = piece.a;
    piece.f << 6 * d / h;
    piece.g = piece.f;
}

/// s'''(0) = 60 D / h^2 - (36 p0 + 24 p1) / h^2 - (9 m0 - 3 m1) / h
/// s''''(0) = -360 D / h^3 + (192 p0 + 168 p1) / h^3 + (36 m0 - 24 m1) / h^2,
/// and the same from the other end.
void set_piece(double h, double d, Piece<2>& piece) {
    const double h2 = h * h, h3 = h2 * h;
    piece.a << 192 / h3, 36 / h2, 36 / h2, 9 / h;
    piece.b << 168 / h3, -24 / h2, 24 / h2, -3 / h;
    piece.c << 192 / h3, -36 / h2, -36 / h2, 9 / h;
    piece.f << 360 * d / h3, 60 * d / h2;
    piece.g << 360 * d / h3, -60 * d / h2;
}

/// Slopes (and bends) at the knots, by elimination of a block tridiagonal matrix.
template <int N>
std::vector<Eigen::Matrix<double, N, 1>> solve(std::span<const double> x, std::span<const double> y,
                                               SplineEnds ends) {
    using Block = typename Piece<N>::Block;
    const std::size_t n = x.size();
    std::vector<Block> diagonal(n, Block::Zero()), upper(n, Block::Zero());
    std::vector<Eigen::Matrix<double, N, 1>> right(n, Eigen::Matrix<double, N, 1>::Zero());
    for (std::size_t i = 0; i + 1 < n; ++i) {
        Piece<N> piece;
        const double h = x[i + 1] - x[i];
        set_piece(h, (y[i + 1] - y[i]) / h, piece);
        diagonal[i] += piece.a;
        upper[i] = piece.b;
        diagonal[i + 1] += piece.c;
        right[i] += piece.f;
        right[i + 1] += piece.g;
    }
    if (ends == SplineEnds::at_rest) {
        diagonal[0] = diagonal[n - 1] = Block::Identity();
        right[0].setZero();
        right[n - 1].setZero();
        upper[0].setZero();
    }
    for (std::size_t i = 1; i < n; ++i) {
        const bool fixed = ends == SplineEnds::at_rest && i == n - 1;
        const Block factor = fixed ? Block(Block::Zero())
                                   : Block(upper[i - 1].transpose() * diagonal[i - 1].inverse());
        diagonal[i] -= factor * upper[i - 1];
        right[i] -= factor * right[i - 1];
    }
    right[n - 1] = diagonal[n - 1].inverse() * right[n - 1];
    for (std::size_t i = n - 1; i-- > 0;)
        right[i] = diagonal[i].inverse() * (right[i] - upper[i] * right[i + 1]);
    return right;
}

void check(std::span<const double> x, std::span<const double> y, int degree, SplineEnds ends) {
    if (degree != 3 && degree != 5)
        throw InputError("a spline of degree " + std::to_string(degree) +
                         " is not known; use 3 or 5");
    const std::size_t least = degree == 5 && ends == SplineEnds::natural ? 3 : 2;
    if (x.size() < least || y.size() != x.size())
        throw InputError("a spline of degree " + std::to_string(degree) + " needs at least " +
                         std::to_string(least) + " x and as many y, but has " +
                         std::to_string(x.size()) + " and " + std::to_string(y.size()));
    for (std::size_t i = 1; i < x.size(); ++i)
        if (!(x[i] > x[i - 1]))
            throw InputError("x of a spline must ascend, but " + shown(x[i]) + " follows " +
                             shown(x[i - 1]));
}

}  // namespace

Spline spline_through(std::span<const double> x, std::span<const double> y, int degree,
                      SplineEnds ends) {
    check(x, y, degree, ends);
    Spline spline{{x.begin(), x.end()}, {y.begin(), y.end()}, {}, {}};
    if (degree == 5) {
        for (const auto& knot : solve<2>(x, y, ends)) {
            spline.slope.push_back(knot[0]);
            spline.bend.push_back(knot[1]);
        }
        return spline;
    }
    for (const auto& knot : solve<1>(x, y, ends)) spline.slope.push_back(knot[0]);
    const auto& p = spline.slope;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const std::size_t k = std::min(i, x.size() - 2);  // the piece after it, or the last one
        const double h = x[k + 1] - x[k], d = (y[k + 1] - y[k]) / h;
        spline.bend.push_back(i == k ? (6 * d - 4 * p[k] - 2 * p[k + 1]) / h
                                     : (-6 * d + 2 * p[k] + 4 * p[k + 1]) / h);
    }
    return spline;
}

FunctionValue evaluate(const Spline& s, double x) {
    const auto after = std::upper_bound(s.x.begin() + 1, s.x.end() - 1, x);
    const auto i = static_cast<std::size_t>(after - s.x.begin()) - 1;
    // In t = (x - x0) / h the polynomial y0 + p0 t + m0 t^2 / 2 + c3 t^3 + c4 t^4 + c5 t^5.
    const double h = s.x[i + 1] - s.x[i], t = (x - s.x[i]) / h, rise = s.y[i + 1] - s.y[i];
    const double p0 = s.slope[i] * h, p1 = s.slope[i + 1] * h;
    const double m0 = s.bend[i] * h * h, m1 = s.bend[i + 1] * h * h;
    const double c3 = 10 * rise - 6 * p0 - 4 * p1 - 1.5 * m0 + 0.5 * m1;
    const double c4 = -15 * rise + 8 * p0 + 7 * p1 + 1.5 * m0 - m1;
    const double c5 = 6 * rise - 3 * p0 - 3 * p1 - 0.5 * m0 + 0.5 * m1;
    return {s.y[i] + t * (p0 + t * (m0 / 2 + t * (c3 + t * (c4 + t * c5)))),
            (p0 + t * (m0 + t * (3 * c3 + t * (4 * c4 + t * 5 * c5)))) / h,
            (m0 + t * (6 * c3 + t * (12 * c4 + t * 20 * c5))) / (h * h)};
}

}  // namespace myotet::skeleton
