// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "LevelSetStage.h"
#include "Scan.h"

namespace myotet::app {

/// What is pressed, and how coarse its surface shall be.
struct OrganOptions {
    ScanOptions scan;  ///< the input and how it is read; `labels` is the one label
    LevelSetChoices level_sets;
    int nodes = 0;           ///< about so many on the surface given to level 0; 0: not said
    double edge_length = 0;  ///< or this edge length, mm; 0: not said
    std::vector<std::string> hold_to;  ///< labels whose neighbourhood is held
    double hold_within = 0;            ///< how far it reaches, mm
};

/// About how many nodes a label's surface has unless said.
inline constexpr int kOrganNodes = 400;

/// What a wall encloses, where the label is one.
struct Lumen {
    double volume = 0;       ///< of the cavity, mm^3
    double wall_volume = 0;  ///< of the label, mm^3
    double thickness = 0;    ///< of the wall: its volume over the mean of both areas, mm
};

/// The surface that becomes level 0.
struct Organ {
    Scan scan;  ///< without its voxels
    std::string name;
    std::int32_t label = 0;
    TriMesh surface;         ///< LPS, mm
    double edge_length = 0;  ///< asked of it, mm; 0: the surface as it was given
    std::optional<Lumen> lumen;
    std::vector<std::int32_t> near;  ///< points near the labels that it is held to
    std::vector<std::string> notes;
};

/// A surface as it is, or its or a label's level set's surface in even triangles. Of a
/// label that is a wall about a cavity the outer surface is taken, which is what tools
/// touch, and the cavity is its lumen. Of several parts the largest is taken.
/// Throws UsageError, InputError, IoError; InputError where the surface asked for cannot
/// be so coarse without triangles that cross or turn over.
[[nodiscard]] Organ find_organ(const OrganOptions& options, ProgressSink& progress);

}  // namespace myotet::app
