// SPDX-License-Identifier: Apache-2.0
#include "Phantoms/Shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace myotet::phantoms {
namespace {

constexpr std::array kWidths{&Station::x, &Station::y, &Station::half_x, &Station::half_y};
// Halves the bracket below the spacing of doubles.
constexpr int kBisections = 200;
// Lifts a point off the planes of symmetry, where the equation degenerates;
// moves the distance by less than this share of the ellipsoid.
constexpr double kOffPlane = 1e-12;

}  // namespace

double sphere_distance(const Vec3& point, const Vec3& centre, double radius) {
    return (point - centre).norm() - radius;
}

double torus_distance(const Vec3& point, double ring, double tube) {
    return std::hypot(point.head<2>().norm() - ring, point.z()) - tube;
}

double box_distance(const Vec3& point, const Box& box) {
    const Vec3 d = (point - box.centre()).cwiseAbs() - 0.5 * box.extent();
    return d.cwiseMax(0).norm() + std::min(d.maxCoeff(), 0.0);
}

double ellipsoid_distance(const Vec3& point, const Vec3& semi_axes) {
    // The foot point x has y_i = x_i (1 + t / a_i^2) with x on the ellipsoid. In
    // u = 1 + t / a_min^2 > 0 that is x_i = r_i y_i / (u + (r_i - 1)), r_i = (a_i / a_min)^2,
    // and sum (x_i / a_i)^2 falls with u through 1.
    const double least = semi_axes.minCoeff();
    const Eigen::Array3d a = semi_axes.array();
    const Eigen::Array3d y = point.array().abs().max(kOffPlane * a);
    const Eigen::Array3d r = (a / least).square();
    const auto foot = [&](double u) -> Eigen::Array3d { return r * y / (u + (r - 1)); };
    double low = 0, high = 1 + y.matrix().norm() / least;
    for (int n = 0; n < kBisections && low < high; ++n) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        ((foot(middle) / a).square().sum() > 1 ? low : high) = middle;
    }
    const double distance = (foot(high) - y).matrix().norm();
    return (y / a).square().sum() < 1 ? -distance : distance;
}

Loft::Loft(std::vector<Station> stations, double cap, double exponent)
    : stations_(std::move(stations)), slopes_(stations_.size()), cap_(cap), exponent_(exponent) {
    const std::size_t last = stations_.size() - 1;
    for (const auto width : kWidths) {
        std::vector<double> secant(last);
        for (std::size_t n = 0; n < last; ++n)
            secant[n] = (stations_[n + 1].*width - stations_[n].*width) /
                        (stations_[n + 1].z - stations_[n].z);
        slopes_[0].*width = secant[0];
        slopes_[last].*width = secant[last - 1];
        for (std::size_t n = 1; n < last; ++n) {
            // Harmonic mean of the secants; zero at an extremum, so none is added.
            const double product = secant[n - 1] * secant[n];
            slopes_[n].*width = product > 0 ? 2 * product / (secant[n - 1] + secant[n]) : 0.0;
        }
    }
    // Monotone pieces stay between their stations' values, each width for itself.
    for (std::size_t n = 0; n < last; ++n) {
        const Station &a = stations_[n], &b = stations_[n + 1];
        const Vec3 half(std::max(a.half_x, b.half_x), std::max(a.half_y, b.half_y), 0);
        box_.include(Vec3(std::min(a.x, b.x), std::min(a.y, b.y), a.z) - half);
        box_.include(Vec3(std::max(a.x, b.x), std::max(a.y, b.y), b.z) + half);
    }
    box_.min.z() -= cap_;
    box_.max.z() += cap_;
}

Station Loft::at(double z) const {
    if (z <= stations_.front().z) return stations_.front();
    if (z >= stations_.back().z) return stations_.back();
    const auto upper = std::upper_bound(stations_.begin(), stations_.end(), z,
                                        [](double value, const Station& s) { return value < s.z; });
    const std::size_t n = static_cast<std::size_t>(upper - stations_.begin()) - 1;
    const double length = stations_[n + 1].z - stations_[n].z, t = (z - stations_[n].z) / length;
    // Cubic Hermite basis.
    const double h01 = t * t * (3 - 2 * t), h00 = 1 - h01;
    const double h10 = t * (1 - t) * (1 - t) * length, h11 = t * t * (t - 1) * length;
    Station s;
    s.z = z;
    for (const auto width : kWidths)
        s.*width = h00 * stations_[n].*width + h01 * stations_[n + 1].*width +
                   h10 * slopes_[n].*width + h11 * slopes_[n + 1].*width;
    return s;
}

bool Loft::contains(const Vec3& point) const {
    if (!((point.array() >= box_.min.array()).all() && (point.array() <= box_.max.array()).all()))
        return false;
    const Station s = at(point.z());
    const double above =
        std::max({0.0, point.z() - stations_.back().z, stations_.front().z - point.z()});
    double scale = 1;  // of the cross-section, in a cap
    if (above > 0) {
        if (above >= cap_) return false;
        scale = std::sqrt(1 - (above / cap_) * (above / cap_));
    }
    return std::pow(std::abs(point.x() - s.x) / (scale * s.half_x), exponent_) +
               std::pow(std::abs(point.y() - s.y) / (scale * s.half_y), exponent_) <=
           1;
}

}  // namespace myotet::phantoms
