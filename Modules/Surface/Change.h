// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Surface/Facing.h"

namespace myotet::surface {

/// Changes of a mesh on its level sets that turn no triangle over. Each says
/// whether it was made; where not, the mesh is as it was.

/// Puts point v to where its level sets are zero next to `at`.
bool place(Fans& fans, const Guide& guide, std::int32_t v, const Vec3& at);

/// Places all points where they are; those that may not move keep their places.
void place_all(Fans& fans, const Guide& guide);

/// Moves all points to `wanted`, in their order, each where that turns nothing over.
void move_all(Fans& fans, const Field& phi, const std::vector<std::optional<Corner>>& wanted);

/// Puts a point in the middle of an edge and onto its level sets, where both
/// halves are shorter than the edge: so splitting ends.
bool split_in_middle(Fans& fans, const Guide& guide, std::int32_t a, std::int32_t b);

/// Whether the triangles that may_flip's edge would make face outward, or at
/// least as many as do now.
[[nodiscard]] bool flip_faces_outward(const Fans& fans, const Field& phi, std::int32_t a,
                                      std::int32_t b, const EdgeStar& star);

/// Whether at least as many triangles face outward with all that are around a
/// and b around b at `at`, and those that would go gone.
[[nodiscard]] bool collapse_faces_outward(const Fans& fans, const Field& phi, std::int32_t a,
                                          std::int32_t b, const Corner& at);

/// Where an edge's ends go when it is collapsed onto b: half way, but to b when
/// b is on the rim and a is not.
[[nodiscard]] std::optional<Corner> meeting_point(const Fans& fans, const Guide& guide,
                                                  std::int32_t a, std::int32_t b);

}  // namespace myotet::surface
