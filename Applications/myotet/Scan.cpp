// SPDX-License-Identifier: Apache-2.0
#include "Scan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "Core/Sha256.h"
#include "ExitCodes.h"
#include "InputKind.h"
#include "MeshFiles/MeshFiles.h"
#include "Segmentation/Census.h"
#include "Text.h"

namespace myotet::app {
namespace {

double millimetres_per(const std::string& unit) {
    return unit == "m" ? 1000 : unit == "cm" ? 10 : 1;
}

/// Area of a label's surface from its voxel faces. A plane of unit normal n and
/// area A shows voxel faces of area A (|n1| + |n2| + |n3|), whose mean over all
/// directions is 3/2 A (Cauchy's projection formula).
std::map<std::int32_t, double> estimate_areas(const LabelVolume& volume) {
    const Vec3 s = volume.spacing();
    const Vec3 face_area(s[1] * s[2], s[2] * s[0], s[0] * s[1]);
    std::map<std::int32_t, std::array<std::int64_t, 3>> faces;
    const auto count = [&](std::int32_t here, std::int32_t there, int axis) {
        if (here == there) return;
        ++faces[here][axis];
        ++faces[there][axis];
    };
    const Index3& n = volume.size;
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i) {
                const std::int32_t here = volume.values[volume.offset(i, j, k)];
                const auto value_at = [&](int a, int b, int c) {
                    return a < n[0] && b < n[1] && c < n[2] ? volume.values[volume.offset(a, b, c)]
                                                            : 0;
                };
                count(here, value_at(i + 1, j, k), 0);
                count(here, value_at(i, j + 1, k), 1);
                count(here, value_at(i, j, k + 1), 2);
                count(i == 0 ? 0 : here, here, 0);
                count(j == 0 ? 0 : here, here, 1);
                count(k == 0 ? 0 : here, here, 2);
            }
    std::map<std::int32_t, double> areas;
    for (const auto& [value, f] : faces)
        areas[value] =
            2.0 / 3.0 *
            (static_cast<double>(f[0]) * face_area[0] + static_cast<double>(f[1]) * face_area[1] +
             static_cast<double>(f[2]) * face_area[2]);
    return areas;
}

double surface_area(const TriMesh& surface) {
    double area = 0;
    for (const Triangle& t : surface.triangles) {
        const Vec3& a = surface.points[t[0]];
        area += 0.5 * (surface.points[t[1]] - a).cross(surface.points[t[2]] - a).norm();
    }
    return area;
}

/// Connected pieces of the surface that bound a solid from outside; those
/// turned the other way are cavities.
int count_outward_shells(const TriMesh& surface) {
    std::vector<std::int32_t> parent(surface.points.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::int32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const Triangle& t : surface.triangles) {
        parent[root(t[1])] = root(t[0]);
        parent[root(t[2])] = root(t[0]);
    }
    std::map<std::int32_t, double> volumes;
    for (const Triangle& t : surface.triangles)
        volumes[root(t[0])] += signed_volume(Vec3::Zero(), surface.points[t[0]],
                                             surface.points[t[1]], surface.points[t[2]]);
    const double whole = volume(surface);  // its sign says which way is outward
    return static_cast<int>(
        std::ranges::count_if(volumes, [&](const auto& v) { return v.second * whole > 0; }));
}

/// Measures, and closes where asked, what lies unlabelled between tissues.
std::optional<levelset::GapReport> treat_gaps(std::vector<LabelVolume>& layers,
                                              const ScanOptions& options) {
    if (layers.size() > 1 && options.close_gaps > 0)
        throw UsageError("--close-gaps: the segments of " + options.input.string() +
                         " overlap in layers, where gaps are not one layer's; close them by a "
                         "recipe, see --repair");
    if (layers.size() > 1) return std::nullopt;
    return options.close_gaps > 0 ? levelset::close_gaps(layers.front(), options.close_gaps)
                                  : levelset::find_gaps(layers.front(), 0);
}

Scan read_label_scan(const ScanOptions& options) {
    if (options.heal)
        throw UsageError("--heal: " + options.input.string() +
                         " is a label file; healing is for surfaces, see --repair for labels");
    if (!options.input_unit.empty())
        throw UsageError("--input-unit: " + options.input.string() +
                         " is a label file, which says its unit itself; leave the option out");
    segmentation::LabelFile file = segmentation::read_labels(options.input, options.reading);
    const auto gaps = treat_gaps(file.layers, options);
    const auto counts = segmentation::count_labels(file.layers);
    const auto chosen = segmentation::choose_labels(file.layers, counts, options.labels);
    const auto is_chosen = [&](const segmentation::LabelCount& c) {
        return std::ranges::any_of(
            chosen, [&](const auto& d) { return d.layer == c.layer && d.value == c.value; });
    };
    std::vector<std::map<std::int32_t, double>> areas;
    for (const LabelVolume& volume : file.layers) areas.push_back(estimate_areas(volume));

    Scan scan;
    scan.gaps = gaps;
    scan.spacing = file.layers.front().spacing();
    scan.names_from = file.names_from;
    scan.warnings = std::move(file.warnings);
    for (const segmentation::LabelCount& c : counts) {
        const LabelVolume& volume = file.layers[c.layer];
        scan.tissues.push_back({c.layer,
                                c.value,
                                volume.name_of(c.value),
                                c.voxels,
                                static_cast<double>(c.voxels) * volume.voxel_volume(),
                                areas[c.layer].at(c.value),
                                {},
                                is_chosen(c)});
    }
    scan.layers = std::move(file.layers);
    return scan;
}

Scan one_surface(const ScanOptions& options) {
    refuse_options(label_options_given(options), options.input, "a surface, which is one tissue");
    Scan scan;
    scan.input_unit = options.input_unit.empty() ? "mm" : options.input_unit;
    scan.surface = meshfiles::read_surface(options.input, millimetres_per(options.input_unit));
    scan.tissues = {{0,
                     1,
                     options.input.stem().string(),
                     0,
                     std::abs(volume(*scan.surface)),
                     surface_area(*scan.surface),
                     {}}};
    return scan;
}

Scan read_surface_scan(const ScanOptions& options) {
    Scan scan = one_surface(options);
    scan.heal = options.heal;
    if (!options.heal) scan.shells = count_outward_shells(*scan.surface);
    // A ball has 0.09 of this; far below a paper's thickness nothing is solid.
    constexpr double kFlat = 1e-9;
    const Tissue& tissue = scan.tissues.front();
    if (!options.heal && !(tissue.volume > kFlat * std::pow(tissue.area, 1.5)))
        throw InputError(options.input.string() +
                         ": encloses no volume, it is open or flat; a closed surface is needed");
    return scan;
}

}  // namespace

std::vector<Tissue> asked_tissues(const Scan& scan) {
    std::vector<Tissue> asked;
    std::ranges::copy_if(scan.tissues, std::back_inserter(asked), &Tissue::asked);
    return asked;
}

Scan read_scan(const ScanOptions& options) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(options.input, ignored))
        throw IoError(options.input.string() +
                      ": there is no such file; check its name and folder");
    const InputKind kind = kind_of(options.input);
    if (kind != InputKind::labels && kind != InputKind::surface)
        throw InputError(options.input.string() +
                         ": its extension is not known; labels come as .nii .nii.gz .nrrd "
                         ".seg.nrrd .mha .mhd .dcm, closed surfaces as .obj .off .stl .ply .vtp");
    Scan scan = kind == InputKind::labels ? read_label_scan(options) : read_surface_scan(options);
    scan.input = options.input;
    scan.sha256 = sha256_of_file(options.input);
    return scan;
}

Scan read_plain_surface(const ScanOptions& options) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(options.input, ignored))
        throw IoError(options.input.string() +
                      ": there is no such file; check its name and folder");
    Scan scan = one_surface(options);
    scan.input = options.input;
    scan.sha256 = sha256_of_file(options.input);
    return scan;
}

void tell(const Scan& scan, ProgressSink& progress) {
    for (const std::string& warning : scan.warnings) progress.warn(warning);
    if (!scan.gaps) return;
    const levelset::GapReport& gaps = *scan.gaps;
    if (gaps.width > 0)
        progress.note("gaps up to " + readable(gaps.width) +
                      " mm closed: " + counted(gaps.narrow_voxels, "voxel") + ", " +
                      readable(gaps.narrow_volume) + " mm^3");
    if (gaps.pockets > 0)
        progress.note(counted(gaps.pockets, "unlabelled pocket") + " (" +
                      readable(gaps.pocket_volume) + " mm^3) " + (gaps.width > 0 ? "lay" : "lie") +
                      " enclosed between tissues" +
                      (gaps.width > 0 ? "" : "; --close-gaps MM gives narrow ones to them"));
}

}  // namespace myotet::app
