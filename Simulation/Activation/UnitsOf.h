// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "Muscle/ActivationDynamics.h"
#include "Muscle/MuscleTendon.h"
#include "Skeleton/Model.h"

namespace myotet::activation {

/// A muscle of a skeleton as a unit that pulls.
struct SkeletonUnit {
    muscle::MuscleTendon unit;
    muscle::ActivationDynamics dynamics;
    bool rigid_tendon = false;
    std::string note;  ///< a sentence when something of its kind is not taken into account
};

/// By its type: Thelen2003Muscle has Thelen's curves, the Millard2012 muscles have Millard's,
/// with the numbers of the file where it has them; any other type has generic curves, and a
/// note. A rigid tendon or damping lets the least of Millard's active curve be nothing, as in
/// OpenSim. Throws InputError "muscle NAME: ..." when a number breaks its rule.
/// `form` is that of Thelen's passive curve.
[[nodiscard]] SkeletonUnit unit_of(
    const skeleton::Muscle& muscle,
    muscle::ThelenPassive form = muscle::ThelenPassive::from_optimum);
[[nodiscard]] std::vector<SkeletonUnit> units_of(
    const skeleton::Model& model, muscle::ThelenPassive form = muscle::ThelenPassive::from_optimum);

}  // namespace myotet::activation
