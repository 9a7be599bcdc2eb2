// SPDX-License-Identifier: Apache-2.0
#include "Interrupt.h"

#include <atomic>
#include <csignal>

namespace myotet::app {
namespace {

std::atomic<bool> asked = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may touch nothing else");

void on_signal(int) { asked = true; }

}  // namespace

void watch_signals() {
    struct sigaction action = {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESETHAND | SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool stop_asked() { return asked; }

}  // namespace myotet::app
