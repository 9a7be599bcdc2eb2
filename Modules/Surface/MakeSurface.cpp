// SPDX-License-Identifier: Apache-2.0
#include "Surface/MakeSurface.h"

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "Surface/Improve.h"
#include "Surface/TurnBack.h"

namespace myotet::surface {
namespace {

constexpr int kRounds = 10;       // of remeshing before the cut
constexpr int kRimRounds = 5;     // after it
constexpr double kFinest = 0.25;  // of the edge length, unless said

void require(bool holds, const char* field, double value, const char* rule) {
    if (!holds)
        throw InputError(std::string("surface option ") + field + " is " + std::to_string(value) +
                         "; it must be " + rule);
}

void require_closed(const TriMesh& start) {
    if (start.triangles.empty())
        throw InputError("the surface to begin with has no triangles; a closed one is needed");
    const Guide nowhere{.phi = [](const Vec3&) { return FieldSample{}; }};
    const Quality q = measure(start, nowhere);
    if (q.bad_edges + q.bad_points + q.boundary_points > 0)
        throw InputError("the surface to begin with has " + std::to_string(q.bad_edges) +
                         " bad edges, " + std::to_string(q.bad_points) + " bad points and " +
                         std::to_string(q.boundary_points) +
                         " points on a boundary; a closed manifold is needed");
}

}  // namespace

void Options::validate() const {
    require(edge_length > 0 && std::isfinite(edge_length), "edge_length", edge_length, "positive");
    require(smallest_edge_length >= 0 && smallest_edge_length <= edge_length,
            "smallest_edge_length", smallest_edge_length, "between 0 and edge_length");
    require(curvature_factor > 0, "curvature_factor", curvature_factor, "positive");
    require(pieces >= 0, "pieces", pieces, "at least 0");
}

Result make_surface(const TriMesh& start, const Guide& guide, const Options& options,
                    ProgressSink& progress) {
    options.validate();
    require_closed(start);
    const Sizing sizing{.edge_length = options.edge_length,
                        .smallest_length = options.smallest_edge_length > 0
                                               ? options.smallest_edge_length
                                               : kFinest * options.edge_length,
                        .curvature_factor = options.curvature_factor};
    Fans fans = make_fans(start);
    std::ranges::fill(fans.sizes, options.edge_length);
    CrossingGuard guard(fans, guide.beside.mesh);
    guard.run([&] { place_all(fans, guide); });
    remesh(fans, guide, guard, sizing, kRounds);
    progress.check();

    Result result;
    if (guide.trim) result.cut = select_outside(fans, guide);
    if (result.cut == Cut::everything) return result;
    if (result.cut == Cut::some) {
        keep_largest_pieces(fans, options.pieces);
        guard.run([&] { drive_rim(fans, guide); });
        remesh(fans, guide, guard, sizing, kRimRounds);
        progress.check();
    }
    improve_angles(fans, guide, guard);
    turn_back(fans, guide, guard);
    if (result.cut == Cut::some) guard.run([&] { land_rim(fans, guide); });
    result.mesh = to_mesh(fans);
    result.quality = measure(result.mesh, guide);
    return result;
}

}  // namespace myotet::surface
