// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include "MeshViews.h"
#include "Report/Html.h"
#include "Report/Page.h"
#include "Report/Slices.h"
#include "Text.h"

namespace myotet::app {
namespace {

constexpr int kMostSlices = 21, kFewSlices = 11;
constexpr std::size_t kManyTriangles = 400000;  // of all surfaces: fewer slices keep pages small
constexpr double kMostPixels = 400;             // along a slice's longer side
constexpr double kRoom = 0.04;                  // around the meshes, of the box's longest side
constexpr double kPale = 0.6;                   // share of white in labels below outlines
constexpr double kDark = 0.72;                  // of a tissue's colour in its outline
constexpr report::Colour kOther{0.9, 0.9, 0.9};

report::Colour mixed(const report::Colour& colour, double share, double other) {
    report::Colour made;
    for (int c = 0; c < 3; ++c) made[c] = (1 - share) * colour[c] + share * other;
    return made;
}

// Pale for tissues that were meshed, grey for others.
report::LabelColour label_colours(const MeshViews& views) {
    std::map<std::pair<int, std::int32_t>, report::Colour> colours;
    for (const TissueView& tissue : views.tissues)
        colours[{tissue.layer, tissue.label}] = mixed(tissue.colour, kPale, 1);
    return [colours](int layer, std::int32_t label) {
        const auto found = colours.find({layer, label});
        return found != colours.end() ? found->second : kOther;
    };
}

std::vector<report::Outlined> outlined(const MeshViews& views) {
    std::vector<report::Outlined> meshes;
    for (const TissueView& tissue : views.tissues)
        meshes.push_back({tissue.surface, mixed(tissue.colour, 1 - kDark, 0)});
    return meshes;
}

int slice_count(const std::vector<report::Outlined>& meshes) {
    std::size_t triangles = 0;
    for (const report::Outlined& mesh : meshes) triangles += mesh.surface.triangles.size();
    return triangles > kManyTriangles ? kFewSlices : kMostSlices;
}

}  // namespace

std::string slices_html(const MeshViews& views) {
    if (views.layers.empty() || views.box.empty()) return "";
    const std::vector<report::Outlined> meshes = outlined(views);
    const report::LabelColour colours = label_colours(views);
    report::SliceView view{.box = views.box};
    const double longest = views.box.extent().maxCoeff();
    view.box.min.array() -= kRoom * longest;
    view.box.max.array() += kRoom * longest;
    const double pixel =
        std::max(views.layers[0].spacing().minCoeff(), view.box.extent().maxCoeff() / kMostPixels);
    const int count = slice_count(meshes);
    std::string html = "<div class=\"planes\">\n";
    for (int axis = 2; axis >= 0; --axis) {
        view.axis = axis;
        report::Strip strip{.name = report::slice_name(axis) + " slices",
                            .first = static_cast<std::size_t>(count / 2)};
        for (int i = 0; i < count; ++i) {
            const double at = views.box.min[axis] + (i + 0.5) / count * views.box.extent()[axis];
            const std::string name = report::slice_name(axis) + ", " + std::string(1, "xyz"[axis]) +
                                     " = " + readable(at) + " mm";
            const report::Picture labels =
                report::label_picture(views.layers, view, at, pixel, colours);
            strip.frames.push_back(
                {name, report::slice_svg(labels, meshes, view, at,
                                         "labels and outlines of meshes, " + name)});
        }
        html += report::to_html(strip);
    }
    return html + "</div>\n";
}

}  // namespace myotet::app
