// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace myotet {

/// SHA-256 of a byte string (FIPS 180-4), 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

/// The same of a file's content, read piece by piece. Throws IoError.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace myotet
