// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "Membrane/Simulate.h"
#include "Report/Chart.h"
#include "Report/Draw.h"

namespace myotet::benchmarks {

/// Where MYOTET_PLOTS=FOLDER asks for plots.
inline std::optional<std::filesystem::path> plots_folder() {
    const char* folder = std::getenv("MYOTET_PLOTS");
    if (!folder || !*folder) return std::nullopt;
    return folder;
}

/// A surface as drawn at a moment, and how far its corners have gone.
struct Snapshot {
    TriMesh surface;
    std::vector<double> gone;  ///< a triangle: mean over its corners, mm
};

inline Snapshot snapshot_of(const membrane::View& view) {
    Snapshot shot{{view.motion.x, view.body.active.drawn}, {}};
    for (const Triangle& t : shot.surface.triangles) {
        double sum = 0;
        for (const std::int32_t v : t)
            sum += (view.motion.x[v] - view.body.levels.rest[v]).norm() / 3;
        shot.gone.push_back(sum);
    }
    return shot;
}

struct Named {
    std::string name;
    Snapshot shot;
};

/// Snapshots beside one another, coloured by how far they have gone.
inline void draw_snapshots(const std::vector<Named>& shots, const Vec3& direction,
                           const std::string& file) {
    const auto folder = plots_folder();
    if (!folder) return;
    Box fit;
    double most = 0;
    for (const Named& named : shots)
        for (std::size_t f = 0; f < named.shot.gone.size(); ++f) {
            for (const std::int32_t v : named.shot.surface.triangles[f])
                fit.include(named.shot.surface.points[v]);
            most = std::max(most, named.shot.gone[f]);
        }
    std::vector<report::Picture> pictures;
    for (const Named& named : shots) {
        // Triangles a little smaller than they are, on dark ones: so their edges show.
        constexpr double kInside = 0.88;
        const TriMesh& surface = named.shot.surface;
        report::Shape inside{.surface = {}, .values = named.shot.gone},
            edges{.surface = surface, .colour = {0.25, 0.25, 0.3}};
        for (const auto& [a, b, c] : surface.triangles) {
            const Vec3 &x = surface.points[a], &y = surface.points[b], &z = surface.points[c];
            const Vec3 centre = (x + y + z) / 3,
                       up = 1e-3 * fit.diagonal() * (y - x).cross(z - x).normalized();
            const auto first = static_cast<std::int32_t>(inside.surface.points.size());
            for (const Vec3& p : {x, y, z})
                inside.surface.points.push_back(centre + kInside * (p - centre) + up);
            inside.surface.triangles.push_back({first, first + 1, first + 2});
        }
        const report::Shape shapes[] = {edges, inside};
        pictures.push_back(report::draw(shapes, {.direction = direction,
                                                 .width = 300,
                                                 .height = 330,
                                                 .most = std::max(most, 1e-3),
                                                 .values_name = "displacement, mm",
                                                 .title = named.name,
                                                 .fit = fit}));
    }
    report::write_png(report::tile(pictures, static_cast<int>(pictures.size())), *folder / file);
}

/// Displacement of the first patch over time.
inline report::Line line_of(const std::string& name, const membrane::Result& result,
                            report::LineStyle style = report::LineStyle::solid) {
    report::Line line{.name = name, .style = style};
    for (const membrane::Moment& m : result.history) {
        line.x.push_back(m.time);
        line.y.push_back(m.patch_displacement[0]);
    }
    return line;
}

inline void draw_lines(const std::string& title, const std::vector<report::Panel>& panels,
                       const std::string& file) {
    const auto folder = plots_folder();
    if (!folder) return;
    report::write_png(report::draw_chart({.title = title,
                                          .x_label = "time, s",
                                          .panels = panels,
                                          .columns = static_cast<int>(panels.size())},
                                         {.panel_width = 440, .panel_height = 280}),
                      *folder / file);
}

}  // namespace myotet::benchmarks
