// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "LevelSet/LevelSet.h"
#include "Surface/MakeSurface.h"

namespace myotet::app {

/// A connected part of a tissue.
struct Part {
    const TriMesh& start;  ///< its extracted zero set
    const levelset::LevelSet& phi;
    surface::Field trim;     ///< empty: none
    surface::Beside beside;  ///< other parts; of a part by itself none
};

/// Its surface.
struct SoftSurface {
    surface::Result made;
    /// What holds it where that is not the level set as given.
    std::optional<levelset::LevelSet> softened;
    int places = 0;    ///< where it was smoothed
    double moved = 0;  ///< largest distance of the one surface from the other level set, mm
    int parts_before = 0, parts_after = 0;  ///< connected surfaces, before any trim
};

/// `surface::make_surface`; where necks or slits thinner than a sample leave the
/// result with faults, phi is smoothed about these and the surface is made anew,
/// from what the smoothed level set encloses. Of all tries the one with the fewest
/// faults, the earlier of equals. Throws as make_surface.
[[nodiscard]] SoftSurface make_soft_surface(const Part& part, const surface::Options& options,
                                            ProgressSink& progress);

}  // namespace myotet::app
