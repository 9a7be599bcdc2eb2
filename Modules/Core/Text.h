// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace myotet {

/// A number as tables show it: the shortest text that reads back the same,
/// whatever the locale.
[[nodiscard]] std::string shown(double number);

/// A number for a reader: six digits at most.
[[nodiscard]] std::string rounded(double number);

/// What printf would write, however long it is.
[[nodiscard, gnu::format(printf, 1, 2)]] std::string formatted(const char* form, ...);

/// The number that the whole text is, "nan" and "inf" included, whatever the locale;
/// nothing otherwise.
[[nodiscard]] std::optional<double> to_number(std::string_view text);

/// Without blanks and ends of lines on both sides.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// ASCII letters made small.
[[nodiscard]] std::string lower(std::string_view text);

/// "a, b, c"; of more than forty, the first ones "and 17 more".
[[nodiscard]] std::string list_of(const std::vector<std::string>& words);

/// Throws InputError "file:line: why".
[[noreturn]] void refuse(const std::filesystem::path& file, int line, const std::string& why);

/// A whole file. Throws IoError when it cannot be read.
[[nodiscard]] std::string read_whole(const std::filesystem::path& file);

}  // namespace myotet
