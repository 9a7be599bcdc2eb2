// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>

#include "Quality/LabelDistance.h"
#include "Report/Decimate.h"
#include "Text.h"
#include "ViewerScenes.h"

namespace myotet::app {
namespace {

using report::ViewedBody;
using report::ViewedScene;
using report::ViewedValues;

constexpr std::size_t kMostTets = 1500000;
constexpr std::size_t kMostTriangles = 300000;  // of all bodies that are surfaces
constexpr double kFarVoxels = 3;  // distances to labels are told up to here, of the longest side

std::string label_of(const TissueView& tissue) {
    return (tissue.layer > 0 ? std::to_string(tissue.layer) + ":" : "") +
           std::to_string(tissue.label) + " " + tissue.name;
}

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

// Takes tetrahedra from the largest bodies until the others are few enough.
std::vector<std::string> keep_to_most_tets(ViewedScene& scene) {
    std::vector<ViewedBody*> order;
    std::size_t left = 0;
    for (ViewedBody& body : scene.bodies) {
        order.push_back(&body);
        left += body.mesh.tets.size();
    }
    std::ranges::stable_sort(order, std::greater{},
                             [](const ViewedBody* body) { return body->mesh.tets.size(); });
    std::vector<std::string> emptied;
    for (ViewedBody* body : order) {
        if (left <= kMostTets) break;
        left -= body->mesh.tets.size();
        body->mesh = {};
        emptied.push_back(body->name);
    }
    return emptied;
}

// Each surface keeps its share of the triangles that there may be.
std::vector<std::string> keep_to_most_triangles(ViewedScene& scene) {
    std::size_t all = 0;
    for (const ViewedBody& body : scene.bodies)
        if (body.mesh.tets.empty()) all += body.surface.triangles.size();
    std::vector<std::string> thinned;
    if (all <= kMostTriangles) return thinned;
    for (ViewedBody& body : scene.bodies) {
        if (!body.mesh.tets.empty()) continue;
        const double share =
            static_cast<double>(body.surface.triangles.size()) / static_cast<double>(all);
        body.surface = report::decimated(
            body.surface, static_cast<std::size_t>(share * static_cast<double>(kMostTriangles)));
        thinned.push_back(body.name);
    }
    return thinned;
}

std::vector<double> distances_of(const TissueView& tissue, const ViewedBody& body,
                                 const std::vector<LabelVolume>& layers) {
    const LabelVolume& labels = layers[static_cast<std::size_t>(tissue.layer)];
    const double limit = kFarVoxels * labels.spacing().maxCoeff();
    if (body.mesh.tets.empty())
        return quality::distance_to_label(labels, tissue.label, body.surface.points, limit);
    std::vector<std::int32_t> outer;
    for (const Triangle& face : boundary_faces(body.mesh.tets))
        outer.insert(outer.end(), face.begin(), face.end());
    std::ranges::sort(outer);
    outer.erase(std::unique(outer.begin(), outer.end()), outer.end());
    std::vector<Vec3> points;
    for (const std::int32_t n : outer) points.push_back(body.mesh.points[n]);
    const std::vector<double> found =
        quality::distance_to_label(labels, tissue.label, points, limit);
    std::vector<double> all(body.mesh.points.size(), NAN);
    for (std::size_t i = 0; i < outer.size(); ++i) all[outer[i]] = found[i];
    return all;
}

void add_distances(const MeshViews& views, ViewedScene& scene) {
    double most = 0;
    for (std::size_t t = 0; t < views.tissues.size(); ++t) {
        const TissueView& tissue = views.tissues[t];
        ViewedBody& body = scene.bodies[t];
        if (static_cast<std::size_t>(tissue.layer) >= views.layers.size() ||
            body.mesh.tets.size() + body.surface.triangles.size() == 0)
            continue;
        std::vector<double> distances = distances_of(tissue, body, views.layers);
        for (const double d : distances)
            if (std::isfinite(d)) most = std::max(most, d);
        body.values.push_back(
            {.quantity = 0, .at = ViewedValues::At::points, .times = {std::move(distances)}});
    }
    if (std::ranges::any_of(scene.bodies, [](const ViewedBody& b) { return !b.values.empty(); }))
        scene.quantities.push_back({"distance to the labels, mm", 0, most});
}

}  // namespace

ViewedScene mesh_scene(const MeshViews& views) {
    ViewedScene made;
    if (views.box.empty()) {
        made.notes.emplace_back("No mesh was written.");
        return made;
    }
    for (const TissueView& tissue : views.tissues)
        made.bodies.push_back(
            {.name = label_of(tissue) + (tissue.surface.triangles.empty() ? ", no mesh" : ""),
             .colour = tissue.colour,
             .mesh = tissue.mesh,
             .surface = tissue.surface});
    const std::vector<std::string> emptied = keep_to_most_tets(made);
    const std::vector<std::string> thinned = keep_to_most_triangles(made);
    if (!emptied.empty())
        made.notes.push_back(
            "There are more tetrahedra than the view holds; of these tissues it "
            "shows the surface alone: " +
            listed(emptied) + ".");
    if (!thinned.empty())
        made.notes.push_back("These surfaces are decimated for the view: " + listed(thinned) + ".");
    if (emptied.empty() && thinned.empty())
        made.notes.emplace_back("The view holds each tetrahedron and triangle of the meshes.");
    add_distances(views, made);
    if (!made.quantities.empty())
        made.notes.emplace_back(
            "Distances are those of the surface's nodes from the labels' voxels, whose corners it "
            "rounds off.");
    return made;
}

}  // namespace myotet::app
