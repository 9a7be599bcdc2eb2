// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Progress.h"
#include "LevelSet/FromLabels.h"
#include "Meshing/MeshLevelSet.h"
#include "Scan.h"

namespace myotet::app {

/// How fine the meshes shall be, as asked; at most one of edge_length and tets.
struct SizeOptions {
    double edge_length = 0;           ///< mm; 0: not said
    std::int64_t tets = 0;            ///< in all; 0: not said
    double interior_edge_length = 0;  ///< mm; 0: 4x the edge length
    double curvature = 0;             ///< refine where edge > factor / (|k1| + |k2|); 0: off
    double max_aspect_ratio = 0;      ///< refine where few elements lie beyond; 0: not said
    bool uniform = false;             ///< one edge length everywhere
    bool draft = false;               ///< quick: the worst elements are left as they are
};

/// What a run would make and take.
struct Forecast {
    double edge_length = 0;  ///< mm
    double tets = 0;
    double bytes = 0;    ///< at the peak
    double seconds = 0;  ///< processor time, s
};

/// Edge lengths for the job. Without a wish, two voxels, or longer so that the
/// forecast stays under a million tetrahedra; a hundred thousand for a surface.
/// For a wished number of tetrahedra this is a first guess.
[[nodiscard]] meshing::Options choose_sizes(const SizeOptions& asked, const Scan& scan);

/// Distance between the samples of the level sets; labels: 0, from the voxels.
[[nodiscard]] double level_set_spacing(const meshing::Options& sizes, const Scan& scan);

[[nodiscard]] Forecast forecast(const meshing::Options& sizes, const Scan& scan);

/// "forecast: ..." for people.
[[nodiscard]] std::string to_sentence(const Forecast& forecast);

/// Throws ResourceError when the forecast does not fit into the memory that is
/// available or the indices.
void require_room_for(const Forecast& forecast, double available_bytes);

/// How one region is meshed with these sizes.
[[nodiscard]] meshing::Options options_for(const levelset::Region& region, meshing::Options sizes);

/// The same sizes, to be given up early when a region has not about `tets`.
[[nodiscard]] meshing::Options bounded(meshing::Options sizes, double tets);

/// Sizes that make 1 / `excess` times the tetrahedra, about.
[[nodiscard]] meshing::Options rescaled(meshing::Options sizes, double excess);

/// The sizes at which all regions together have `tets` tetrahedra within
/// kTetsTolerance, as forecast from lattices and first candidates; warns when none was found.
inline constexpr double kTetsTolerance = 0.1;
[[nodiscard]] meshing::Options sizes_for_total(const std::vector<levelset::Region>& regions,
                                               const meshing::Options& first_guess, double tets,
                                               ProgressSink& progress);

}  // namespace myotet::app
