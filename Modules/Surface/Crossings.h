// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "Core/TetMesh.h"

namespace myotet::surface {

/// A triangle by its points' numbers and places.
struct Placed {
    Triangle points{};
    std::array<Vec3, 3> at;
};

/// Whether an edge of one passes through the inside of the other; ends that are
/// corners of the other do not count, nor do triangles that share two points.
[[nodiscard]] bool cross(const Placed& a, const Placed& b);

/// Pairs of triangles that cross, the smaller number first, in ascending order;
/// removed ones, {-1, -1, -1}, are left out. Cost: O(|F|) where triangles are of
/// similar size.
[[nodiscard]] std::vector<std::array<std::int32_t, 2>> crossings(
    std::span<const Vec3> points, std::span<const Triangle> triangles);

/// Adds a part's points and triangles, numbered on, to the whole.
void append(TriMesh& whole, const TriMesh& part);

/// One mesh after the other; points and triangles of the second are numbered on.
[[nodiscard]] TriMesh joined(std::span<const Vec3> points, std::span<const Triangle> triangles,
                             const TriMesh& beside);

/// The same of a mesh with itself and with one beside it, by their numbers in
/// `joined`; pairs within the second are left out.
[[nodiscard]] std::vector<std::array<std::int32_t, 2>> crossings(
    std::span<const Vec3> points, std::span<const Triangle> triangles, const TriMesh& beside);

}  // namespace myotet::surface
