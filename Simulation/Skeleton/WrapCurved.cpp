// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/WrapCurved.h"

#include <cmath>

#include "Skeleton/WrapRound.h"

namespace myotet::skeleton {
namespace {

// Of the surface's size: lengths that are equal but for rounding.
constexpr double kRounding = 1e-9;
// A motion that Newton's method cannot follow at once is cut into up to this many parts.
constexpr int kParts = 256;
// A path is at most this much longer than that in a plane from which it was found.
constexpr double kLonger = 1.2;

WrapContact contact_of(const TautCurve& curve) {
    return {curve.start, curve.end.point, curve.length};
}

/// Whether the straight pieces come to the curve and go on from it.
bool goes_ahead(const WrapSurface& surface, const TautCurve& curve, const Vec3& from,
                const Vec3& to) {
    const double rounding = kRounding * surface.size();
    return (curve.start.at - from).dot(curve.start.along) > -rounding &&
           (to - curve.end.point.at).dot(curve.end.point.along) > -rounding;
}

struct Ends {
    Vec3 from, to;
};

/// The path as it was, its ends moved; none when it would have to jump.
std::optional<TautCurve> follow(const WrapSurface& surface, const WrapContact& contact,
                                const Ends& old, const Ends& now) {
    const auto curve = tighten(surface, now.from, now.to, {contact.first, contact.curve});
    if (!curve || !goes_ahead(surface, *curve, now.from, now.to)) return std::nullopt;
    // Moving its ends lengthens a taut path by no more than their ways.
    const double way = (now.from - old.from).norm() + (now.to - old.to).norm();
    const double change = wrapped_length(contact_of(*curve), now.from, now.to) -
                          wrapped_length(contact, old.from, old.to);
    const bool turned = curve->start.along.dot(contact.first.along) < 0;
    if (std::abs(change) > way + kRounding * surface.size() || turned) return std::nullopt;
    return curve;
}

/// The same in as many parts as it takes; none when it ends on the way.
std::optional<TautCurve> follow_in_parts(const WrapSurface& surface, const WrapMemory& before,
                                         const Ends& now) {
    WrapContact contact = before.contact;
    Ends old{before.from, before.to};
    const Ends began = old;
    for (double done = 0, part = 1; part >= 1.0 / kParts;) {
        const double next = std::min(1.0, done + part);
        const Ends ends{began.from + next * (now.from - began.from),
                        began.to + next * (now.to - began.to)};
        const bool outside = surface.height(ends.from) > 0 && surface.height(ends.to) > 0;
        const auto curve = outside ? follow(surface, contact, old, ends) : std::nullopt;
        if (!curve) {
            part *= 0.5;
            continue;
        }
        if (next == 1 || !(curve->length > 0)) return curve;
        contact = contact_of(*curve);
        old = ends;
        done = next;
    }
    return std::nullopt;
}

/// Paths are on the side that was asked for.
class Choice {
public:
    Choice(const WrapObject& object, const WrapSurface& surface, const Ends& ends, RingWay way)
        : surface_(surface), ends_(ends), way_(way) {
        if (!has_quadrant(object) || surface.is_torus()) return;
        const Vec3 half = quadrant_direction(object);
        if (!(ends.from.dot(half) > 0 && ends.to.dot(half) > 0)) half_ = half;
    }
    [[nodiscard]] bool allows(const Vec3& middle) const { return middle.dot(half_) >= 0; }

    void allow_all() { half_ = Vec3::Zero(); }

    /// Tries a guess; keeps the path when it is shorter than that kept before.
    void consider(const WrapGuess& guess) {
        const auto curve = tighten(surface_, ends_.from, ends_.to, guess.curve);
        if (!curve || !(curve->length > 0) || !goes_ahead(surface_, *curve, ends_.from, ends_.to))
            return;
        const double length = wrapped_length(contact_of(*curve), ends_.from, ends_.to);
        if (!(length < kLonger * guess.length)) return;
        const Vec3 middle = follow_geodesic(surface_, curve->start, 0.5 * curve->length).point.at;
        if (surface_.is_torus() && !through_hole(middle)) return;
        if (!allows(middle) || (found && !(length < length_))) return;
        found = true;
        length_ = length;
        contact = contact_of(*curve);
        side = middle.normalized();
    }

    bool found = false;
    WrapContact contact;
    Vec3 side = Vec3::Zero();

private:
    [[nodiscard]] bool through_hole(const Vec3& middle) const {
        return way_ == RingWay::nearest || !(ends_.from[2] * ends_.to[2] < 0) ||
               std::hypot(middle[0], middle[1]) < surface_.core();
    }

    const WrapSurface& surface_;
    const Ends& ends_;
    RingWay way_;
    Vec3 half_ = Vec3::Zero();
    double length_ = 0;
};

/// A path that did not touch before.
Wrap begin(const WrapObject& object, const WrapSurface& surface, const Ends& ends,
           const WrapMemory& before) {
    const RingWay way = before.side.squaredNorm() > 0 ? RingWay::nearest : RingWay::through_hole;
    const std::vector<WrapGuess> guesses = surface.is_torus()
                                               ? torus_guesses(surface, ends.from, ends.to, way)
                                               : ellipsoid_guesses(surface, ends.from, ends.to);
    Wrap wrap;
    // That it was clear of a ring is all that there is to remember.
    if (surface.is_torus()) wrap.side = Vec3::UnitZ();
    if (guesses.empty()) return wrap;
    wrap.pierced = true;
    Choice choice(object, surface, ends, way);
    for (const WrapGuess& guess : guesses) {
        if (choice.found && guess.length > kLonger * guesses.front().length) break;
        if (choice.allows(guess.side)) choice.consider(guess);
    }
    // Better on the other side than through the object.
    if (!choice.found) choice.allow_all();
    for (const WrapGuess& guess : guesses)
        if (!choice.found) choice.consider(guess);
    if (!choice.found) return wrap;
    wrap.touch = WrapTouch::touching;
    wrap.contact = choice.contact;
    wrap.side = choice.side;
    return wrap;
}

}  // namespace

Wrap wrap_curved(const WrapObject& object, const WrapSurface& surface, const Vec3& from,
                 const Vec3& to, const WrapMemory& before) {
    const Ends ends{from, to};
    if (!before.touching) return begin(object, surface, ends, before);
    const auto curve = follow_in_parts(surface, before, ends);
    if (!curve || !(curve->length > 0)) return begin(object, surface, ends, before);
    if (!has_quadrant(object) && !(spread(*curve, from, to) > 0))
        return begin(object, surface, ends, before);
    Wrap wrap;
    wrap.touch = WrapTouch::touching;
    wrap.contact = contact_of(*curve);
    wrap.side = before.side;
    return wrap;
}

}  // namespace myotet::skeleton
