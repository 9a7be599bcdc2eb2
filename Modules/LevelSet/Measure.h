// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "LevelSet/LevelSet.h"

namespace myotet::levelset {

/// The part of a cell where phi < 0, phi being linear in the six tetrahedra
/// around the cell's main diagonal. Corners i fastest.
[[nodiscard]] double inside_fraction(const std::array<float, 8>& corner);

/// Volume enclosed by phi = 0, mm^3: cell by cell in the bricks, whole bricks
/// elsewhere. Errs by O(spacing^2). Cost: one pass.
[[nodiscard]] double enclosed_volume(const LevelSet& phi);

/// Largest -phi among all samples, mm; 0 when nothing is inside.
[[nodiscard]] double inscribed_radius(const LevelSet& phi);

}  // namespace myotet::levelset
