// SPDX-License-Identifier: Apache-2.0
// The inspection as a page for people and as JSON for programs.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "InspectReport.h"
#include "Text.h"

namespace myotet::app {
namespace {

using Json = nlohmann::ordered_json;  // keys in the order in which they are read
using segmentation::Contact;
using segmentation::Piece;

constexpr std::size_t kNameWidth = 28, kSizesListed = 6, kContactsListed = 4;

std::int64_t contacts_with_labels(const segmentation::LabelInspection& label) {
    return std::ranges::count_if(label.contacts, [](const Contact& c) { return c.value != 0; });
}

/// Exactly `width` characters; UTF-8 counts by characters, not by bytes.
std::string padded(const std::string& name, std::size_t width) {
    std::string text;
    std::size_t count = 0;
    for (std::size_t n = 0; n < name.size() && count <= width; ++n) {
        const bool begins = (static_cast<unsigned char>(name[n]) & 0xC0) != 0x80;
        if (begins && ++count > width) break;
        text += name[n];
    }
    return text + std::string(width - std::min(width, count), ' ');
}

/// Three digits, and never an exponent for what is large.
std::string amount(double number) { return formatted(number >= 100 ? "%.0f" : "%.3g", number); }

std::string title_of(const InspectedLabel& l, bool layers) {
    return (layers ? std::to_string(l.layer + 1) + ":" : "") + std::to_string(l.found.value);
}

std::string cut_letters(const InspectedLabel& l, const GridReport& grid) {
    std::string letters;
    for (int side = 0; side < 6; ++side)
        if (l.found.cut[side] > 0) letters += static_cast<char>(grid.sides[side][0] - 'a' + 'A');
    return letters.empty() ? "-" : letters;
}

std::string heading(const InspectReport& report) {
    const GridReport& g = report.grid;
    const Vec3 extent = g.spacing.cwiseProduct(Vec3(g.size[0], g.size[1], g.size[2]));
    const Vec3 origin = g.index_to_lps.translation();
    const std::string text = formatted(
        "  grid      %d x %d x %d voxels of %.4g x %.4g x %.4g mm, in all %.4g x %.4g x "
        "%.4g mm\n"
        "  axes      %s: i grows to %s, j to %s, k to %s; %s, %s\n"
        "  frame     LPS, mm; the first voxel's middle lies at (%.2f, %.2f, %.2f)\n",
        g.size[0], g.size[1], g.size[2], g.spacing[0], g.spacing[1], g.spacing[2], extent[0],
        extent[1], extent[2], g.axes.c_str(), g.sides[1].c_str(), g.sides[3].c_str(),
        g.sides[5].c_str(),
        g.oblique_deg > 0.01 ? ("oblique by " + readable(g.oblique_deg) + " deg").c_str()
                             : "along the patient's axes",
        g.left_handed ? "left-handed" : "right-handed", origin[0], origin[1], origin[2]);
    return report.input + "\n" + text + "  labels    " +
           counted(static_cast<std::int64_t>(report.labels.size()), "label") + " in " +
           counted(static_cast<std::int64_t>(report.pockets.size()), "layer") + "; names from " +
           (report.names_from.empty() ? "nowhere" : report.names_from) + "\n\n";
}

std::string table(const InspectReport& report) {
    const bool layers = report.pockets.size() > 1;
    std::string out =
        "                                                                             inscribed "
        "radius\n"
        "  label  name                              voxels  volume mm^3  pieces  voids  median   "
        "least  touches  cut\n";
    for (const InspectedLabel& l : report.labels) {
        const std::string text = formatted(
            "%10lld %12.6g %7zu %6lld %7.3g %7.3g %8lld  %s\n",
            static_cast<long long>(l.found.voxels), l.found.volume, l.found.pieces.size(),
            static_cast<long long>(l.found.cavities.count), l.found.median_radius,
            l.found.smallest_radius, static_cast<long long>(contacts_with_labels(l.found)),
            cut_letters(l, report.grid).c_str());
        const std::string title = title_of(l, layers);
        out += std::string(7 - std::min<std::size_t>(7, title.size()), ' ') + title + "  " +
               padded(l.name, kNameWidth) + "  " + text;
    }
    return out;
}

std::string sizes_of(const std::vector<Piece>& pieces) {
    std::string text;
    for (std::size_t n = 0; n < std::min(kSizesListed, pieces.size()); ++n)
        text += (n ? ", " : "") + std::to_string(pieces[n].voxels);
    return text + (pieces.size() > kSizesListed ? ", ..." : "") + " voxels";
}

std::string contacts_of(const InspectReport& report, const InspectedLabel& l) {
    std::vector<Contact> largest = l.found.contacts;
    std::erase_if(largest, [](const Contact& c) { return c.value == 0; });
    std::ranges::stable_sort(largest, std::ranges::greater{}, &Contact::area);
    std::string text;
    for (std::size_t n = 0; n < std::min(kContactsListed, largest.size()); ++n)
        text += (n ? ", " : "") + name_in(report, l.layer, largest[n].value) + " " +
                amount(largest[n].area) + " mm^2";
    return text + (largest.size() > kContactsListed ? ", ..." : "");
}

/// Pieces, contacts and notes of each label that has some.
std::string details(const InspectReport& report) {
    std::string out;
    for (const InspectedLabel& l : report.labels) {
        std::string lines;
        if (l.found.pieces.size() > 1)
            lines += "      pieces of " + sizes_of(l.found.pieces) + "\n";
        const std::string contacts = contacts_of(report, l);
        if (!contacts.empty()) lines += "      touches " + contacts + "\n";
        for (const std::string& note : l.notes) lines += "    * " + note + "\n";
        if (!lines.empty())
            out += "  " + title_of(l, report.pockets.size() > 1) + " " + l.name + "\n" + lines;
    }
    return out;
}

Json label_json(const InspectReport& report, const InspectedLabel& l) {
    const segmentation::LabelInspection& f = l.found;
    Json sizes = Json::array(), radii = Json::array(), touches = Json::array(),
         cut = Json::object();
    for (const Piece& p : f.pieces) {
        sizes.push_back(p.voxels);
        radii.push_back(p.inscribed_radius);
    }
    for (const Contact& c : f.contacts)
        touches.push_back({{"label", c.value},
                           {"name", name_in(report, l.layer, c.value)},
                           {"faces", c.faces},
                           {"area_mm2", c.area}});
    for (int side = 0; side < 6; ++side)
        if (f.cut[side] > 0) cut[report.grid.sides[side]] = f.cut[side];
    const double voxel = f.volume / static_cast<double>(f.voxels);
    return {{"layer", l.layer},
            {"label", f.value},
            {"name", l.named ? Json(l.name) : Json(nullptr)},
            {"voxels", f.voxels},
            {"volume_mm3", f.volume},
            {"components", f.pieces.size()},
            {"component_sizes_voxels", sizes},
            {"component_inscribed_radii_mm", radii},
            {"cavities", f.cavities.count},
            {"cavities_volume_mm3", voxel * static_cast<double>(f.cavities.voxels)},
            {"cavities_unlabelled", f.cavities.unlabelled_count},
            {"cavities_unlabelled_volume_mm3",
             voxel * static_cast<double>(f.cavities.unlabelled_voxels)},
            {"inscribed_radius_median_mm", f.median_radius},
            {"inscribed_radius_smallest_mm", f.smallest_radius},
            {"one_voxel_thick_voxels", f.one_voxel_thick},
            {"touches", touches},
            {"cut_by_field_of_view_voxels", cut},
            {"notes", l.notes}};
}

Json grid_json(const GridReport& g) {
    Json matrix = Json::array();
    for (int row = 0; row < 4; ++row) {
        const auto r = g.index_to_lps.matrix().row(row);
        matrix.push_back({r[0], r[1], r[2], r[3]});
    }
    return {
        {"size_voxels", g.size},        {"spacing_mm", {g.spacing[0], g.spacing[1], g.spacing[2]}},
        {"index_to_lps_mm", matrix},    {"axes", g.axes},
        {"oblique_deg", g.oblique_deg}, {"shear_deg", g.shear_deg},
        {"left_handed", g.left_handed}};
}

Json overlaps_json(const InspectReport& report) {
    Json all = Json::array();
    for (const segmentation::Overlap& o : report.overlaps)
        all.push_back(
            {{"layers", {o.layer_a, o.layer_b}},
             {"labels", {o.value_a, o.value_b}},
             {"names",
              {name_in(report, o.layer_a, o.value_a), name_in(report, o.layer_b, o.value_b)}},
             {"voxels", o.voxels}});
    return all;
}

}  // namespace

std::string to_json(const InspectReport& report) {
    const double voxel = std::abs(report.grid.index_to_lps.linear().determinant());
    Json json = {
        {"program", "myotet"},
        {"version", MYOTET_VERSION},
        {"input", report.input},
        {"frame", "LPS"},
        {"units", "mm"},
        {"grid", grid_json(report.grid)},
        {"layers", report.pockets.size()},
        {"names_from", report.names_from.empty() ? Json(nullptr) : Json(report.names_from)},
        {"default_edge_length_mm", report.edge_length},
        {"warnings", report.warnings},
        {"notes", report.notes}};
    json["unlabelled_pockets"] = Json::array();
    for (std::size_t layer = 0; layer < report.pockets.size(); ++layer)
        json["unlabelled_pockets"].push_back(
            {{"layer", layer},
             {"count", report.pockets[layer]},
             {"voxels", report.pocket_voxels[layer]},
             {"volume_mm3", voxel * static_cast<double>(report.pocket_voxels[layer])}});
    json["overlaps"] = overlaps_json(report);
    json["names_without_voxels"] = Json::array();
    for (const UnusedName& u : report.unused_names)
        json["names_without_voxels"].push_back(
            {{"layer", u.layer}, {"label", u.value}, {"name", u.name}});
    json["labels"] = Json::array();
    for (const InspectedLabel& l : report.labels) json["labels"].push_back(label_json(report, l));
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_text(const InspectReport& report) {
    std::string out = heading(report) + table(report) + "\nAt the default settings (edge length " +
                      readable(report.edge_length) + " mm)\n";
    for (const std::string& note : report.notes) out += "  * " + note + "\n";
    return out + details(report);
}

}  // namespace myotet::app
