// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace myotet::app {

/// From now on SIGINT and SIGTERM ask for a stop; a second one ends at once.
void watch_signals();

/// True when a stop was asked for.
[[nodiscard]] bool stop_asked();

}  // namespace myotet::app
