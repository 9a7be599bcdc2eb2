// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/WrapRound.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace myotet::skeleton {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
// Sine of the angle between two ends seen from the middle of a sphere below which their
// plane is not known.
constexpr double kAligned = 1e-12;

/// Length of the tangent from a point outside.
double tangent_length(double distance, double radius) {
    return std::sqrt(std::max(0.0, (distance - radius) * (distance + radius)));
}

/// A point of the plane of two unit vectors.
Vec3 in_plane(const Vec3& x, const Vec3& y, double angle) {
    return std::cos(angle) * x + std::sin(angle) * y;
}

/// Normal of the plane in which a path runs over a sphere.
Vec3 plane_of(const WrapObject& object, const Vec3& from, const Vec3& to, const Vec3& side) {
    const Vec3 normal = from.cross(to);
    if (normal.norm() > kAligned * from.norm() * to.norm()) return normal.normalized();
    // Any plane through the middle will do: that of the side that is known or asked for.
    const Vec3 aside = side.squaredNorm() > 0 ? side : quadrant_direction(object);
    const Vec3 known = from.cross(aside);
    if (known.norm() > kAligned * from.norm()) return known.normalized();
    return from.unitOrthogonal();
}

bool in_quadrant(const WrapObject& object, const Vec3& x) {
    return x.dot(quadrant_direction(object)) > 0;
}

/// Which way around a cylinder with a quadrant a path goes that is not remembered: not
/// across the half plane opposite to the quadrant.
int sense_within(const Vec3& middle, const Vec3& from, const Vec3& to) {
    const auto angle = [&](const Vec3& x) {
        return std::atan2(middle[0] * x[1] - middle[1] * x[0], middle[0] * x[0] + middle[1] * x[1]);
    };
    return angle(to) >= angle(from) ? 1 : -1;
}

/// The contact with a cylinder: on its unrolled surface the path is straight.
WrapContact on_cylinder(const Winding& way, double radius, double from_z, double to_z) {
    const double curve = radius * way.arc, flat = way.before + curve + way.after;
    const double rise = to_z - from_z, whole = std::hypot(flat, rise);
    const auto point = [&](double angle, double z) {
        const double c = std::cos(angle), s = std::sin(angle), turn = way.sense * flat / whole;
        return GeodesicPoint{{radius * c, radius * s, z}, {-s * turn, c * turn, rise / whole}};
    };
    WrapContact contact;
    contact.first = point(way.first, from_z + rise * way.before / flat);
    contact.last = point(way.first + way.sense * way.arc, to_z - rise * way.after / flat);
    contact.curve = curve * whole / flat;
    return contact;
}

}  // namespace

bool has_quadrant(const WrapObject& object) {
    // A cylinder is the same on both halves of its axis.
    const bool along = object.shape == WrapShape::cylinder && object.quadrant.axis == 2;
    return object.quadrant.sign != 0 && !along;
}

Vec3 quadrant_direction(const WrapObject& object) {
    return object.quadrant.sign * Vec3::Unit(object.quadrant.axis);
}

Winding wind(const Vec2& from, const Vec2& to, double radius, int sense) {
    Winding way;
    way.sense = sense;
    way.before = tangent_length(from.norm(), radius);
    way.after = tangent_length(to.norm(), radius);
    const double start = std::atan2(from[1], from[0]);
    const double cross = from[0] * to[1] - from[1] * to[0];
    double between = sense * std::atan2(cross, from.dot(to));
    if (between < 0) between += kTurn;
    const double to_circle = std::atan2(way.before, radius);
    way.first = start + sense * to_circle;
    way.arc = between - to_circle - std::atan2(way.after, radius);
    const double middle = start + 0.5 * sense * between;
    way.middle = {std::cos(middle), std::sin(middle)};
    return way;
}

Wrap wrap_sphere(const WrapObject& object, const Vec3& from, const Vec3& to,
                 const WrapMemory& before) {
    const double radius = object.size[0];
    const Vec3 normal = plane_of(object, from, to, before.side);
    const Vec3 x = from.normalized(), y = normal.cross(x);
    const Vec2 start{from.norm(), 0}, end{to.dot(x), to.dot(y)};
    Winding way = wind(start, end, radius, 1);  // the shorter one
    Wrap wrap;
    wrap.pierced = way.arc > 0;
    const Vec3 middle = way.middle[0] * x + way.middle[1] * y;
    bool shorter = true;
    if (has_quadrant(object) && before.touching)
        shorter = middle.dot(before.side) >= 0;
    else if (!wrap.pierced)
        return wrap;
    else if (has_quadrant(object) && !(in_quadrant(object, from) && in_quadrant(object, to)))
        shorter = middle.dot(quadrant_direction(object)) >= 0;
    if (!shorter) way = wind(start, end, radius, -1);
    if (!(way.arc > 0)) return wrap;
    const auto point = [&](double angle) {
        return GeodesicPoint{radius * in_plane(x, y, angle), way.sense * in_plane(y, -x, angle)};
    };
    wrap.touch = WrapTouch::touching;
    wrap.side = shorter ? middle : Vec3(-middle);
    wrap.contact = {point(way.first), point(way.first + way.sense * way.arc), radius * way.arc};
    return wrap;
}

Wrap wrap_cylinder(const WrapObject& object, const Vec3& from, const Vec3& to,
                   const WrapMemory& before) {
    const double radius = object.size[0];
    Winding way = wind(from.head<2>(), to.head<2>(), radius, 1);
    Winding other = wind(from.head<2>(), to.head<2>(), radius, -1);
    Wrap wrap;
    wrap.pierced = way.arc > 0 && other.arc > 0;
    bool turned = other.arc < way.arc;
    if (before.side.squaredNorm() > 0)
        turned = way.middle.dot(before.side.head<2>()) < 0;
    else if (has_quadrant(object))
        turned = sense_within(quadrant_direction(object), from, to) < 0;
    else if (!wrap.pierced)
        return wrap;
    if (turned) std::swap(way, other);
    const Vec3 side{way.middle[0], way.middle[1], 0};
    if (!(way.arc > 0)) {
        if (has_quadrant(object)) wrap.side = side;
        return wrap;
    }
    const WrapContact contact = on_cylinder(way, radius, from[2], to[2]);
    const auto beyond = [&](const GeodesicPoint& p) {
        return std::abs(p.at[2]) > 0.5 * object.size[1];
    };
    if (!before.touching && beyond(contact.first) && beyond(contact.last)) {
        wrap.pierced = false;
        return wrap;
    }
    wrap.touch = WrapTouch::touching;
    wrap.side = side;
    wrap.contact = contact;
    return wrap;
}

}  // namespace myotet::skeleton
