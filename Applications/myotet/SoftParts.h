// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "SoftSurface.h"

namespace myotet::app {

/// The surfaces of all connected parts of a tissue. Each is made by itself; where
/// triangles of different parts then cross, as chords of parts that come near each
/// other leave their arcs, these parts are made again one after the other, each beside
/// the others as they are: extracted, or made. What is said of a part's `beside` means
/// nothing. The same bytes on any number of threads. Throws as make_surface.
/// Cost: where none cross a search for crossings; else at most three times as much
/// again for the parts that do.
[[nodiscard]] std::vector<SoftSurface> make_soft_parts(std::span<const Part> parts,
                                                       const surface::Options& options,
                                                       ProgressSink& progress);

}  // namespace myotet::app
