// SPDX-License-Identifier: Apache-2.0
#include "Report/Histogram.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "Core/Errors.h"

namespace myotet::report {

Histogram::Histogram(const Range& shown, int parts) : range(shown) {
    validate(range, "a histogram's range");
    if (parts < 1)
        throw InputError("a histogram has " + std::to_string(parts) + " parts; give at least one");
    counts.assign(static_cast<std::size_t>(parts), 0);
}

void Histogram::add(double number) {
    if (!std::isfinite(number)) {
        ++not_finite;
        return;
    }
    const double share = std::clamp((number - range.least) / (range.most - range.least), 0.0, 1.0);
    const auto part = static_cast<std::size_t>(share * static_cast<double>(counts.size()));
    ++counts[std::min(part, counts.size() - 1)];
}

}  // namespace myotet::report
