// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

namespace myotet::skeleton {

/// A signal without what is faster than a frequency: Butterworth's filter of third order
///     H(s) = 1 / ((s + 1) (s^2 + s + 1)),  s = (1 - 1/z) / (w (1 + 1/z)),  w = tan(pi f dt),
/// run forwards, then backwards, so that nothing is delayed and the cutoff frequency is
/// halved in amplitude [Oppenheim 1999, sec. 7.1; Winter 2009, sec. 3.4]. The signal is continued
/// at both ends by `padding` samples turned about its end point. Samples `dt` s apart.
struct LowPass {
    double cutoff_hz = 6;
    double dt = 0.01;         ///< s
    std::size_t padding = 0;  ///< samples, fewer than the signal has
};

/// The padded signal, filtered: 2 padding samples more than it had.
/// Throws InputError when the cutoff is not between 0 and half the sampling frequency, the
/// padding too long or the padded signal shorter than 4.
[[nodiscard]] std::vector<double> filter(const LowPass& low_pass, std::span<const double> signal);

}  // namespace myotet::skeleton
