// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace myotet::muscle {

/// What an active fibre pulls while its length changes, as a part of what it pulls at the
/// same length at rest: Hill's hyperbola for shortening, another for lengthening
/// [Zajac 1989; constants Thelen 2003, young adults]. With v = speed / max_speed:
///     (1 + v) / (1 - v / shape)           -1 < v <= 0; nothing below
///     (1 + k m v) / (1 + k v)             v > 0, m = most, k = (1 + 1 / shape) / (m - 1)
/// Thelen's k is twice as large, so that his slope jumps at v = 0; here it does not.
struct ForceVelocity {
    double max_speed = 10;  ///< of shortening without load, optimal fibre lengths / s
    double shape = 0.25;    ///< of Hill's hyperbola, the smaller the more curved
    double most = 1.4;      ///< of lengthening at great speed

    /// Of a speed in optimal fibre lengths / s, positive when the fibre lengthens.
    [[nodiscard]] double value(double speed) const;
    [[nodiscard]] double slope(double speed) const;     ///< d value / d speed, s
    [[nodiscard]] double integral(double speed) const;  ///< of value(s) ds from 0 to speed, 1/s
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

}  // namespace myotet::muscle
