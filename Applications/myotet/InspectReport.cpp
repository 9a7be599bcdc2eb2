// SPDX-License-Identifier: Apache-2.0
#include "InspectReport.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Scan.h"
#include "Sizing.h"

namespace myotet::app {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

struct PatientAxis {
    int axis = 0;    ///< of LPS
    bool up = true;  ///< grows as the index does
};

/// The patient's axis that each index axis follows: the closest pair first, so
/// that no two take the same.
std::array<PatientAxis, 3> match_axes(const Mat3& directions) {
    std::array<PatientAxis, 3> result;
    Mat3 left = directions.cwiseAbs();
    for (int n = 0; n < 3; ++n) {
        int patient = 0, index = 0;
        left.maxCoeff(&patient, &index);
        result[index] = {patient, directions(patient, index) > 0};
        left.row(patient).setConstant(-1);
        left.col(index).setConstant(-1);
    }
    return result;
}

double angle_deg(double cosine) { return kDegrees * std::acos(std::clamp(cosine, -1.0, 1.0)); }

/// Area of a label's surface: what it shares with others and the volume's border.
double surface_area(const segmentation::LabelInspection& label, const Vec3& spacing) {
    double area = 0;
    for (const segmentation::Contact& c : label.contacts) area += c.area;
    for (int side = 0; side < 6; ++side)
        area += static_cast<double>(label.cut[side]) * spacing.prod() / spacing[side / 2];
    return area;
}

/// What `mesh` would take without being told.
double default_edge_length(const InspectReport& report) {
    Scan scan;
    scan.spacing = report.grid.spacing;
    for (const InspectedLabel& l : report.labels)
        scan.tissues.push_back({.label = l.found.value,
                                .name = l.name,
                                .voxels = l.found.voxels,
                                .volume = l.found.volume,
                                .area = surface_area(l.found, report.grid.spacing)});
    return choose_sizes({}, scan).edge_length;
}

void add_layer(InspectReport& report, const LabelVolume& volume, std::size_t layer) {
    segmentation::Inspection found = segmentation::inspect(volume);
    report.pockets.push_back(found.pockets);
    report.pocket_voxels.push_back(found.pocket_voxels);
    const auto has_name = [&](std::int32_t value) {
        const auto it = volume.names.find(value);
        return it != volume.names.end() && !it->second.name.empty();
    };
    for (const auto& [value, name] : volume.names)
        if (value != 0 && !std::ranges::binary_search(found.labels, value, {},
                                                      &segmentation::LabelInspection::value))
            report.unused_names.push_back({layer, value, name.name});
    for (segmentation::LabelInspection& label : found.labels) {
        const std::int32_t value = label.value;
        report.labels.push_back(
            {layer, volume.name_of(value), has_name(value), std::move(label), {}});
    }
}

}  // namespace

GridReport describe_grid(const LabelVolume& volume) {
    GridReport grid;
    grid.size = volume.size;
    grid.index_to_lps = volume.index_to_lps;
    grid.spacing = volume.spacing();
    const Mat3 directions = volume.index_to_lps.linear().colwise().normalized();
    grid.left_handed = directions.determinant() < 0;
    constexpr const char* kWords[3][2] = {
        {"right", "left"}, {"anterior", "posterior"}, {"inferior", "superior"}};
    constexpr const char* kLetters[3] = {"RL", "AP", "IS"};
    const auto axes = match_axes(directions);
    for (int a = 0; a < 3; ++a) {
        const auto [patient, up] = axes[a];
        grid.axes += kLetters[patient][up ? 1 : 0];
        grid.sides[2 * a] = kWords[patient][up ? 0 : 1];
        grid.sides[2 * a + 1] = kWords[patient][up ? 1 : 0];
        grid.oblique_deg = std::max(grid.oblique_deg, angle_deg(std::abs(directions(patient, a))));
        const double cosine = directions.col(a).dot(directions.col((a + 1) % 3));
        grid.shear_deg = std::max(grid.shear_deg, std::abs(90 - angle_deg(cosine)));
    }
    return grid;
}

std::string name_in(const InspectReport& report, std::size_t layer, std::int32_t value) {
    for (const InspectedLabel& l : report.labels)
        if (l.layer == layer && l.found.value == value) return l.name;
    return value == 0 ? "unlabelled" : "label_" + std::to_string(value);
}

InspectReport inspect_file(const std::filesystem::path& file,
                           const segmentation::ReadOptions& options) {
    const segmentation::LabelFile labels = segmentation::read_labels(file, options);
    InspectReport report;
    report.input = file.string();
    report.names_from = labels.names_from.string();
    report.warnings = labels.warnings;
    report.grid = describe_grid(labels.layers.front());
    for (std::size_t layer = 0; layer < labels.layers.size(); ++layer)
        add_layer(report, labels.layers[layer], layer);
    report.overlaps = segmentation::find_overlaps(labels.layers);
    report.edge_length = default_edge_length(report);
    add_notes(report);
    return report;
}

}  // namespace myotet::app
