// SPDX-License-Identifier: Apache-2.0
#include "Fibres/FitMuscle.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Fibres/CentralLine.h"
#include "Fibres/FitSamples.h"
#include "Fibres/Laplace.h"
#include "Fibres/Sections.h"
#include "Fibres/SurfaceDistance.h"

namespace myotet::fibres {
namespace {

// Sections a control point along w: enough that the facets of a mesh average out.
constexpr int kSectionsPerControl = 3;
// Samples a control point along u and v.
constexpr int kSamplesPerControl = 3;
// The ends themselves have no section: the first and last lie by this share of the length
// before them, closer than any solid fits.
constexpr double kEnd = 1e-3;
// Parts of the muscle whose centroids make the central line.
constexpr int kParts = 40;
// Points on the surface weigh more than those that a Coons patch guesses.
constexpr double kInsideWeight = 0.1;
// Steps to the level set and, of the box's diagonal, the differences that take them.
constexpr int kSteps = 3;
constexpr double kDifference = 1e-5;
// Points an edge of the grid on each of the boundary's faces, and of that of folds.
constexpr int kFacePoints = 40, kFoldPoints = 12;

double diagonal_of(const TetMesh& mesh) {
    Box box;
    for (const Vec3& p : mesh.points) box.include(p);
    return box.diagonal();
}

std::vector<Section> make_sections(const TetMesh& mesh, std::span<const double> potential,
                                   int count) {
    const CentralLine line = central_line(mesh, potential, kParts);
    const std::vector<Triangle> faces = boundary_faces(mesh.tets);
    std::vector<Section> sections;
    for (int k = 0; k < count; ++k) {
        const double along = kEnd + (1 - 2 * kEnd) * k / (count - 1);
        Section section =
            section_at(mesh, faces, potential, line.potential_at(along * line.length.back()));
        if (!section.normal.isZero(0)) sections.push_back(std::move(section));
    }
    if (sections.size() < 2)
        throw MeshError(
            "no closed line around the muscle lies between origin and insertion; check that the "
            "two sets of nodes do not cover its whole surface");
    // From the middle, which has the clearest shape, to both ends.
    const std::size_t middle = sections.size() / 2;
    begin_at_long_axis(sections[middle]);
    for (std::size_t k = middle + 1; k < sections.size(); ++k) align(sections[k - 1], sections[k]);
    for (std::size_t k = middle; k-- > 0;) align(sections[k + 1], sections[k]);
    return sections;
}

/// Newton's steps x - phi grad phi / |grad phi|^2.
void move_to_level_set(const std::function<double(const Vec3&)>& phi, double step,
                       std::vector<Vec3>& points) {
    parallel_for(0, points.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
            for (int k = 0; k < kSteps; ++k) {
                Vec3 gradient;
                for (int a = 0; a < 3; ++a) {
                    const Vec3 by = step * Vec3::Unit(a);
                    gradient[a] = (phi(points[n] + by) - phi(points[n] - by)) / (2 * step);
                }
                const double square = gradient.squaredNorm();
                if (!(square > 0)) break;
                points[n] -= phi(points[n]) / square * gradient;
            }
    });
}

/// The loop as the boundary of the square, counter-clockwise, a quarter of it each side;
/// its first point in the middle of the side u = 1.
Vec3 on_square(const std::vector<Vec3>& loop, double u, double v) {
    double sides = 0;  // from the corner (0, 0)
    if (v <= 0)
        sides = u;
    else if (u >= 1)
        sides = 1 + v;
    else if (v >= 1)
        sides = 3 - u;
    else
        sides = 4 - v;
    const double place = std::fmod(sides + 2.5, 4.0) / 4 * kLoopPoints;
    const auto i = static_cast<std::size_t>(place) % kLoopPoints;
    const double share = place - std::floor(place);
    return (1 - share) * loop[i] + share * loop[(i + 1) % kLoopPoints];
}

/// Bilinearly blended patch of four curves [Coons67]; on the boundary, the curves.
Vec3 coons(const std::vector<Vec3>& loop, double u, double v) {
    const auto at = [&](double a, double b) { return on_square(loop, a, b); };
    return (1 - v) * at(u, 0) + v * at(u, 1) + (1 - u) * at(0, v) + u * at(1, v) -
           (1 - u) * (1 - v) * at(0, 0) - u * (1 - v) * at(1, 0) - (1 - u) * v * at(0, 1) -
           u * v * at(1, 1);
}

std::vector<SolidSample> make_samples(const std::vector<Section>& sections,
                                      const SolidShape& shape) {
    std::vector<double> along(sections.size(), 0.0);
    for (std::size_t k = 1; k < sections.size(); ++k)
        along[k] = along[k - 1] + (sections[k].centre - sections[k - 1].centre).norm();
    const int nu = kSamplesPerControl * shape.count[0], nv = kSamplesPerControl * shape.count[1];
    std::vector<SolidSample> samples;
    for (std::size_t k = 0; k < sections.size(); ++k) {
        const double w = kEnd + (1 - 2 * kEnd) * along[k] / along.back();
        for (int j = 0; j <= nv; ++j)
            for (int i = 0; i <= nu; ++i) {
                const Vec3 uvw(static_cast<double>(i) / nu, static_cast<double>(j) / nv, w);
                const bool outline = i == 0 || j == 0 || i == nu || j == nv;
                samples.push_back(
                    {uvw, coons(sections[k].loop, uvw[0], uvw[1]), outline ? 1.0 : kInsideWeight});
            }
    }
    return samples;
}

std::vector<Vec3> boundary_points(const BSplineSolid& solid) {
    std::vector<Vec3> points;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {0.0, 1.0})
            for (int i = 0; i < kFacePoints; ++i)
                for (int j = 0; j < kFacePoints; ++j) {
                    Vec3 uvw;
                    uvw[axis] = side;
                    uvw[(axis + 1) % 3] = (i + 0.5) / kFacePoints;
                    uvw[(axis + 2) % 3] = (j + 0.5) / kFacePoints;
                    points.push_back(evaluate(solid, uvw).position);
                }
    return points;
}

void measure_distances(const TetMesh& mesh, const std::function<double(const Vec3&)>& phi,
                       MuscleFit& fit) {
    const std::vector<Vec3> points = boundary_points(fit.solid);
    const TriMesh surface = boundary_surface(mesh);
    std::vector<double> distance(points.size());
    if (phi)
        parallel_for(0, points.size(), 64, [&](std::size_t first, std::size_t last) {
            for (std::size_t n = first; n < last; ++n) distance[n] = std::abs(phi(points[n]));
        });
    else
        distance = surface_distances(points, surface);
    for (const double d : distance) {
        fit.mean_distance += d / static_cast<double>(distance.size());
        fit.max_distance = std::max(fit.max_distance, d);
    }
    const SolidLocator locator(fit.solid);
    std::vector<double> missed(surface.points.size());
    parallel_for(0, missed.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
            missed[n] = locator.find(surface.points[n]).distance;
    });
    for (const double d : missed) {
        fit.mean_uncovered += d / static_cast<double>(missed.size());
        fit.max_uncovered = std::max(fit.max_uncovered, d);
    }
}

double folded_share(const BSplineSolid& solid) {
    int folded = 0;
    for (int k = 0; k < kFoldPoints; ++k)
        for (int j = 0; j < kFoldPoints; ++j)
            for (int i = 0; i < kFoldPoints; ++i) {
                const Vec3 uvw = (Vec3(i, j, k).array() + 0.5) / kFoldPoints;
                if (!(evaluate(solid, uvw).derivative.determinant() > 0)) ++folded;
            }
    return folded / std::pow(kFoldPoints, 3);
}

}  // namespace

void MuscleFitOptions::validate() const {
    shape.validate();
    if (!(smoothing > 0))
        throw InputError("smoothing of the muscle's fit is " + std::to_string(smoothing) +
                         ", but it must be positive");
}

MuscleFit fit_muscle(const TetMesh& mesh, std::span<const std::int32_t> origin_nodes,
                     std::span<const std::int32_t> insertion_nodes,
                     const MuscleFitOptions& options) {
    options.validate();
    const std::vector<double> potential = laplace_potential(mesh, origin_nodes, insertion_nodes);
    std::vector<Section> sections =
        make_sections(mesh, potential, kSectionsPerControl * options.shape.count[2]);
    MuscleFit fit;
    const auto split = std::count_if(sections.begin(), sections.end(),
                                     [](const Section& s) { return s.left_out > 0; });
    if (split > 0)
        fit.notes.push_back(std::to_string(split) + " of " + std::to_string(sections.size()) +
                            " cross-sections have several outlines, of which the B-spline solid "
                            "follows the longest");
    if (options.level_set)
        for (Section& section : sections)
            move_to_level_set(options.level_set, kDifference * diagonal_of(mesh), section.loop);
    fit.solid =
        fit_samples(make_samples(sections, options.shape), options.shape, options.smoothing);
    measure_distances(mesh, options.level_set, fit);
    fit.folded = folded_share(fit.solid);
    if (fit.folded > 0)
        fit.notes.push_back("the B-spline solid is folded in " + std::to_string(100 * fit.folded) +
                            " % of its places; its cross-section bends too much for it");
    return fit;
}

}  // namespace myotet::fibres
