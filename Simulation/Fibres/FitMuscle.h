// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "Fibres/BSplineSolid.h"

namespace myotet::fibres {

struct MuscleFitOptions {
    SolidShape shape;
    /// Of fit_samples: enough to carry the control points over what the sections leave
    /// open, and to smooth the facets of the mesh.
    double smoothing = 1e-3;
    /// Signed distance to the muscle's surface, mm, negative inside, or any function with
    /// its zero set there that is smooth near it. If given, the sections' outlines, which
    /// lie on the mesh, are moved to it, and distances are measured from it. Called from
    /// several threads at once.
    std::function<double(const Vec3&)> level_set;
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

struct MuscleFit {
    BSplineSolid solid;
    /// Of points all over the solid's boundary from the muscle's surface, mm: the level
    /// set's if there is one, else the mesh's.
    double mean_distance = 0, max_distance = 0;
    /// Of the mesh's surface nodes from the solid, mm, 0 for those inside: what it misses.
    double mean_uncovered = 0, max_uncovered = 0;
    /// Share of places inside at which dX/du, dX/dv, dX/dw are not right-handed: folds.
    double folded = 0;
    std::vector<std::string> notes;
};

/// Fits a B-spline solid to a muscle between its attachments, after [Ng97, Ng02]:
/// cross-sections at about equal distances, where the surfaces of equal laplace_potential
/// meet the muscle's surface; their outlines correspond by length along them, without a
/// twist from one to the next; each is the boundary of the square (u, v), the inside of
/// which a Coons patch fills; fit_samples through them all.
/// A muscle of several heads keeps the longest outline of each section; a note says where.
/// Errors as laplace_potential and fit_samples; MeshError when the surface has no closed
/// section. Ends that belong to an attachment as a whole, as where a tendon is sunk in, lie
/// beyond the solid. Cost: 1 to 2 s for 50 000 tetrahedra, most of it the distances.
[[nodiscard]] MuscleFit fit_muscle(const TetMesh& mesh, std::span<const std::int32_t> origin_nodes,
                                   std::span<const std::int32_t> insertion_nodes,
                                   const MuscleFitOptions& options = {});

}  // namespace myotet::fibres
