// SPDX-License-Identifier: Apache-2.0
// What `inspect` says in words: what would be lost or changed at the default
// settings, and what to do about it.
#include <algorithm>
#include <cmath>

#include "InspectReport.h"
#include "LevelSet/SliceShape.h"
#include "Text.h"

namespace myotet::app {
namespace {

using segmentation::LabelInspection;
using segmentation::Piece;

constexpr std::int64_t kSpeck = 8;       // voxels: at most two a side
constexpr double kThinShare = 0.02;      // of a label's voxels; every tip ends in a few
constexpr double kVisibleAngle = 0.01;   // degrees: less is rounding in the header
constexpr double kLongerThanTwo = 1.01;  // voxels: the edge length was made longer on purpose
constexpr std::size_t kListed = 4;

std::string percent(double share) { return readable(100 * share) + " %"; }

double share(std::int64_t part, std::int64_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
}

/// "is" or "are", "it" or "they" and the like.
const char* one_or_many(std::int64_t count, const char* one, const char* many) {
    return count == 1 ? one : many;
}

void note_thin_pieces(const LabelInspection& label, double edge, std::vector<std::string>& notes) {
    std::int64_t thin = 0, voxels = 0, specks = 0;
    for (const Piece& p : label.pieces)
        if (p.inscribed_radius < edge) {
            ++thin;
            voxels += p.voxels;
            specks += p.voxels <= kSpeck;
        }
    if (thin == 0) return;
    const auto all = static_cast<std::int64_t>(label.pieces.size());
    std::string text =
        (thin == all ? all == 1 ? std::string("All of it")
                                : "Each of its " + std::to_string(all) + " pieces"
                     : std::to_string(thin) + " of its " + counted(all, "piece")) +
        " (" + counted(voxels, "voxel") + ", " + percent(share(voxels, label.voxels)) + ") " +
        (thin == 1 || thin == all ? "is" : "are") + " thinner than two edge lengths of " +
        readable(edge) + " mm and may be missing from its mesh";
    if (specks > 0)
        text += "; " + counted(specks, "piece") +
                one_or_many(specks, " is a speck", " are specks") + " of at most " +
                std::to_string(kSpeck) + " voxels, to be removed if " +
                one_or_many(specks, "it is a flaw", "they are flaws");
    if (specks < thin) text += "; a shorter --edge-length keeps what is thin";
    notes.push_back(text + ".");
}

void note_sheets(const LabelInspection& label, std::vector<std::string>& notes) {
    const double part = share(label.one_voxel_thick, label.voxels);
    if (!(part >= kThinShare)) return;
    notes.push_back(counted(label.one_voxel_thick, "voxel") + " (" + percent(part) +
                    ") lie where it is one voxel thick: smoothing is held back there, so that "
                    "nothing vanishes, and the voxels' steps stay visible.");
}

void note_cavities(const LabelInspection& label, double voxel, std::vector<std::string>& notes) {
    const segmentation::Cavities& c = label.cavities;
    if (c.unlabelled_count > 0)
        notes.push_back("It encloses " + counted(c.unlabelled_count, "unlabelled void") + " (" +
                        readable(voxel * static_cast<double>(c.unlabelled_voxels)) +
                        " mm^3), which the mesh will have as hollows: fill them first if they are "
                        "flaws of the segmentation.");
    if (c.count > c.unlabelled_count)
        notes.push_back("It encloses other labels wholly in " +
                        counted(c.count - c.unlabelled_count, "place") + " (" +
                        readable(voxel * static_cast<double>(c.voxels - c.unlabelled_voxels)) +
                        " mm^3).");
}

void note_cut(const LabelInspection& label, const GridReport& grid,
              std::vector<std::string>& notes) {
    std::string sides;
    for (int side = 0; side < 6; ++side)
        if (label.cut[side] > 0)
            sides += (sides.empty() ? "" : ", ") + grid.sides[side] + " (" +
                     counted(label.cut[side], "voxel") + ")";
    if (!sides.empty())
        notes.push_back("The field of view cuts it: " + sides +
                        "; its mesh ends there in a flat cap.");
}

void note_edge_length(InspectReport& report) {
    const double two = 2 * std::cbrt(report.grid.spacing.prod());
    if (report.edge_length > kLongerThanTwo * two)
        report.notes.push_back(
            "Two voxels to an edge would make more than a million tetrahedra, so that the default "
            "edge length is " +
            readable(report.edge_length) + " mm: --edge-length " + readable(two) +
            " keeps all detail.");
}

void note_grid(InspectReport& report) {
    const GridReport& grid = report.grid;
    Vec3 sorted = grid.spacing;
    std::sort(sorted.begin(), sorted.end());
    if (sorted[2] >= levelset::kThickSlices * sorted[1])
        report.notes.push_back("Slices are " + readable(sorted[2]) + " mm apart, " +
                               readable(sorted[2] / sorted[1]) + " times the " +
                               readable(sorted[1]) +
                               " mm in the plane: shapes between them are interpolated, not seen.");
    if (grid.left_handed)
        report.notes.push_back(
            "The index axes are left-handed, as many scanners write them: meshes come out right.");
    if (grid.shear_deg > kVisibleAngle)
        report.notes.push_back("The index axes miss right angles by " + readable(grid.shear_deg) +
                               " degrees (gantry tilt): meshes are sheared as the scan says, radii "
                               "here are not.");
}

void note_pockets(InspectReport& report, double voxel) {
    for (std::size_t layer = 0; layer < report.pockets.size(); ++layer) {
        if (report.pockets[layer] == 0) continue;
        const std::string where =
            report.pockets.size() > 1 ? " of layer " + std::to_string(layer + 1) : "";
        report.notes.push_back(
            counted(report.pockets[layer], "unlabelled pocket") + " (" +
            readable(voxel * static_cast<double>(report.pocket_voxels[layer])) + " mm^3) " +
            one_or_many(report.pockets[layer], "lies", "lie") + " enclosed between the labels" +
            where + " and would stay as gaps: --close-gaps MM closes those that are narrow.");
    }
}

void note_overlaps(InspectReport& report) {
    if (report.overlaps.empty()) return;
    std::vector<segmentation::Overlap> largest = report.overlaps;
    std::ranges::stable_sort(largest, std::ranges::greater{}, &segmentation::Overlap::voxels);
    std::string list;
    for (std::size_t n = 0; n < std::min(kListed, largest.size()); ++n) {
        const segmentation::Overlap& o = largest[n];
        list += (n ? "; " : "") + name_in(report, o.layer_a, o.value_a) + " and " +
                name_in(report, o.layer_b, o.value_b) + " by " + counted(o.voxels, "voxel");
    }
    const auto count = static_cast<std::int64_t>(largest.size());
    report.notes.push_back(counted(count, "pair") + " of labels in different layers " +
                           one_or_many(count, "overlaps", "overlap") + " (" + list +
                           (largest.size() > kListed ? "; ..." : "") +
                           "): each is meshed whole unless a repair's priority decides.");
}

void note_names(InspectReport& report) {
    std::string list;
    std::int64_t nameless = 0;
    for (const InspectedLabel& l : report.labels)
        if (!l.named && nameless++ < static_cast<std::int64_t>(kListed))
            list += (list.empty() ? "" : ", ") + std::to_string(l.found.value);
    if (nameless > 0)
        report.notes.push_back(counted(nameless, "label") + one_or_many(nameless, " has", " have") +
                               " no name (" + list +
                               (nameless > static_cast<std::int64_t>(kListed) ? ", ..." : "") +
                               "): give names with --names TABLE.");
    if (report.unused_names.empty()) return;
    list.clear();
    for (std::size_t n = 0; n < std::min(kListed, report.unused_names.size()); ++n)
        list += (n ? ", " : "") + std::to_string(report.unused_names[n].value) + " " +
                report.unused_names[n].name;
    const auto count = static_cast<std::int64_t>(report.unused_names.size());
    report.notes.push_back(counted(count, "name") + one_or_many(count, " belongs", " belong") +
                           " to values without voxels (" + list +
                           (report.unused_names.size() > kListed ? ", ..." : "") +
                           "): check that the table is this scan's.");
}

}  // namespace

void add_notes(InspectReport& report) {
    const double voxel = std::abs(report.grid.index_to_lps.linear().determinant());
    for (InspectedLabel& l : report.labels) {
        note_thin_pieces(l.found, report.edge_length, l.notes);
        note_sheets(l.found, l.notes);
        note_cavities(l.found, voxel, l.notes);
        note_cut(l.found, report.grid, l.notes);
    }
    note_grid(report);
    note_edge_length(report);
    note_names(report);
    note_overlaps(report);
    note_pockets(report, voxel);
}

}  // namespace myotet::app
