// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Elasticity/LinearTet.h"

namespace myotet::elasticity {

/// A linear spring along an edge, or an altitude, of rest length l_o:
///   elastic force k^e / l_o (l - l_o), damping force k^d / l_o dl/dt
/// along it [Teran05, sec. 7.1].
struct Spring {
    double stiffness = 0;    ///< k^e, N
    double damping = 0;      ///< k^d, N s
    double rest_length = 1;  ///< l_o, mm
};

/// k^e = c^2 m / l_o and k^d of `damping_ratio` times the critical one, with m the
/// harmonic mean of the masses at its ends: the speed of sound c (mm/s) is then
/// the material's, however fine the mesh [Teran05, sec. 7.1].
[[nodiscard]] Spring make_spring(double mass_a, double mass_b, double rest_length,
                                 double sound_speed, double damping_ratio);

/// Forces on both ends of an edge spring, at rest speed; they are opposite.
[[nodiscard]] std::array<Vec3, 2> edge_force(const Spring& spring, const Vec3& a, const Vec3& b);

/// Energy k^e / (2 l_o) (l - l_o)^2, mJ, for a length l.
[[nodiscard]] double spring_energy(const Spring& spring, double length);

/// An altitude: from the apex of a tetrahedron down to the plane of the
/// opposite face, which it meets in a virtual node of barycentric weights w.
struct Altitude {
    int apex = 0;                              ///< corner
    double length = 0;                         ///< mm, positive while the tetrahedron is
    Vec3 normal = Vec3::UnitZ();               ///< unit, from the base to the apex
    std::array<double, 4> weight{0, 0, 0, 0};  ///< w at the base's corners, -1 at the apex

    /// Rate of the length for corner velocities v: -sum w_i v_i . n.
    [[nodiscard]] double rate(const Corners& v) const;
    /// Spreads a pull f (N) that shortens it over the corners: w_i f n at the
    /// base, -f n at the apex. Total force and torque are zero.
    [[nodiscard]] Corners spread(double pull) const;
};

/// Altitude from corner `apex`. A flat base gives values that are not numbers.
[[nodiscard]] Altitude altitude_of(const Corners& x, int apex);
/// All four.
[[nodiscard]] std::array<Altitude, 4> altitudes_of(const Corners& x);

/// Which altitude springs of a tetrahedron act.
enum class AltitudeChoice {
    all,
    shortest,    ///< the one whose length is least
    compressed,  ///< those shorter than kCompressed times their rest length
};
inline constexpr double kCompressed = 0.9;

/// Bit i: the spring from corner i acts.
[[nodiscard]] unsigned choose_altitudes(const std::array<Altitude, 4>& altitudes,
                                        const std::array<Spring, 4>& springs,
                                        AltitudeChoice choice);

/// Cauchy stress that acts on the nodes as altitude springs with these pulls do
/// (N, positive when the spring shortens): sum of 3 f_i / A_i n_i n_i^T
/// [Teran05, appendix].
[[nodiscard]] Mat3 altitude_stress(const Corners& x, const std::array<double, 4>& pulls);

}  // namespace myotet::elasticity
