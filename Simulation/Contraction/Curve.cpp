// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Curve.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "Contraction/Words.h"
#include "Core/Errors.h"

namespace myotet::contraction {
namespace {

// Optimisers that find activations leave their bounds by about their tolerance.
constexpr double kRounding = 1e-6;
constexpr double kGrid = 1e-3;  // s, of activations that follow an excitation
// A last piece of the grid that is shorter than this part of it is added to the one before.
constexpr double kSliver = 1e-6;

}  // namespace

double value_at(const Curve& curve, double time) {
    MYOTET_CHECK(!curve.times.empty() && curve.times.size() == curve.values.size(),
                 "a curve has points");
    const auto after = std::ranges::upper_bound(curve.times, time);
    if (after == curve.times.begin()) return curve.values.front();
    if (after == curve.times.end()) return curve.values.back();
    const auto i = static_cast<std::size_t>(after - curve.times.begin());
    const double part = (time - curve.times[i - 1]) / (curve.times[i] - curve.times[i - 1]);
    return std::lerp(curve.values[i - 1], curve.values[i], part);
}

std::string add_activation(Curve& curve, double time, double value) {
    if (!std::isfinite(time)) return "the time is " + shown(time) + " but must be a number in s";
    if (!curve.times.empty() && !(time > curve.times.back()))
        return "the time " + shown(time) + " s follows " + shown(curve.times.back()) +
               " s, but times must ascend; sort the rows, and give a jump a short time of its own";
    if (!(value >= -kRounding && value <= 1 + kRounding))
        return "the value is " + shown(value) +
               " but must be a number from 0 to 1; scale it or correct it";
    curve.times.push_back(time);
    curve.values.push_back(std::clamp(value, 0.0, 1.0));
    return {};
}

Curve follow(const Curve& excitation, const muscle::ActivationDynamics& dynamics, double end) {
    const double start = std::min(0.0, excitation.times.front());
    MYOTET_CHECK(end - start <= kLongestExcitation, "an excitation of reasonable length");
    const auto pieces = std::max<std::int64_t>(
        1, static_cast<std::int64_t>(std::ceil((end - start) / kGrid - kSliver)));
    Curve activation = {{start}, {0}};
    for (std::int64_t i = 1; i <= pieces; ++i) {
        const double from = activation.times.back();
        const double to = i < pieces ? start + static_cast<double>(i) * kGrid : end;
        const double excited = value_at(excitation, 0.5 * (from + to));
        activation.times.push_back(to);
        activation.values.push_back(dynamics.after(activation.values.back(), excited, to - from));
    }
    return activation;
}

}  // namespace myotet::contraction
