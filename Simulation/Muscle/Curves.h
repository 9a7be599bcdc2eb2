// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace myotet::muscle {

// Force-length curves of fibres, without units, by a stretch x. Each tells its value, its
// derivative and its integral, which an energy needs; all in closed form.

/// What an active fibre pulls, as a part of its greatest pull, by its stretch over the
/// one at which it pulls most [Zajac 1989]; e = x - 1:
///     1 - peak e^2         |e| < 0.4
///     tail (|e| - 0.6)^2   0.4 <= |e| < 0.6
///     0                    beyond
struct ActiveCurve {
    double peak, tail;
    [[nodiscard]] double value(double x) const;
    [[nodiscard]] double slope(double x) const;
    [[nodiscard]] double integral(double x) const;  ///< from 0, so that it is never negative
};

/// As published: at |e| = 0.4 its slope jumps from 3.2 to 3.6 [Blemker 2005].
inline constexpr ActiveCurve kBlemkerActive{4, 9};
/// Without kinks [PhysBAM 2004].
inline constexpr ActiveCurve kTeranActive{25.0 / 6, 25.0 / 3};

/// How what resists stretch sets in at x = 1; e = x - 1.
enum class ToeForm {
    kinked,  ///< exp(rate e) - 1: with a slope at once [Blemker 2005]
    smooth,  ///< exp(rate e) - rate e - 1: without a kink [PhysBAM 2004]
};

/// What a fibre or a tendon pulls that is stretched beyond x = 1: `scale` times an
/// exponential, and from `linear_from` on its tangent there; below x = 1 nothing.
class ToeCurve {
public:
    ToeCurve() = default;  ///< nothing anywhere
    /// All positive, linear_from at least 1.
    ToeCurve(double scale, double rate, double linear_from, ToeForm form);

    [[nodiscard]] double value(double x) const;
    [[nodiscard]] double slope(double x) const;
    [[nodiscard]] double integral(double x) const;  ///< of value(t) dt from 1 to x
    /// Of value(t) / t dt from 1 to x, by the exponential integral Ei.
    [[nodiscard]] double integral_over_stretch(double x) const;

private:
    double scale_ = 0, rate_ = 1, linear_from_ = 1;
    bool smooth_ = false;
    // At linear_from_.
    double value_ = 0, slope_ = 0, integral_ = 0, over_stretch_ = 0;
    [[nodiscard]] double toe(double e) const;
    [[nodiscard]] double toe_slope(double e) const;
    [[nodiscard]] double toe_integral(double e) const;
    [[nodiscard]] double toe_over_stretch(double e) const;
};

}  // namespace myotet::muscle
