// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/Geometry.h"

namespace myotet::elasticity {

/// Derivative of the stress P by the deformation gradient F, MPa: entry
/// (i + 3 j, k + 3 l) is dP_ij / dF_kl, both matrices being taken column by column.
/// Symmetric where P comes from an energy.
using Tangent = Eigen::Matrix<double, 9, 9>;

}  // namespace myotet::elasticity
