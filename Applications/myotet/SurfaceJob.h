// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "Core/Progress.h"
#include "LevelSetStage.h"
#include "RunFacts.h"
#include "Scan.h"
#include "Surface/MakeSurface.h"

namespace myotet::app {

/// What `myotet surface` was asked for.
struct SurfaceJobOptions {
    ScanOptions scan;              ///< its input may be a mesh or level sets (.vdb) too
    std::filesystem::path output;  ///< folder
    LevelSetChoices level_sets;
    /// mm; 0: as `mesh` chooses it, of level sets as if their samples were voxels;
    /// of a mesh: its own.
    double edge_length = 0;
    /// mm; 0: a quarter of it, but at least half the level sets' spacing, below
    /// which they hold no shape.
    double smallest_edge_length = 0;
    /// "x,y,z,nx,ny,nz": the half-space behind a plane; the file of a surface, a mesh
    /// or level sets; or a tissue of the scan, or that the recipe makes, by name or
    /// value. Empty: none.
    std::string trim;
    double trim_offset = 0;      ///< the trimming solid is grown by this, mm
    int pieces = 0;              ///< of each connected part of a tissue, the largest; 0: all
    std::string format = "stl";  ///< or ply, obj, vtp, vtk
    int threads = 0;             ///< 0: as many as the process may use
};

/// What became of one tissue.
struct SurfaceTissue {
    Tissue tissue;
    int components = 0;
    surface::Cut cut = surface::Cut::none;
    surface::Quality quality;
    /// Where its level set was smoothed, as it has necks or slits thinner than its
    /// samples, and the farthest that it moved, mm.
    int softened_places = 0;
    double softened_by = 0;
    std::vector<std::string> notes;
    std::vector<std::string> broken_promises;  ///< empty: the surface was written
    std::vector<std::string> files;
};

struct SurfaceReport {
    RunFacts run;
    std::vector<SurfaceTissue> tissues;  ///< by layer and label value
};

/// From labels, a closed surface, a tetrahedral mesh or level sets to one well-shaped
/// triangle mesh a tissue, trimmed where asked [Teran05, sec. 11]. Throws
/// InputError when the trim discards every tissue or none of any; else errors
/// as run_level_set_job.
[[nodiscard]] SurfaceReport run_surface_job(const SurfaceJobOptions& options,
                                            ProgressSink& progress);

/// report.json's content, and a table for people.
[[nodiscard]] std::string to_json(const SurfaceReport& report);
[[nodiscard]] std::string to_table(const SurfaceReport& report);

}  // namespace myotet::app
