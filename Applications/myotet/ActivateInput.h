// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "ActivateJob.h"

namespace myotet::app {

/// A model and its motion, read and checked.
struct ActivateInput {
    skeleton::Model model;  ///< without disabled muscles
    skeleton::Trajectory trajectory;
    std::vector<double> times;  ///< s
    activation::SharingOptions sharing;
    std::vector<std::string> warnings, notes;
};

/// Throws IoError, InputError and UsageError.
[[nodiscard]] ActivateInput read_activate_input(const ActivateJobOptions& options);

}  // namespace myotet::app
