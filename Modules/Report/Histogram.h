// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "Report/Ticks.h"

namespace myotet::report {

/// How many numbers lie where, in parts of equal width. A number on a part's end is in the
/// part above, the range's last one in the last part; numbers beyond are counted in the
/// nearer end's part, those that are not finite apart: all counts together are what was added.
struct Histogram {
    Histogram(const Range& range, int parts);

    void add(double number);

    Range range;
    std::vector<std::int64_t> counts;  ///< a part each
    std::int64_t not_finite = 0;
};

}  // namespace myotet::report
