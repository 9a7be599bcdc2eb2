// SPDX-License-Identifier: Apache-2.0
#include "Skeleton/LowPass.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "Core/Errors.h"
#include "Core/Text.h"

namespace myotet::skeleton {
namespace {

/// The signal and its ends turned about its first and its last point, which keeps the slope.
std::vector<double> padded(std::span<const double> signal, std::size_t padding) {
    const std::size_t n = signal.size();
    std::vector<double> longer;
    longer.reserve(n + 2 * padding);
    for (std::size_t i = padding; i > 0; --i) longer.push_back(2 * signal[0] - signal[i]);
    longer.insert(longer.end(), signal.begin(), signal.end());
    for (std::size_t i = 1; i <= padding; ++i)
        longer.push_back(2 * signal[n - 1] - signal[n - 1 - i]);
    return longer;
}

/// With w in place of s: (w^3 (1 + 1/z)^3) / (sum of d_k / z^k). The first three samples stay,
/// since the filter looks three back.
void run(double w, std::vector<double>& signal) {
    const double w2 = w * w, w3 = w2 * w, d0 = (w + 1) * (w2 + w + 1);
    const double d1 = 3 * w3 + 2 * w2 - 2 * w - 3, d2 = 3 * w3 - 2 * w2 - 2 * w + 3;
    const double d3 = (w - 1) * (w2 - w + 1);
    const std::vector<double> x = signal;
    for (std::size_t i = 3; i < x.size(); ++i)
        signal[i] = (w3 * (x[i] + 3 * x[i - 1] + 3 * x[i - 2] + x[i - 3]) - d1 * signal[i - 1] -
                     d2 * signal[i - 2] - d3 * signal[i - 3]) /
                    d0;
}

}  // namespace

std::vector<double> filter(const LowPass& low_pass, std::span<const double> signal) {
    const double nyquist = 0.5 / low_pass.dt;
    if (!(low_pass.cutoff_hz > 0) || !(low_pass.cutoff_hz < nyquist))
        throw InputError("a filter's cutoff of " + shown(low_pass.cutoff_hz) +
                         " Hz must be between 0 and half the sampling frequency, " +
                         shown(nyquist) + " Hz; choose another");
    if (low_pass.padding >= signal.size() || signal.size() + 2 * low_pass.padding < 4)
        throw InputError("a signal of " + std::to_string(signal.size()) +
                         " samples is too short to be filtered; it needs at least 4");
    std::vector<double> out = padded(signal, low_pass.padding);
    const double w = std::tan(std::numbers::pi * low_pass.cutoff_hz * low_pass.dt);
    run(w, out);
    std::ranges::reverse(out);
    run(w, out);
    std::ranges::reverse(out);
    return out;
}

}  // namespace myotet::skeleton
