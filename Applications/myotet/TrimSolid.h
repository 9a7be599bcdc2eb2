// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>

#include "LevelSetStage.h"
#include "Surface/Field.h"

namespace myotet::app {

/// The surface of some of a mesh's tetrahedra, outward whichever way each is
/// numbered.
[[nodiscard]] TriMesh outer_surface(const TetMesh& mesh, std::span<const std::int32_t> tets);

/// phi as the Surface room sees it; phi must outlive the field.
[[nodiscard]] surface::Field field_of(const levelset::LevelSet& phi);

/// All regions of a tissue as one solid, in their local coordinates; they must
/// outlive the field.
[[nodiscard]] surface::Field field_of(std::vector<const levelset::LevelSet*> phis);

/// What `--trim` says.
struct TrimSolid {
    std::optional<std::array<double, 6>> plane;  ///< x, y, z, nx, ny, nz: LPS, mm
    std::optional<Tissue> tissue;                ///< of the scan or of its recipe
    std::filesystem::path file;                  ///< else: a surface, a mesh or level sets
};

/// The tissue that a text names, or whose label value it is.
[[nodiscard]] std::optional<Tissue> tissue_named(const std::string& text,
                                                 std::span<const Tissue> tissues);

/// Throws UsageError when the text is none of them.
[[nodiscard]] TrimSolid read_trim(const std::string& text, std::span<const Tissue> tissues);

/// The field in the local coordinates of `sets`; level sets that it needs are
/// made with `spacing` and kept by it. `sets` must outlive it.
[[nodiscard]] surface::Field trim_field(const TrimSolid& trim, const TissueSets& sets,
                                        double spacing, ProgressSink& progress);

}  // namespace myotet::app
