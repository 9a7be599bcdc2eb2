// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "Contraction/FrameFiles.h"

namespace myotet::contraction {

/// How a scene is run and what is kept of it.
struct RunOptions {
    std::filesystem::path folder;      ///< of the results; made when it is not there
    bool resume = false;               ///< from the folder's checkpoint
    int checkpoint_every = 10;         ///< steps of the scene; the first one is made at 0 s
    Series series = Series::by_count;  ///< what frames become
    SolveOptions solve;
    /// Called with each frame that was written, the bones there and then, and its number
    /// from 0; frames before a checkpoint are not told again. Empty: nobody is told.
    std::function<void(const Moment&, std::span<const TriMesh> bones, std::size_t number)> watch;
};

/// What a run came to.
struct RunSummary {
    bool completed = false;
    bool interrupted = false;
    bool resumable = false;  ///< a checkpoint is there to go on from
    std::string message;
    double reached = 0;       ///< s
    double resumed_from = 0;  ///< s; 0: from the start
    int steps = 0, failed_steps = 0, iterations = 0, linear_iterations = 0, factors = 0;
    double residual = 0;     ///< the largest of an accepted step
    std::size_t frames = 0;  ///< that there are, those before the checkpoint too
    History history;
    std::vector<Architecture> architecture;    ///< a body
    std::vector<std::filesystem::path> files;  ///< relative to the folder
};

/// Runs a scene and writes, as it goes,
///   frames/frame_0000.vtu, ...  the bodies at output times, see make_frame
///   bones/NAME_0000.vtp, ...    the bones there and then
///   contraction.pvd             all of them, for ParaView; or, of many frames, instead of these
///   contraction.h5, .xdmf       the same in one file and its description, see FrameFiles
///   history.csv                 a row a step of the scene
///   checkpoint.myotet           where to go on from
/// A run that finds no equilibrium stops, keeps what it has and can go on from the last
/// checkpoint. One that is interrupted gives up the step it is in, within an iteration of
/// Newton's method, and makes a checkpoint of where that began. A run that goes on writes
/// the same bytes as one that was never interrupted, on any number of threads. One that
/// begins anew first takes away what a run before it wrote.
/// Throws IoError, InputError when there is no checkpoint, or one of another scene.
[[nodiscard]] RunSummary run_scene(const Scene& scene, Model& model, std::span<const TriMesh> bones,
                                   const RunOptions& options, ProgressSink& progress);

/// Names of what run_scene writes.
inline constexpr const char* kHistoryFile = "history.csv";
inline constexpr const char* kCheckpointFile = "checkpoint.myotet";

}  // namespace myotet::contraction
