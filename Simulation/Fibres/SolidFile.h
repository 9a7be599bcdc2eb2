// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "Fibres/BSplineSolid.h"

namespace myotet::fibres {

// A B-spline solid as a text file, a word or number apart by blanks:
//   myotet-bspline-solid 1
//   unit mm
//   frame LPS
//   degree 3 3 3
//   count 6 6 16
//   x y z             a line a control point, u fastest, w slowest
// Empty lines and what follows a '#' are passed over. Numbers do not depend on the locale
// and read back as the same doubles.

/// Throws InputError when the solid is not valid, IoError when the file cannot be written;
/// the file appears when it is whole.
void write_solid(const BSplineSolid& solid, const std::filesystem::path& file);

/// Throws IoError when the file cannot be opened, InputError with its line when it breaks
/// the format.
[[nodiscard]] BSplineSolid read_solid(const std::filesystem::path& file);

}  // namespace myotet::fibres
