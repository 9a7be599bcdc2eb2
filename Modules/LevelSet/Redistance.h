// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "LevelSet/Band.h"

namespace myotet::levelset {

/// What happens to the samples near the interface, which fix where it lies.
enum class Seeds {
    keep_ends,   ///< both ends of every cut edge of the lattice stay
    keep_cells,  ///< all corners of cut cells stay: the interface does not move at all
    scale,       ///< the same, divided by |grad phi| where that is sure, up to a quarter
    project,     ///< distance to the zero set of the trilinear interpolant
};

/// Makes every other sample of the stored blocks the distance to the nearest
/// interface point known to its neighbours, layer by layer from the interface,
/// clamped to the band's width; signs stay. `slides` is how often each nearest
/// point is improved along the interface: 0 errs by up to an eighth of the
/// spacing, 2 by the interpolation alone. Values beyond `reach` (mm) may be the
/// band's width instead. Odd in phi: two bands that are each
/// other's negative near a wall stay so.
/// Cost: O(stored samples); 13 bytes a sample while it runs.
void redistance(Band& band, Seeds seeds, int slides,
                double reach = std::numeric_limits<double>::infinity());

/// The same samples with blocks wherever the distance may be below `width`,
/// and none where it cannot; to be followed by redistance(). The outermost
/// layer of blocks stays empty when it was at least `width` away.
[[nodiscard]] Band refit(const Band& band, float width);

/// Moves `point` (mm) onto the interface by Newton steps along the gradient of
/// the interpolant; false when it does not get there.
[[nodiscard]] bool pull(const Band& band, Vec3& point);

/// Slides `foot`, a point of the interface, towards the one nearest to
/// `point`; it never ends farther away than it was.
void slide(const Band& band, const Vec3& point, int steps, Vec3& foot);

}  // namespace myotet::levelset
