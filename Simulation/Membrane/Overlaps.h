// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "Core/TetMesh.h"

namespace myotet::membrane {

/// Two triangles that lie in one plane, but for rounding, and cover a part of it both,
/// such as two that share an edge and are folded flat onto each other; nothing when
/// there are none. Triangles must have areas. Cost: O(|F| log |F|), and pairs that
/// overlap along x.
[[nodiscard]] std::optional<std::array<std::int32_t, 2>> overlap_in_plane(const TriMesh& surface);

}  // namespace myotet::membrane
