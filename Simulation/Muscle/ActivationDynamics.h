// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace myotet::muscle {

/// How activation a follows excitation u, both from 0 to 1 [Zajac 1989; Thelen 2003,
/// eq. 1, 2, constants of young adults]:
///     da/dt = (u - a) / (rise (0.5 + 1.5 a))     u > a
///     da/dt = (u - a) (0.5 + 1.5 a) / fall       u <= a
struct ActivationDynamics {
    double rise = 0.015;  ///< s
    double fall = 0.050;  ///< s

    [[nodiscard]] double rate(double activation, double excitation) const;  ///< da/dt, 1/s
    /// Activation after a time, excitation being constant: the solution of the equation,
    /// to rounding, however long the step.
    [[nodiscard]] double after(double activation, double excitation, double seconds) const;
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

}  // namespace myotet::muscle
