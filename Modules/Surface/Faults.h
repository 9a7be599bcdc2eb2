// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Core/TetMesh.h"
#include "Surface/Field.h"

namespace myotet::surface {

/// Where a mesh that may be anything near phi = 0 cannot hold on to it: points that
/// do not come to rest on phi = 0, and triangles that cross. Both come of necks and
/// slits so thin that samples and what lies between them disagree on whether they
/// are there. With a mesh beside it, triangles that cross that count, too. Of `guide`
/// the trim means nothing. Local coordinates, mm; in no order that means anything, but the same
/// on any number of threads.
[[nodiscard]] std::vector<Vec3> start_faults(const TriMesh& start, const Guide& guide,
                                             double reach);

/// Where a finished mesh breaks a promise or falls short (see Measure): centres of
/// triangles that are turned over, cross, or have an angle that is not as asked,
/// and points off phi = 0. Not at its boundary and beside it: what is wrong there
/// is between phi and the surface that trims it.
[[nodiscard]] std::vector<Vec3> faults(const TriMesh& mesh, const Guide& guide);

}  // namespace myotet::surface
