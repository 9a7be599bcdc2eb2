// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>

#include "Play/RunPlay.h"

namespace myotet::app {

/// What `myotet play` was asked for.
struct PlayJobOptions {
    std::filesystem::path scene, output;
    int threads = 0;       ///< 0: as many as the process may use
    bool pictures = true;  ///< drawn of each frame, and a sheet of them
};

/// A body or ball as the report tells it.
struct PlayPart {
    std::string name;
    std::size_t nodes = 0, tets = 0, embedded = 0;
    double mass = 0;  ///< t
    bool muscle = false, ball = false;
};

/// What a run came to, or would take.
struct PlayReport {
    std::string scene, title, output;
    std::vector<PlayPart> parts;
    play::ContactLaw contact;
    play::PlaySummary run;
    double end = 0, step = 0;  ///< s, of the scene
    int threads = 0;
    std::map<std::string, double> seconds;  ///< by stage
    double peak_memory = 0;                 ///< bytes
    double processor_seconds = 0;           ///< of the whole program
    std::vector<std::string> warnings;
};

/// Reads and checks a scene and says what it holds; writes nothing.
[[nodiscard]] PlayReport check_play(const PlayJobOptions& options, ProgressSink& progress);

/// Plays a scene; see play::run_play for what is written, besides report.json and pictures/.
/// A bad scene throws before anything is written.
[[nodiscard]] PlayReport run_play_job(const PlayJobOptions& options, ProgressSink& progress);

/// report.json's content, and a table for people.
[[nodiscard]] std::string to_json(const PlayReport& report);
[[nodiscard]] std::string to_table(const PlayReport& report);

}  // namespace myotet::app
