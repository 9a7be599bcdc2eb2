// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "Cage/Cage.h"
#include "SurfaceJob.h"

namespace myotet::app {

/// What `myotet cage` was asked for.
struct CageJobOptions {
    SurfaceJobOptions source;  ///< input, folder, level sets and threads; nothing is trimmed
    cage::Options cage;
    std::vector<std::string> formats = {"vtu"};  ///< of the cages, without dot
    bool write_unreached = false;  ///< a cage whose nodes did not all get within the offset
};

/// What became of one tissue.
struct CageTissue {
    Tissue tissue;
    std::size_t surface_points = 0, surface_triangles = 0;
    double surface_area = 0, surface_volume = 0;  ///< mm^2, mm^3
    cage::Cage cage;
    std::vector<std::string> notes;
    std::vector<std::string> broken_promises;  ///< empty: the cage encloses
    std::vector<std::string> files;
};

struct CageReport {
    RunFacts run;
    bool stopped = false;  ///< before all tries were made; the best so far were taken
    std::vector<CageTissue> tissues;
};

/// From a closed surface as it is, or one made by level sets (labels, a level set, a
/// tetrahedral mesh, a surface to be healed), to one enclosing cage a tissue [Stuart13].
/// Throws InputError when a surface is open or meets itself; else as take_stock and make_cage.
[[nodiscard]] CageReport run_cage_job(const CageJobOptions& options, ProgressSink& progress);

/// report.json's content, and a table for people.
[[nodiscard]] std::string to_json(const CageReport& report);
[[nodiscard]] std::string to_table(const CageReport& report);

}  // namespace myotet::app
