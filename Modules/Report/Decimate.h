// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "Core/TetMesh.h"

namespace myotet::report {

/// A surface of about as many triangles as asked, to be looked at from afar: points within a
/// cell of a grid become the one that lies best on their triangles' planes [Lindstrom00]. A
/// surface that has no more is returned as it is. Holes may close and thin parts join. O(|F|).
[[nodiscard]] TriMesh decimated(const TriMesh& surface, std::size_t triangles);

}  // namespace myotet::report
