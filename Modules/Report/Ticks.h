// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace myotet::report {

/// Numbers from `least` to `most`.
struct Range {
    double least = 0, most = 1;
};

/// Throws InputError, naming the range, unless its ends are within 1e100, in order, and their
/// distance is at least 1e-100 and a millionth of the larger end: what a scale can show.
void validate(const Range& range, const std::string& name);

/// A number on an axis, and how it is written there.
struct Tick {
    double value = 0;
    std::string text;
};

/// The multiples of a step that lie in a range: the step is the smallest of 1, 2 and 5 times
/// powers of ten that gives at most `at_most` of them. Every number of the range is less than
/// a step away from one. A value is the double next to its decimal; all texts have as many
/// decimals as the step needs, or are as 2.5e-7 when a number is 1e6 or more or the step is
/// below 1e-4. Throws InputError when the range is not valid or `at_most` is below 3.
[[nodiscard]] std::vector<Tick> round_ticks(const Range& range, int at_most);

}  // namespace myotet::report
