// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "Core/LabelVolume.h"
#include "Core/Progress.h"
#include "Core/TetMesh.h"
#include "LevelSet/FromLabels.h"
#include "LevelSet/Gaps.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::app {

/// What to read and how.
struct ScanOptions {
    std::filesystem::path input;  ///< label file or surface; for surfaces also mesh, level sets
    std::string labels;           ///< values or names, by commas; empty: all but 0
    segmentation::ReadOptions reading;  ///< of a label file
    double close_gaps = 0;              ///< between tissues, up to this wide, mm; 0: none
    bool heal = false;                  ///< guess what an open surface encloses
    std::string input_unit;             ///< of a surface file: mm, cm, m; empty: mm
};

/// One tissue as the input has it.
struct Tissue {
    int layer = 0;
    std::int32_t label = 0;
    std::string name;
    std::int64_t voxels = 0;  ///< 0 for a surface
    double volume = 0;        ///< mm^3
    double area = 0;          ///< of its surface, mm^2; from voxel faces for labels
    std::optional<levelset::SmoothingReport> smoothing;  ///< when it has become a level set
    bool asked = true;  ///< for a result; others are there as neighbours
};

/// The input, read and checked: labels or a surface.
struct Scan {
    std::filesystem::path input;
    std::vector<LabelVolume> layers;  ///< on one grid; empty for a surface
    std::optional<TriMesh> surface;
    std::vector<Tissue> tissues;              ///< all, by layer and label value
    std::optional<levelset::GapReport> gaps;  ///< between labels of a single layer
    Vec3 spacing = Vec3::Zero();              ///< of the voxels, mm; zero for a surface
    bool heal = false;                        ///< the surface, which may be open
    int shells = 0;                           ///< outward closed pieces of a surface; 0: not known
    std::filesystem::path names_from;         ///< where the names come from; empty: none
    std::string input_unit;                   ///< of a file without voxels: mm, cm, m
    std::string sha256;                       ///< of the input file
    std::vector<std::string> warnings;
};

/// Tissues of the scan that results are asked for.
[[nodiscard]] std::vector<Tissue> asked_tissues(const Scan& scan);

/// Throws UsageError when an option does not fit the kind of input, IoError,
/// InputError.
[[nodiscard]] Scan read_scan(const ScanOptions& options);

/// A surface file as it is, open or closed: one tissue, which has its name. Throws
/// UsageError, IoError, InputError.
[[nodiscard]] Scan read_plain_surface(const ScanOptions& options);

/// Says the warnings, and what lies unlabelled between tissues.
void tell(const Scan& scan, ProgressSink& progress);

}  // namespace myotet::app
