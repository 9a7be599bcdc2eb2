// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "LevelSet/LevelSet.h"

namespace myotet::contraction {

/// A signed distance with two derivatives, in the frame of the patient.
struct FieldSample {
    double value = 0;               ///< mm, negative inside
    Vec3 gradient = Vec3::Zero();   ///< of length about 1
    Mat3 curvature = Mat3::Zero();  ///< second derivative, 1/mm
};

/// The shape of a bone or a body at rest, as contact feels it: its level set made smooth.
///
/// Interpolated trilinearly, a level set has kinks from cell to cell, in which a node that
/// is pressed on would catch, and forces would never balance. Here its fine samples phi_i
/// are the coefficients of quadratic B-splines,
///   d(X) = sum_i phi_i B((X - X_i) / h),
/// which has a continuous gradient everywhere: in the band, in the far field deep inside,
/// and outside the box. Planes stay what they are; a surface of principal curvatures k1, k2
/// is found h^2 (k1 + k2) / 8 too far in where it is convex: 0.006 mm for a ball of radius
/// 10 mm sampled at 0.5 mm.
struct ContactField {
    std::shared_ptr<const levelset::LevelSet> phi;
    Frame frame;  ///< of the level set's local coordinates

    /// At a point of the patient at rest, mm. Cost: 27 samples, about 0.5 us.
    [[nodiscard]] FieldSample sample(const Vec3& point) const;
    /// The same where the value is less than `bound`, nothing elsewhere. Cost where it is
    /// well above: one sample.
    [[nodiscard]] std::optional<FieldSample> sample_below(double bound, const Vec3& point) const;
};

}  // namespace myotet::contraction
