// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace myotet {

/// Calls write(temporary) with a path beside `final_path`, then renames it to
/// `final_path`: no half-written file ever carries the final name. The
/// temporary is removed when `write` throws. The temporary keeps the final
/// name's extension, for writers that look at it.
/// Throws IoError when the folder cannot be written to.
void write_atomically(const std::filesystem::path& final_path,
                      const std::function<void(const std::filesystem::path&)>& write);

/// The same for a whole text or byte string.
void write_atomically(const std::filesystem::path& final_path, std::string_view content);

}  // namespace myotet
