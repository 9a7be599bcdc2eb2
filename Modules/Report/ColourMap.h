// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Report/Picture.h"

namespace myotet::report {

/// A colour for a share of a range, from dark violet at 0 to yellow at 1: straight lines
/// between nine colours of viridis (S. van der Walt and N. Smith 2015, matplotlib), whose
/// lightness grows evenly, so that it also tells the order in grey and to the colour-blind.
/// Shares beyond [0, 1] have the colour of the nearer end. `share` is a number.
[[nodiscard]] Colour map_colour(double share);

/// A colour for one of many things, counted from 0: hues a golden angle apart, so that
/// neighbours in number differ, in three lightnesses and two saturations by turns; among 116 no
/// two are nearer than 0.07 in red, green and blue.
[[nodiscard]] Colour distinct_colour(std::size_t number);

}  // namespace myotet::report
