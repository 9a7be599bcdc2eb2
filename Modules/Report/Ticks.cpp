// SPDX-License-Identifier: Apache-2.0
#include "Report/Ticks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "Core/Errors.h"
#include "Core/Text.h"

namespace myotet::report {
namespace {

constexpr double kFarthest = 1e100, kNearest = 1e-100;
constexpr double kLeastShare = 1e-6;      // of a range's larger end: its length
constexpr double kSlack = 1e-6;           // of a step: an end that rounding put beyond its multiple
constexpr int kMostDecimals = 4;          // of numbers without exponent
constexpr double kLargestPlain = 999999;  // of numbers without exponent

// count * 10^exponent
struct Decimal {
    std::int64_t count = 0;
    int exponent = 0;
};

double value_of(const Decimal& d) {
    const auto count = static_cast<double>(d.count);
    return d.exponent < 0 ? count / std::pow(10.0, -d.exponent)
                          : count * std::pow(10.0, d.exponent);
}

std::string plain(const Decimal& d) {
    std::string digits = std::to_string(std::abs(d.count));
    if (d.exponent >= 0) {
        if (d.count != 0) digits.append(d.exponent, '0');
    } else {
        const std::size_t decimals = -d.exponent;
        if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
        digits.insert(digits.size() - decimals, ".");
    }
    return (d.count < 0 ? "-" : "") + digits;
}

std::string scientific(Decimal d) {
    if (d.count == 0) return "0";
    for (; d.count % 10 == 0; d.count /= 10) ++d.exponent;
    std::string digits = std::to_string(std::abs(d.count));
    const int exponent = d.exponent + static_cast<int>(digits.size()) - 1;
    if (digits.size() > 1) digits.insert(1, ".");
    return (d.count < 0 ? "-" : "") + digits + "e" + std::to_string(exponent);
}

// The multiples of a step in a range are those by first to last.
struct Multiples {
    Decimal step;
    double first, last;
};

Multiples multiples(const Decimal& step, const Range& range) {
    const double length = value_of(step);
    return {step, std::ceil(range.least / length - kSlack),
            std::floor(range.most / length + kSlack)};
}

Multiples chosen(const Range& range, int at_most) {
    const double extent = range.most - range.least;
    for (int exponent = static_cast<int>(std::floor(std::log10(extent / at_most))) - 1;; ++exponent)
        for (const int count : {1, 2, 5}) {
            const Multiples m = multiples({count, exponent}, range);
            if (m.last - m.first < at_most) return m;
        }
}

}  // namespace

void validate(const Range& range, const std::string& name) {
    const double larger = std::max(std::abs(range.least), std::abs(range.most));
    const double extent = range.most - range.least;
    if (!(larger <= kFarthest && extent >= kNearest && extent >= kLeastShare * larger))
        throw InputError(name + " is from " + rounded(range.least) + " to " + rounded(range.most) +
                         ", but its ends must be within 1e100, in order, and a millionth of the "
                         "larger end apart; widen it");
}

std::vector<Tick> round_ticks(const Range& range, int at_most) {
    validate(range, "the range of an axis");
    if (at_most < 3)
        throw InputError("an axis of at most " + std::to_string(at_most) +
                         " numbers cannot be laid out; allow 3 or more");
    const auto [step, first, last] = chosen(range, at_most);
    std::vector<Decimal> decimals;
    for (double i = first; i <= last; ++i)
        decimals.push_back({static_cast<std::int64_t>(i) * step.count, step.exponent});
    const bool is_plain =
        step.exponent >= -kMostDecimals && std::ranges::all_of(decimals, [](const Decimal& d) {
            return std::abs(value_of(d)) <= kLargestPlain;
        });
    std::vector<Tick> ticks;
    for (const Decimal& d : decimals)
        ticks.push_back({value_of(d), is_plain ? plain(d) : scientific(d)});
    return ticks;
}

}  // namespace myotet::report
