// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace myotet::app {

/// Most memory this process has held so far, bytes.
[[nodiscard]] double peak_memory();

/// Memory that the process may still take, bytes: what the system has
/// available or what its control group leaves, whichever is less.
[[nodiscard]] double available_memory();

/// Processor time this process has used so far, s.
[[nodiscard]] double processor_seconds();

}  // namespace myotet::app
