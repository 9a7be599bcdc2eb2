// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Geometry.h"

namespace myotet::elasticity {

/// Derivative of the stress P by the deformation gradient F, MPa: entry
/// (i + 3 j, k + 3 l) is dP_ij / dF_kl, both matrices being taken column by column.
/// Symmetric where P comes from an energy.
using Tangent = Eigen::Matrix<double, 9, 9>;

/// The nearest tangent without negative curvature: negative eigenvalues become zero.
/// A minimisation that uses it always goes downhill [Teran, Sifakis, Irving,
/// Fedkiw 2005, Robust quasistatic finite elements and flesh simulation].
[[nodiscard]] Tangent convex_part(const Tangent& tangent);

}  // namespace myotet::elasticity
