// SPDX-License-Identifier: Apache-2.0
#include "Report/Slices.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "Core/Errors.h"
#include "Core/Text.h"
#include "Report/Html.h"

namespace myotet::report {
namespace {

// Which of the patient's axes goes to the right and which downwards in a picture.
struct Turned {
    int right, down;
    double down_sign;
};

Turned turned(int axis) {
    if (axis == 0) return {1, 2, -1};  // from the left: P to the right, S upwards
    if (axis == 1) return {0, 2, -1};  // from the front: L to the right, S upwards
    return {0, 1, 1};                  // from below: L to the right, A upwards
}

using Edge = std::pair<std::int32_t, std::int32_t>;

// The two edges by which each crossed triangle is left.
std::vector<std::array<Edge, 2>> crossings(const TriMesh& surface, int axis, double at) {
    std::vector<std::array<Edge, 2>> crossed;
    const auto above = [&](std::int32_t n) { return surface.points[n][axis] >= at; };
    for (const Triangle& t : surface.triangles) {
        std::array<Edge, 2> edges;
        int count = 0;
        for (int c = 0; c < 3; ++c) {
            const std::int32_t a = t[c], b = t[(c + 1) % 3];
            if (above(a) != above(b)) edges[count++] = std::minmax(a, b);
        }
        if (count == 2) crossed.push_back(edges);
    }
    return crossed;
}

Vec3 crossing_point(const TriMesh& surface, const Edge& edge, int axis, double at) {
    const Vec3 &a = surface.points[edge.first], &b = surface.points[edge.second];
    return a + (at - a[axis]) / (b[axis] - a[axis]) * (b - a);
}

std::string decimal(double x) { return formatted("%.2f", x); }

std::string path_of(const std::vector<Vec3>& curve, const SliceView& view) {
    std::string path;
    for (const Vec3& point : curve) {
        const Vec2 place = view.to_picture(point);
        path += (path.empty() ? "M" : "L") + decimal(place.x()) + " " + decimal(place.y());
    }
    return path;
}

std::string letters(const SliceView& view) {
    const Sides sides = view.sides();
    const double w = view.width(), h = view.height(), size = 0.038 * std::max(w, h);
    const auto letter = [&](double x, double y, char side) {
        return "<text x=\"" + decimal(x) + "\" y=\"" + decimal(y) + "\">" + side + "</text>";
    };
    return "<g class=\"sides\" font-size=\"" + decimal(size) + "\" stroke-width=\"" +
           decimal(0.2 * size) + "\" text-anchor=\"middle\">" +
           letter(0.5 * size, 0.5 * h + 0.35 * size, sides.left) +
           letter(w - 0.5 * size, 0.5 * h + 0.35 * size, sides.right) +
           letter(0.5 * w, 0.85 * size, sides.top) + letter(0.5 * w, h - 0.2 * size, sides.bottom) +
           "</g>";
}

}  // namespace

double SliceView::width() const { return box.extent()[turned(axis).right]; }

double SliceView::height() const { return box.extent()[turned(axis).down]; }

Sides SliceView::sides() const {
    const auto [r, d, sign] = turned(axis);
    const Vec3 right = Vec3::Unit(r), down = sign * Vec3::Unit(d);
    return {side_of(-right), side_of(right), side_of(-down), side_of(down)};
}

Vec2 SliceView::to_picture(const Vec3& point) const {
    const auto [r, d, sign] = turned(axis);
    return {point[r] - box.min[r], sign > 0 ? point[d] - box.min[d] : box.max[d] - point[d]};
}

Vec3 SliceView::to_patient(const Vec2& place, double at) const {
    const auto [r, d, sign] = turned(axis);
    Vec3 point;
    point[axis] = at;
    point[r] = box.min[r] + place.x();
    point[d] = sign > 0 ? box.min[d] + place.y() : box.max[d] - place.y();
    return point;
}

std::string slice_name(int axis) {
    return axis == 0 ? "sagittal" : axis == 1 ? "coronal" : "axial";
}

std::vector<std::vector<Vec3>> section(const TriMesh& surface, int axis, double at) {
    const auto crossed = crossings(surface, axis, at);
    std::map<Edge, std::vector<std::size_t>> triangles_at;
    for (std::size_t t = 0; t < crossed.size(); ++t)
        for (const Edge& edge : crossed[t]) triangles_at[edge].push_back(t);
    std::vector<char> used(crossed.size(), 0);
    std::vector<std::vector<Vec3>> curves;
    // From an edge through triangles not yet used, as far as it goes.
    const auto walk = [&](std::size_t t, Edge edge) {
        std::vector<Vec3> curve{crossing_point(surface, edge, axis, at)};
        for (bool goes_on = true; goes_on;) {
            used[t] = 1;
            edge = crossed[t][0] == edge ? crossed[t][1] : crossed[t][0];
            curve.push_back(crossing_point(surface, edge, axis, at));
            const auto& next = triangles_at[edge];
            const auto found = std::ranges::find_if(next, [&](std::size_t n) { return !used[n]; });
            goes_on = found != next.end();
            if (goes_on) t = *found;
        }
        curves.push_back(std::move(curve));
    };
    for (std::size_t t = 0; t < crossed.size(); ++t)  // open curves begin at their ends
        for (const Edge& edge : crossed[t])
            if (!used[t] && triangles_at[edge].size() == 1) walk(t, edge);
    for (std::size_t t = 0; t < crossed.size(); ++t)
        if (!used[t]) walk(t, crossed[t][0]);
    return curves;
}

Picture label_picture(std::span<const LabelVolume> layers, const SliceView& view, double at,
                      double pixel, const LabelColour& colour) {
    if (!(pixel > 0)) throw InputError("a slice's pixels have no width; give one above 0 mm");
    const auto count = [&](double length) {
        return std::max(1, static_cast<int>(std::ceil(length / pixel - 1e-9)));
    };
    Picture picture = blank(count(view.width()), count(view.height()));
    for (std::size_t l = 0; l < layers.size(); ++l) {
        const LabelVolume& volume = layers[l];
        const Eigen::Affine3d to_index = volume.index_to_lps.inverse();
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x) {
                const Vec3 index =
                    to_index * view.to_patient({(x + 0.5) * pixel, (y + 0.5) * pixel}, at);
                Index3 voxel;
                bool inside = true;
                for (int c = 0; c < 3; ++c) {
                    voxel[c] = static_cast<int>(std::floor(index[c] + 0.5));
                    inside = inside && voxel[c] >= 0 && voxel[c] < volume.size[c];
                }
                if (!inside) continue;
                const std::int32_t value =
                    volume.values[volume.offset(voxel[0], voxel[1], voxel[2])];
                if (value != 0) set_pixel(picture, x, y, colour(static_cast<int>(l), value));
            }
    }
    return picture;
}

std::string slice_svg(const Picture& labels, std::span<const Outlined> meshes,
                      const SliceView& view, double at, const std::string& alternative) {
    const double w = view.width(), h = view.height();
    std::string outlines;
    for (const Outlined& mesh : meshes) {
        std::string path;
        for (const std::vector<Vec3>& curve : section(mesh.surface, view.axis, at))
            path += path_of(curve, view);
        if (!path.empty())
            outlines += "<path stroke=\"" + css_colour(mesh.colour) + "\" d=\"" + path + "\"/>";
    }
    // A picture's last column and row may reach beyond the box.
    const double pixel = std::max(w / labels.width, h / labels.height);
    return "<svg class=\"slice\" viewBox=\"0 0 " + decimal(w) + " " + decimal(h) +
           "\" role=\"img\" aria-label=\"" + escaped(alternative) + "\"><image width=\"" +
           decimal(pixel * labels.width) + "\" height=\"" + decimal(pixel * labels.height) +
           "\" preserveAspectRatio=\"none\" href=\"" + data_uri(labels) +
           "\"/><g class=\"outline\">" + outlines + "</g>" + letters(view) + "</svg>";
}

}  // namespace myotet::report
