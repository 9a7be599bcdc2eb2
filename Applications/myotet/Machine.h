// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace myotet::app {

/// Most memory this process has held so far, bytes.
[[nodiscard]] double peak_memory();

/// Memory that the process may still take, bytes: what the system has
/// available or what its control group leaves, whichever is less.
[[nodiscard]] double available_memory();

/// Where Data's files are: the folder that the environment variable MYOTET_DATA names, else
/// ../share/myotet beside the program's folder, else the source tree it was built from.
/// Throws IoError when it is none of them.
[[nodiscard]] std::filesystem::path data_folder();

/// Processor time this process has used so far, s.
[[nodiscard]] double processor_seconds();

}  // namespace myotet::app
