// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "Core/LabelVolume.h"
#include "Core/Progress.h"
#include "Core/TetMesh.h"
#include "PageFacts.h"
#include "Report/Histogram.h"
#include "Report/Picture.h"

namespace myotet::app {

/// A tissue's mesh, to be looked at.
struct TissueView {
    int layer = 0;
    std::int32_t label = 0;
    std::string name;
    report::Colour colour{};
    TetMesh mesh;     ///< empty where only surfaces were written, or the mesh broke a promise
    TriMesh surface;  ///< its boundary
};

/// What a folder of meshes shows.
struct MeshViews {
    std::vector<TissueView> tissues;  ///< as report.json lists them
    Box box;                          ///< around all
    std::vector<LabelVolume> layers;  ///< the scan; empty where it cannot be shown
    std::string no_scan;              ///< a sentence that says why, else empty
};

/// Reads the meshes that a report names, and the scan where it still is as it was.
[[nodiscard]] MeshViews read_views(const RunJson& run, const std::filesystem::path& folder,
                                   ProgressSink& progress);

/// A picture, and what it shows.
struct NamedPicture {
    std::string stem;     ///< of a file's name
    std::string caption;  ///< "from the front"
    report::Picture picture;
};

/// All tissues from the front, the left, behind and above, and cut open from the front and the
/// left; `side` is a picture's longer side, pixels.
[[nodiscard]] std::vector<NamedPicture> whole_pictures(const MeshViews& views, int side);

/// A tissue from the front, whole or with the tetrahedra before its middle taken away.
enum class Opened { no, yes };
[[nodiscard]] report::Picture tissue_picture(const TissueView& tissue, int side, Opened opened);

/// Writes pictures/ of the whole and of each tissue, cut and uncut. Throws IoError.
void write_pictures(const MeshViews& views, const std::filesystem::path& folder);

/// Slices of the scan with the meshes' outlines over them, a row for each of the patient's axes;
/// empty without a scan.
[[nodiscard]] std::string slices_html(const MeshViews& views);

/// Of all tetrahedra: smallest and largest dihedral angles, degrees, and aspect ratios.
struct ShapeHistograms {
    report::Histogram smallest{{0, 72}, 36}, largest{{60, 180}, 40}, aspect{{1, 9}, 40};
};
[[nodiscard]] ShapeHistograms shape_histograms(const MeshViews& views);

}  // namespace myotet::app
