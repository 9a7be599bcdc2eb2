// SPDX-License-Identifier: Apache-2.0
#include "Elasticity/Springs.h"

#include <algorithm>
#include <cmath>

namespace myotet::elasticity {

Spring make_spring(double mass_a, double mass_b, double rest_length, double sound_speed,
                   double damping_ratio) {
    const double m = 2 * mass_a * mass_b / (mass_a + mass_b);
    const double stiffness = sound_speed * sound_speed * m / rest_length;
    // Critical for one mass on a spring of constant k / l_o: 2 sqrt(m k / l_o).
    const double critical = 2 * std::sqrt(m * stiffness / rest_length);
    return {stiffness, damping_ratio * critical * rest_length, rest_length};
}

std::array<Vec3, 2> edge_force(const Spring& spring, const Vec3& a, const Vec3& b) {
    const Vec3 along = b - a;
    const double length = along.norm();
    const double pull = spring.stiffness / spring.rest_length * (length - spring.rest_length);
    const Vec3 f = pull / length * along;
    return {f, -f};
}

double spring_energy(const Spring& spring, double length) {
    const double stretch = length - spring.rest_length;
    return 0.5 * spring.stiffness / spring.rest_length * stretch * stretch;
}

double Altitude::rate(const Corners& v) const {
    double rate = 0;
    for (int i = 0; i < 4; ++i) rate -= weight[i] * v[i].dot(normal);
    return rate;
}

Corners Altitude::spread(double pull) const {
    Corners force;
    for (int i = 0; i < 4; ++i) force[i] = weight[i] * pull * normal;
    return force;
}

Altitude altitude_of(const Corners& x, int apex) {
    const Triangle base = face_of({0, 1, 2, 3}, apex);
    const Vec3 &a = x[base[0]], &b = x[base[1]], &c = x[base[2]];
    const Vec3 area = (b - a).cross(c - a);  // outward, away from the apex
    const double per_square = 1 / area.squaredNorm();
    Altitude h;
    h.apex = apex;
    h.normal = -area.normalized();
    h.length = (x[apex] - a).dot(h.normal);
    // Barycentric coordinates of the apex' projection: areas over the base's.
    const Vec3& p = x[apex];
    h.weight[base[0]] = (b - p).cross(c - p).dot(area) * per_square;
    h.weight[base[1]] = (c - p).cross(a - p).dot(area) * per_square;
    h.weight[base[2]] = (a - p).cross(b - p).dot(area) * per_square;
    h.weight[apex] = -1;
    return h;
}

std::array<Altitude, 4> altitudes_of(const Corners& x) {
    return {altitude_of(x, 0), altitude_of(x, 1), altitude_of(x, 2), altitude_of(x, 3)};
}

unsigned choose_altitudes(const std::array<Altitude, 4>& altitudes,
                          const std::array<Spring, 4>& springs, AltitudeChoice choice) {
    if (choice == AltitudeChoice::all) return 0b1111;
    if (choice == AltitudeChoice::shortest) {
        const auto it = std::ranges::min_element(altitudes, {}, &Altitude::length);
        return 1u << (it - altitudes.begin());
    }
    unsigned chosen = 0;
    for (int i = 0; i < 4; ++i)
        if (altitudes[i].length < kCompressed * springs[i].rest_length) chosen |= 1u << i;
    return chosen;
}

Mat3 altitude_stress(const Corners& x, const std::array<double, 4>& pulls) {
    Mat3 sigma = Mat3::Zero();
    for (int i = 0; i < 4; ++i) {
        const Triangle f = face_of({0, 1, 2, 3}, i);
        const Vec3 area = 0.5 * (x[f[1]] - x[f[0]]).cross(x[f[2]] - x[f[0]]);
        const double A = area.norm();
        const Vec3 n = area / A;
        sigma += 3 * pulls[i] / A * n * n.transpose();
    }
    return sigma;
}

}  // namespace myotet::elasticity
