// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "Skeleton/WrapCurved.h"
#include "Skeleton/WrapRound.h"

namespace myotet::skeleton {
namespace {

// Planes around the line between the ends, 15 degrees apart.
constexpr int kPlanes = 24;
// Pieces of Simpson's rule along an ellipse: only to compare.
constexpr int kPieces = 8;
// Points of the straight piece beside which the ring is looked for, and halvings after.
constexpr int kSamples = 64, kHalvings = 40;
// A straight piece less deep in the tube than this part of its radius only touches it, as
// those beside a contact do.
constexpr double kTouching = 1e-9;
// How far along the ring from there a path is tried, rad.
constexpr std::array kAlongRing{0.0, 0.15, -0.15, 0.3, -0.3, 0.7, -0.7};

/// Length of half an ellipse's arc from `angle` on, x and y its (skew) half axes.
double arc_length(const Vec3& x, const Vec3& y, double angle, double arc) {
    double sum = 0;
    for (int i = 0; i <= kPieces; ++i) {
        const double at = angle + arc * i / kPieces;
        const double weight = i == 0 || i == kPieces ? 1 : (i % 2 == 1 ? 4 : 2);
        sum += weight * (std::cos(at) * y - std::sin(at) * x).norm();
    }
    return sum * std::abs(arc) / (3 * kPieces);
}

/// The path over an ellipsoid in a plane, seen where the ellipsoid is a unit ball: through
/// the line's point `foot` next to the middle, over the side `up`.
WrapGuess in_plane(const Vec3& axes, const Vec3& p, const Vec3& q, const Vec3& foot,
                   const Vec3& up) {
    const Vec3 along = (q - p).normalized();
    const double above = foot.dot(up);
    const Vec3 centre = foot - above * up;
    const double radius = std::sqrt(1 - centre.squaredNorm());
    const Winding way =
        wind({(p - foot).dot(along), above}, {(q - foot).dot(along), above}, radius, -1);
    const Vec3 x = radius * axes.cwiseProduct(along), y = radius * axes.cwiseProduct(up);
    const auto at = [&](double angle) -> Vec3 {
        return axes.cwiseProduct(centre) + std::cos(angle) * x + std::sin(angle) * y;
    };
    WrapGuess guess;
    guess.curve.start.at = at(way.first);
    guess.curve.start.along = (std::sin(way.first) * x - std::cos(way.first) * y).normalized();
    guess.curve.length = arc_length(x, y, way.first, -way.arc);
    guess.side = at(way.first - 0.5 * way.arc).normalized();
    guess.length = (guess.curve.start.at - axes.cwiseProduct(p)).norm() + guess.curve.length +
                   (axes.cwiseProduct(q) - at(way.first - way.arc)).norm();
    return guess;
}

/// Distance of a point from the ring in the tube's middle.
double from_ring(const WrapSurface& surface, const Vec3& x) {
    return std::hypot(std::hypot(x[0], x[1]) - surface.core(), x[2]);
}

/// The point of a straight piece next to the ring.
Vec3 next_to_ring(const WrapSurface& surface, const Vec3& from, const Vec3& to) {
    const auto at = [&](double t) -> Vec3 { return from + t * (to - from); };
    double best = 0.5, least = from_ring(surface, at(best)), step = 1.0 / kSamples;
    for (int i = 1; i < kSamples; ++i) {
        const double distance = from_ring(surface, at(i * step));
        if (distance < least) least = distance, best = i * step;
    }
    for (int i = 0; i < kHalvings; ++i, step *= 0.6)
        for (const double t : {best - step, best + step}) {
            const double distance = from_ring(surface, at(t));
            if (t > 0 && t < 1 && distance < least) least = distance, best = t;
        }
    return at(best);
}

/// Whether the ends lie on both sides of the ring's plane and the straight piece misses the
/// hole.
bool misses_hole(const WrapSurface& surface, const Vec3& from, const Vec3& to) {
    if (!(from[2] * to[2] < 0)) return false;
    const Vec3 at = from + from[2] / (from[2] - to[2]) * (to - from);
    return std::hypot(at[0], at[1]) > surface.core();
}

/// Over the cylinder tangent to the tube at an angle around the ring, where x points into
/// the hole.
WrapGuess over_tube(const WrapObject& ring, const WrapSurface& surface, const Vec3& from,
                    const Vec3& to, double angle) {
    const Vec3 out{std::cos(angle), std::sin(angle), 0}, along{-out[1], out[0], 0};
    const Vec3 middle = surface.core() * out;
    Mat3 frame;  // of the cylinder: x towards the ring's middle, z along the tube
    frame << -out, Vec3::UnitZ(), -along;
    const Wrap wrap = wrap_cylinder(ring, frame.transpose() * (from - middle),
                                    frame.transpose() * (to - middle), {});
    WrapGuess guess;
    if (wrap.touch != WrapTouch::touching) return guess;
    const Vec3 first = middle + frame * wrap.contact.first.at;
    const Vec3 last = middle + frame * wrap.contact.last.at;
    const Vec3 direction = frame * wrap.contact.first.along;
    guess.curve.start.at = surface.settle(first);
    const Vec3 normal = surface.normal(guess.curve.start.at);
    guess.curve.start.along = (direction - direction.dot(normal) * normal).normalized();
    guess.curve.length = wrap.contact.curve;
    guess.length = (first - from).norm() + wrap.contact.curve + (to - last).norm();
    guess.side = (first + last).normalized();
    return guess;
}

}  // namespace

std::vector<WrapGuess> ellipsoid_guesses(const WrapSurface& surface, const Vec3& from,
                                         const Vec3& to) {
    const Vec3& axes = surface.half_axes();
    const Vec3 p = from.cwiseQuotient(axes), q = to.cwiseQuotient(axes);
    const double share = -p.dot(q - p) / (q - p).squaredNorm();
    const Vec3 foot = p + share * (q - p);
    if (!(share > 0 && share < 1 && foot.squaredNorm() < 1)) return {};
    const Vec3 along = (q - p).normalized();
    // Through the middle of the body first: of a sphere that is the shortest.
    const Vec3 out = foot - foot.dot(along) * along;
    const Vec3 x = out.norm() > 1e-9 ? Vec3(out.normalized()) : along.unitOrthogonal();
    const Vec3 y = along.cross(x);
    std::array<WrapGuess, kPlanes> all;
    for (int i = 0; i < kPlanes; ++i) {
        const double angle = 2 * std::numbers::pi * i / kPlanes;
        all[i] = in_plane(axes, p, q, foot, std::cos(angle) * x + std::sin(angle) * y);
    }
    std::vector<WrapGuess> shortest, longest;
    for (int i = 0; i < kPlanes; ++i) {
        const double before = all[(i + kPlanes - 1) % kPlanes].length - all[i].length;
        const double after = all[(i + 1) % kPlanes].length - all[i].length;
        if (before > 0 && after >= 0) shortest.push_back(all[i]);
        if (before < 0 && after <= 0) longest.push_back(all[i]);
    }
    if (shortest.empty()) shortest.push_back(all[0]);
    const auto less = [](const WrapGuess& a, const WrapGuess& b) { return a.length < b.length; };
    std::stable_sort(shortest.begin(), shortest.end(), less);
    std::stable_sort(longest.begin(), longest.end(), less);
    shortest.insert(shortest.end(), longest.begin(), longest.end());
    return shortest;
}

std::vector<WrapGuess> torus_guesses(const WrapSurface& surface, const Vec3& from, const Vec3& to,
                                     RingWay way) {
    const Vec3 next = next_to_ring(surface, from, to);
    const bool through = way == RingWay::through_hole;
    const bool pierces = from_ring(surface, next) < (1 - kTouching) * surface.tube();
    if (!pierces && !(through && misses_hole(surface, from, to))) return {};
    WrapObject tube;
    tube.shape = WrapShape::cylinder;
    tube.size = {surface.tube(), std::numeric_limits<double>::infinity(), 0};
    if (through) tube.quadrant = {0, 1};
    std::vector<WrapGuess> guesses;
    for (const double along : kAlongRing) {
        const double angle = std::atan2(next[1], next[0]) + along;
        const WrapGuess guess = over_tube(tube, surface, from, to, angle);
        if (guess.length > 0) guesses.push_back(guess);
    }
    return guesses;
}

}  // namespace myotet::skeleton
