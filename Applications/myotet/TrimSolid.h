// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "LevelSetStage.h"
#include "Surface/Field.h"

namespace myotet::app {

/// phi as the Surface room sees it; phi must outlive the field.
[[nodiscard]] surface::Field field_of(const levelset::LevelSet& phi);

/// All regions of a tissue as one solid, in their local coordinates; they must
/// outlive the field.
[[nodiscard]] surface::Field field_of(std::vector<const levelset::LevelSet*> phis);

/// What `--trim` says.
struct TrimSolid {
    std::optional<std::array<double, 6>> plane;  ///< x, y, z, nx, ny, nz: LPS, mm
    std::optional<Tissue> tissue;                ///< of the scan
    std::filesystem::path file;                  ///< else: a surface
};

/// Throws UsageError when the text is none of them.
[[nodiscard]] TrimSolid read_trim(const std::string& text, const Scan& scan);

/// The field in the local coordinates of `sets`; level sets that it needs are
/// made with `spacing` and kept by it. `sets` must outlive it.
[[nodiscard]] surface::Field trim_field(const TrimSolid& trim, const TissueSets& sets,
                                        double spacing, ProgressSink& progress);

}  // namespace myotet::app
