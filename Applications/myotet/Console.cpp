// SPDX-License-Identifier: Apache-2.0
#include "Console.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "Interrupt.h"
#include "Report/Html.h"

namespace myotet::app {
namespace {

constexpr int kBarWidth = 30;
constexpr double kRedrawSeconds = 0.1;
constexpr double kLineSeconds = 2;   // no more than one plain line in this time
constexpr double kGuessSeconds = 1;  // before, the time left is not guessed

double seconds_since(std::chrono::steady_clock::time_point then) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

std::string as_time(double seconds) {
    const auto whole = static_cast<long>(std::ceil(seconds));
    if (whole < 60) return std::to_string(whole) + " s";
    if (whole < 3600)
        return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
    return std::to_string(whole / 3600) + " h " + std::to_string(whole / 60 % 60) + " min";
}

std::string time_left(double elapsed, double fraction) {
    if (elapsed < kGuessSeconds || !(fraction > 0)) return "";
    return ", about " + as_time(elapsed * (1 - fraction) / fraction) + " left";
}

int percent(double fraction) { return static_cast<int>(std::floor(100 * fraction)); }

Telling telling_now = Telling::text;  // set once, before any thread is started

std::string as_line(const nlohmann::ordered_json& event) {
    return event.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// A line as it is, on stderr for the programs that read JSON, on stdout for Slicer.
void tell(const std::string& line) {
    std::FILE* stream = telling_now == Telling::slicer ? stdout : stderr;
    std::fputs((line + "\n").c_str(), stream);
    std::fflush(stream);
}

void log(spdlog::level::level_enum level, std::string_view sentence) {
    const auto& logger = *spdlog::default_logger();
    if (!logger.should_log(level)) return;
    const std::string name = level == spdlog::level::err    ? "error"
                             : level == spdlog::level::warn ? "warning"
                             : level == spdlog::level::info ? "info"
                                                            : "debug";
    if (telling_now == Telling::json) {
        tell(as_line({{"event", "log"}, {"level", name}, {"message", sentence}}));
    } else if (telling_now == Telling::slicer && level < spdlog::level::warn) {
        tell(std::string(sentence));
    } else {
        const bool named = level >= spdlog::level::warn;
        spdlog::log(level, "{}{}", named ? name + ": " : "", sentence);
    }
}

}  // namespace

void set_telling(Telling telling) { telling_now = telling; }

void set_up_log(Verbosity verbosity) {
    auto logger = std::make_shared<spdlog::logger>(
        "myotet", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    logger->set_pattern("myotet: %v");
    logger->set_level(verbosity == Verbosity::quiet     ? spdlog::level::err
                      : verbosity == Verbosity::verbose ? spdlog::level::debug
                                                        : spdlog::level::info);
    spdlog::set_default_logger(std::move(logger));
}

void log_error(std::string_view sentence) { log(spdlog::level::err, sentence); }
void log_warning(std::string_view sentence) { log(spdlog::level::warn, sentence); }
void log_info(std::string_view sentence) { log(spdlog::level::info, sentence); }
void log_detail(std::string_view sentence) { log(spdlog::level::debug, sentence); }

void log_end(int exit_code) {
    if (telling_now == Telling::json) tell(as_line({{"event", "end"}, {"exit_code", exit_code}}));
    if (telling_now == Telling::slicer)
        tell("<filter-end><filter-name>myotet</filter-name></filter-end>");
}

ConsoleProgress::ConsoleProgress(Verbosity verbosity)
    : silent_(verbosity == Verbosity::quiet),
      terminal_(telling_now == Telling::text && ::isatty(STDERR_FILENO) == 1) {}

ConsoleProgress::~ConsoleProgress() { clear_bar(); }

void ConsoleProgress::report(std::string_view stage, double fraction) {
    const std::lock_guard lock(mutex_);
    if (silent_) return;
    fraction = std::clamp(fraction, 0.0, 1.0);
    const bool fresh = stage != stage_;
    if (fresh) {
        stage_ = stage;
        stage_began_ = Clock::now();
        furthest_ = 0;
        tenths_said_ = 0;
    }
    furthest_ = std::max(furthest_, fraction);  // reports may overtake one another
    if (telling_now != Telling::text) {
        if (fresh || seconds_since(last_said_) >= kRedrawSeconds) say_event(furthest_);
    } else if (terminal_) {
        if (fresh || seconds_since(last_said_) >= kRedrawSeconds) draw_bar(furthest_);
    } else if (fresh) {
        log_info(stage_);
        last_said_ = Clock::now();
    } else {
        say_line(furthest_);
    }
}

void ConsoleProgress::draw_bar(double fraction) {
    const int full = static_cast<int>(kBarWidth * fraction);
    const std::string bar = std::string(full, '#') + std::string(kBarWidth - full, '.');
    std::fprintf(stderr, "\r%s [%s] %d %%%s\x1b[K", stage_.c_str(), bar.c_str(), percent(fraction),
                 time_left(seconds_since(stage_began_), fraction).c_str());
    std::fflush(stderr);
    bar_shown_ = true;
    last_said_ = Clock::now();
}

void ConsoleProgress::say_line(double fraction) {
    const int tenths = static_cast<int>(10 * fraction);
    if (tenths <= tenths_said_ || tenths >= 10 || seconds_since(last_said_) < kLineSeconds) return;
    tenths_said_ = tenths;
    last_said_ = Clock::now();
    log_info(stage_ + ": " + std::to_string(percent(fraction)) + " %" +
             time_left(seconds_since(stage_began_), fraction));
}

void ConsoleProgress::say_event(double fraction) {
    last_said_ = Clock::now();
    if (telling_now == Telling::json) {
        tell(as_line({{"event", "progress"}, {"stage", stage_}, {"fraction", fraction}}));
        return;
    }
    const auto tag = [](const std::string& name, const std::string& text) {
        return "<filter-" + name + ">" + text + "</filter-" + name + ">";
    };
    tell(tag("comment", report::escaped(stage_)));
    tell(tag("progress", std::to_string(fraction)));
}

void ConsoleProgress::clear_bar() {
    if (!bar_shown_) return;
    std::fprintf(stderr, "\r\x1b[K");
    std::fflush(stderr);
    bar_shown_ = false;
}

void ConsoleProgress::warn(std::string_view sentence) {
    const std::lock_guard lock(mutex_);
    clear_bar();
    log_warning(sentence);
}

void ConsoleProgress::note(std::string_view sentence) {
    const std::lock_guard lock(mutex_);
    clear_bar();
    log_info(sentence);
}

bool ConsoleProgress::interrupted() const { return stop_asked(); }

}  // namespace myotet::app
