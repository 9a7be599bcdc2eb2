// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Contraction/Measure.h"

namespace myotet::contraction {

/// What a run came to that writes nothing.
struct Trial {
    bool completed = false;
    bool interrupted = false;
    std::string message;  ///< why it did not reach the end
    History history;      ///< a row a step of the scene, as history.csv has it
};

/// Runs a scene from rest to its end. The same model may be run again, with other
/// activations in the scene: nothing is left of the run before.
[[nodiscard]] Trial try_scene(const Scene& scene, Model& model, const SolveOptions& options,
                              const ProgressSink& progress);

}  // namespace myotet::contraction
