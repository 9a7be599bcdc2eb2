// SPDX-License-Identifier: Apache-2.0
#include "PressFrames.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "Core/Text.h"
#include "Report/Draw.h"

namespace myotet::app {
namespace {

using membrane::Tool;

constexpr int kWidth = 480, kHeight = 560;  // of one view, pixels
constexpr double kEdgeWidth = 0.0012;       // of what is shown, mm a mm
constexpr report::Colour kEdge{0.25, 0.25, 0.3}, kSteel{0.62, 0.68, 0.78}, kWall{0.97, 0.9, 0.84};

// A ball by circles of latitude.
TriMesh ball(const Vec3& centre, double radius) {
    constexpr int kRound = 32, kRows = 16;
    TriMesh mesh;
    for (int row = 0; row <= kRows; ++row)
        for (int i = 0; i < kRound; ++i) {
            const double down = std::numbers::pi * row / kRows,
                         turn = 2 * std::numbers::pi * i / kRound;
            mesh.points.push_back(centre + radius * Vec3(std::sin(down) * std::cos(turn),
                                                         std::sin(down) * std::sin(turn),
                                                         std::cos(down)));
        }
    for (std::int32_t row = 0; row < kRows; ++row)
        for (std::int32_t i = 0; i < kRound; ++i) {
            const std::int32_t a = row * kRound + i, b = row * kRound + (i + 1) % kRound;
            if (row + 1 < kRows) mesh.triangles.push_back({a, a + kRound, b + kRound});
            if (row > 0) mesh.triangles.push_back({a, b + kRound, b});
        }
    return mesh;
}

// A square of a plane, as wide as what it presses.
TriMesh square(const Vec3& on, const Vec3& normal, double half) {
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    return {{on - half * (u + v), on + half * (u - v), on + half * (u + v), on - half * (u - v)},
            {{0, 1, 2}, {0, 2, 3}}};
}

std::vector<double> three(const std::vector<std::int32_t>& nodes, const auto& value) {
    std::vector<double> numbers;
    for (const std::int32_t v : nodes) {
        const Vec3 p = value(v);
        numbers.insert(numbers.end(), {p.x(), p.y(), p.z()});
    }
    return numbers;
}

std::vector<double> one(const std::vector<std::int32_t>& nodes, const auto& value) {
    std::vector<double> numbers;
    for (const std::int32_t v : nodes) numbers.push_back(value(v));
    return numbers;
}

double level_of(const membrane::Levels& levels, std::int32_t v) {
    double level = 0;
    while (v >= levels.meshes[static_cast<std::size_t>(level)].vertex_count) ++level;
    return level;
}

// Each triangle as a smaller one, coloured where it has moved, and a dark border.
std::array<report::Shape, 2> with_edges(const PressFrame& frame, const PressView& view) {
    constexpr double kMoved = 0.02;  // of the largest displacement
    const double width = kEdgeWidth * view.fit.diagonal();
    const auto& displacement = frame.arrays.points[3].values;
    const auto moved = [&](std::int32_t v) {
        return Vec3(displacement[3 * v], displacement[3 * v + 1], displacement[3 * v + 2]).norm();
    };
    report::Shape inside{.surface = {}, .colour = kWall},
        border{.surface = {.points = frame.surface.points}, .colour = kEdge};
    for (const auto& [a, b, c] : frame.surface.triangles) {
        auto& points = border.surface.points;
        const Vec3 x = points[a], y = points[b], z = points[c], centre = (x + y + z) / 3;
        const double inner =
            (y - x).cross(z - x).norm() / ((y - x).norm() + (z - y).norm() + (x - z).norm());
        const double part = std::max(0.5, 1 - width / std::max(inner, width));
        const auto first = static_cast<std::int32_t>(points.size()),
                   own = static_cast<std::int32_t>(inside.surface.points.size());
        for (const Vec3& p : {x, y, z}) {
            points.push_back(centre + part * (p - centre));
            inside.surface.points.push_back(points.back());
        }
        inside.surface.triangles.push_back({own, own + 1, own + 2});
        const double mean = (moved(a) + moved(b) + moved(c)) / 3;
        inside.values.push_back(mean > kMoved * view.most ? mean : std::nan(""));
        const std::array<std::int32_t, 3> outside{a, b, c};
        for (std::int32_t i = 0; i < 3; ++i) {
            const std::int32_t j = (i + 1) % 3;
            border.surface.triangles.push_back({outside[i], outside[j], first + j});
            border.surface.triangles.push_back({outside[i], first + j, first + i});
        }
    }
    return {inside, border};
}

Vec3 up_for(const Vec3& direction) {
    constexpr double kAlong = 0.9;
    // In LPS the head is +z, the front -y.
    return std::abs(direction.z()) > kAlong ? Vec3(-Vec3::UnitY()) : Vec3(Vec3::UnitZ());
}

// The box about its middle made smaller, so that what it holds fills the picture.
Box tightened(const PressView& view, const Vec3& direction) {
    const Vec3 right = direction.cross(up_for(direction)).normalized(),
               up = right.cross(direction).normalized(), centre = view.fit.centre(),
               half = view.fit.extent() / 2;
    double widest = 0, highest = 0;
    for (const Vec3& p : view.points) {
        widest = std::max(widest, std::abs(right.dot(p - centre)));
        highest = std::max(highest, std::abs(up.dot(p - centre)));
    }
    constexpr double kRoom = 1.15;
    const double part =
        kRoom * std::max(widest / right.cwiseAbs().dot(half), highest / up.cwiseAbs().dot(half));
    Box box;
    box.include(centre - part * half);
    box.include(centre + part * half);
    return box;
}

report::Picture draw_from(std::span<const report::Shape> shapes, const PressView& view,
                          const Vec3& direction, const std::string& title) {
    return report::draw(shapes, {.direction = direction,
                                 .up = up_for(direction),
                                 .width = kWidth,
                                 .height = kHeight,
                                 .least = 0,
                                 .most = view.most,
                                 .values_name = "displacement, mm",
                                 .title = title,
                                 .fit = tightened(view, direction)});
}

}  // namespace

PressFrame frame_of(const membrane::View& view, std::int32_t label) {
    const membrane::Active& active = view.body.active;
    const membrane::Levels& levels = view.body.levels;
    const auto& nodes = active.nodes;
    const auto now = membrane::mean_curvatures(active, view.motion.x),
               rest = membrane::mean_curvatures(active, levels.rest);
    std::vector<std::int32_t> number(levels.rest.size(), -1);
    PressFrame frame;
    for (const std::int32_t v : nodes) {
        number[v] = static_cast<std::int32_t>(frame.surface.points.size());
        frame.surface.points.push_back(view.motion.x[v]);
    }
    for (const auto& [a, b, c] : active.drawn)
        frame.surface.triangles.push_back({number[a], number[b], number[c]});
    frame.arrays.points = {
        {"level", 1, one(nodes, [&](auto v) { return level_of(levels, v); })},
        {"mass", 1, one(nodes, [&](auto v) { return active.mass[v]; })},
        {"force", 3, three(nodes, [&](auto v) { return view.forces.external[v]; })},
        {"displacement", 3,
         three(nodes, [&](auto v) { return Vec3(view.motion.x[v] - levels.rest[v]); })},
        {"velocity", 3, three(nodes, [&](auto v) { return view.motion.v[v]; })},
        {"curvature_change", 1, one(nodes, [&](auto v) { return now[v] - rest[v]; })}};
    frame.arrays.cells = {{"label", 1, std::vector<double>(active.drawn.size(), label)},
                          {"level", 1, {active.drawn_level.begin(), active.drawn_level.end()}}};
    frame.arrays.time = view.moment.time;
    Box box;
    for (const Vec3& p : frame.surface.points) box.include(p);
    for (std::size_t t = 0; t < view.body.loads.tools.size(); ++t) {
        const Tool& tool = view.body.loads.tools[t];
        const Vec3& at = view.moment.tools[t].place;
        // The plane's part beside the organ, wherever its point is.
        const Vec3 middle = box.centre() + tool.normal * tool.normal.dot(at - box.centre());
        frame.tools.push_back(tool.shape == Tool::Shape::sphere
                                  ? ball(at, tool.radius)
                                  : square(middle, tool.normal, 0.5 * box.diagonal()));
    }
    return frame;
}

PressView view_of(const membrane::Loads& loads) {
    Vec3 way = Vec3::Zero();
    if (!loads.tools.empty()) {
        const Tool& tool = loads.tools.front();
        way = tool.shape == Tool::Shape::plane ? tool.normal : tool.way;
        if (tool.forces.empty() && tool.shape == Tool::Shape::sphere)
            for (double farthest = 0; const membrane::ToolPlace& place : tool.places) {
                const Vec3 gone = place.position - tool.places.front().position;
                if (gone.norm() > farthest) way = gone;
                farthest = std::max(farthest, gone.norm());
            }
    } else if (!loads.patches.empty()) {
        way = loads.patches.front().force;
    }
    PressView view;
    if (!(way.norm() > 0)) return view;
    way.normalize();
    Vec3 side = way.cross(up_for(way));
    side.normalize();
    constexpr double kAside = 0.5, kAbove = 0.35;
    view.beside = side;
    view.behind = (way + kAside * side - kAbove * up_for(way)).normalized();
    return view;
}

report::Picture frame_picture(const PressFrame& frame, const PressView& view) {
    const double time = frame.arrays.time.value_or(0);
    const auto organ = with_edges(frame, view);
    std::vector<report::Shape> shapes{organ[0], organ[1]};
    for (const TriMesh& tool : frame.tools) shapes.push_back({.surface = tool, .colour = kSteel});
    const report::Picture beside =
        draw_from(shapes, view, view.beside, formatted("from the side, t = %.3f s", time));
    const report::Picture both[] = {
        beside, draw_from(organ, view, view.behind, formatted("as pressed, t = %.3f s", time))};
    return report::tile(both, 2);
}

}  // namespace myotet::app
