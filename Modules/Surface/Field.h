// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>

#include "Core/TetMesh.h"

namespace myotet::surface {

/// A signed distance at a point.
struct FieldSample {
    double value = 0;              ///< mm, negative inside
    Vec3 gradient = Vec3::Zero();  ///< dimensionless, about 1 long
};

/// A level set as this room sees it: a function of position (mm) that may be
/// called from several threads at once.
using Field = std::function<FieldSample(const Vec3&)>;

/// The half-space behind the plane through `on`; `outward` points out of it.
[[nodiscard]] Field half_space(const Vec3& on, const Vec3& outward);

/// The solid grown by `distance` (mm; negative shrinks it).
[[nodiscard]] Field offset(Field field, double distance);

/// Other parts of a solid, next to the one that a mesh is made of.
struct Beside {
    Field phi;     ///< of all of them; empty: there are none
    TriMesh mesh;  ///< their surfaces as they are now
};

/// What holds a mesh.
struct Guide {
    Field phi;      ///< every point stays on its zero set
    Field trim;     ///< points of the rim stay on its zero set too; empty: none
    Beside beside;  ///< no triangle crosses one of its mesh
};

/// Near `from` the point of phi = 0 that steps along the gradient, each about
/// |phi| long, come to: no step passes a part of the surface unseen. Nothing
/// where that is farther than twice `reach` (mm), or does not end within 1e-4
/// of it.
[[nodiscard]] std::optional<Vec3> project(const Field& phi, const Vec3& from, double reach);

/// The same onto phi = 0 and psi = 0 at once: each step is the shortest one
/// that solves both linearised equations, x += J^T (J J^T)^-1 (-phi, -psi) with
/// J the two gradients as rows. Where they are parallel a step keeps phi = 0 only.
[[nodiscard]] std::optional<Vec3> project(const Field& phi, const Field& psi, const Vec3& from,
                                          double reach);

/// Largest |principal curvature| (1/mm) of the isosurface through `point`, by
/// central differences of the unit normal over `step` mm in the tangent plane;
/// at most about 1 / step.
[[nodiscard]] double largest_curvature(const Field& phi, const Vec3& point, double step);

/// Distance from a point of phi = 0 along its normal to the next one, the nearer
/// of the way through the solid and of the gap outside, mm; at most `limit`.
[[nodiscard]] double thickness(const Field& phi, const Vec3& point, double limit);

}  // namespace myotet::surface
