// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Dynamics/ForceField.h"

namespace myotet::dynamics {

// Sums in a fixed order: same bytes on any number of threads.

[[nodiscard]] double dot(const NodeVectors& a, const NodeVectors& b);
/// to += s a
void add_scaled(double s, const NodeVectors& a, NodeVectors& to);

}  // namespace myotet::dynamics
