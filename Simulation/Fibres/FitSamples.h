// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Fibres/BSplineSolid.h"

namespace myotet::fibres {

/// A point that a solid should have at a place.
struct SolidSample {
    Vec3 uvw = Vec3::Zero();    ///< in [0, 1]^3
    Vec3 point = Vec3::Zero();  ///< mm
    double weight = 1;
};

/// The solid that makes
///   sum of weight |X(uvw) - point|^2 + smoothing m sum of |second differences of P|^2
/// least, m being the mean diagonal of the first sum's matrix. The differences along u, v
/// and w are divided by the distances of the Greville parameters, so that a straight
/// block costs nothing [Eilers96].
/// Throws InputError when the shape is not valid, smoothing is negative, a sample is not
/// finite, lies outside the cube or has a negative weight, and when the samples do not
/// determine the control points.
/// Cost: 0.2 s for 12 000 samples and 576 control points.
[[nodiscard]] BSplineSolid fit_samples(std::span<const SolidSample> samples,
                                       const SolidShape& shape, double smoothing);

}  // namespace myotet::fibres
