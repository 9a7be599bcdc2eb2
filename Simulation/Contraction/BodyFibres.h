// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Contraction/Attach.h"

namespace myotet::contraction {

/// Fibres of a body's tetrahedra from the source that the scene names, |T| unit vectors, or
/// none. What they say about themselves is added to `notes`. Throws InputError at the
/// body's line, as when an origin or an insertion is missing.
[[nodiscard]] std::vector<Vec3> find_fibres(const Scene& scene, const Body& body,
                                            const TetMesh& mesh, std::span<const HeldNodes> held,
                                            std::vector<std::string>& notes);

}  // namespace myotet::contraction
