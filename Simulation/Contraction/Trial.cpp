// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Trial.h"

#include <cmath>

namespace myotet::contraction {

Trial try_scene(const Scene& scene, Model& model, const SolveOptions& options,
                const ProgressSink& progress) {
    SolveOptions solve = options;
    solve.equilibrium.stop = [&progress] { return progress.interrupted(); };
    Simulation simulation(scene, model, solve);
    Trial trial;
    trial.history.columns = history_columns(scene, model);
    const int steps = scene_steps(scene.time);
    StepSummary step = simulation.begin();
    for (int i = 0; step.converged; ++i) {
        trial.history.rows.push_back(history_row(scene, model, simulation, step.iterations));
        trial.completed = i == steps;
        if (trial.completed) break;
        step = simulation.advance(scene_time(scene.time, i + 1));
    }
    trial.interrupted = step.stopped;
    trial.message = step.message;
    return trial;
}

}  // namespace myotet::contraction
