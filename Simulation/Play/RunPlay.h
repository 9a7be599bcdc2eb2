// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "Contraction/TimeSeries.h"
#include "Core/Progress.h"
#include "Play/PlayScene.h"
#include "Play/Stepper.h"

namespace myotet::play {

/// A moment that is shown.
struct PlayFrame {
    std::size_t number = 0;  ///< from 0
    double time = 0;         ///< s
    const World& world;
    const State& state;
    const std::vector<TriMesh>& details;  ///< a body's detail, or its own surface
};

struct RunPlayOptions {
    std::filesystem::path folder;  ///< of the results; made when it is not there
    StepOptions step;
    /// Called with each frame that was written. Empty: nobody is told.
    std::function<void(const PlayFrame&)> watch;
};

/// What a played scene came to. Times are of the steps and of moving what is embedded, without
/// measuring, writing and drawing.
struct PlaySummary {
    bool completed = false, interrupted = false;
    std::string message;
    int steps = 0;
    int unsettled_steps = 0;  ///< in which iterations ended before the tolerance was met
    int iterations = 0, linear_iterations = 0;
    double reached = 0;                ///< s
    double seconds = 0;                ///< by the clock on the wall
    double processor_seconds = 0;      ///< of all threads
    double worst_frame = 0;            ///< longest step by the clock on the wall, s
    double worst_processor = 0;        ///< longest step in processor time, s
    double deepest = 0;                ///< a sample of one thing in another, after any step, mm
    double smallest_volume_ratio = 1;  ///< of any tetrahedron after any step, det F
    std::size_t inverted = 0;          ///< tetrahedra of no positive volume, summed over steps
    Energies first, last;
    double greatest_gain = 0;  ///< of the total energy in a step, mJ; 0: it never rose
    std::size_t frames = 0;
    contraction::History history;
    std::vector<std::filesystem::path> files;  ///< relative to the folder
};

/// Plays a scene and writes, as it goes,
///   frames/cages_0000.vtu, ...     the bodies' meshes at output times, labelled from 1
///   frames/surfaces_0000.vtp, ...  what rides in them, and balls
///   play.pvd                       all of them, for ParaView
///   history.csv                    a row a step
/// The same bytes on any number of threads. Takes away what a run before it wrote. Throws
/// IoError.
[[nodiscard]] PlaySummary run_play(const PlayScene& scene, World& world,
                                   const RunPlayOptions& options, ProgressSink& progress);

/// A closed surface of a ball, for files and pictures.
[[nodiscard]] TriMesh surface_of_ball(const Vec3& centre, double radius);

/// Names of what run_play writes.
inline constexpr const char* kPlayCollection = "play.pvd";
inline constexpr const char* kPlayHistory = "history.csv";
/// Of the history's columns, the deepest penetration.
inline constexpr std::size_t kDeepestColumn = 6;

}  // namespace myotet::play
