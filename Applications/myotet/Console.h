// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <mutex>
#include <string>
#include <string_view>

#include "Core/Progress.h"

namespace myotet::app {

/// How much is said on stderr.
enum class Verbosity { quiet, normal, verbose };

/// In which words the log and the progress are told: for a person; a JSON object a line; or for
/// 3D Slicer, which takes progress and what it should show from stdout and all of stderr for
/// errors.
enum class Telling { text, json, slicer };

/// Before the log is set up; text where nothing else was said.
void set_telling(Telling telling);

/// One line on stderr each (of Slicer's, notes on stdout); results go to stdout and never through
/// here. Lines of JSON are {"event": "log", "level": "error", "message": "..."}, level one of
/// error, warning, info, debug.
void set_up_log(Verbosity verbosity);
void log_error(std::string_view sentence);
void log_warning(std::string_view sentence);
void log_info(std::string_view sentence);
void log_detail(std::string_view sentence);

/// The run is over: {"event": "end", "exit_code": 0}, or Slicer's end; nothing as text.
void log_end(int exit_code);

/// Progress on stderr: a bar with stage, percent and time left on a terminal,
/// else a line at each stage's start and each tenth of it; nothing when quiet.
/// As JSON {"event": "progress", "stage": "...", "fraction": 0.25}, at most ten a second, a
/// stage's start always; for Slicer its tags, on stdout. Interrupted when a signal asked for it.
class ConsoleProgress final : public ProgressSink {
public:
    explicit ConsoleProgress(Verbosity verbosity);
    ~ConsoleProgress() override;
    void report(std::string_view stage, double fraction) override;
    void warn(std::string_view sentence) override;
    void note(std::string_view sentence) override;
    [[nodiscard]] bool interrupted() const override;

private:
    using Clock = std::chrono::steady_clock;

    void draw_bar(double fraction);
    void say_line(double fraction);
    void say_event(double fraction);
    void clear_bar();

    const bool silent_;
    const bool terminal_;
    std::mutex mutex_;
    std::string stage_;
    Clock::time_point stage_began_;
    Clock::time_point last_said_;
    double furthest_ = 0;
    int tenths_said_ = 0;
    bool bar_shown_ = false;
};

}  // namespace myotet::app
