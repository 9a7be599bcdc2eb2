// SPDX-License-Identifier: Apache-2.0
#include "Core/Text.h"

#include <algorithm>
#include <charconv>
#include <cstdarg>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "Core/Errors.h"

namespace myotet {

std::string shown(double number) {
    char digits[40];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, number);
    return {digits, end};
}

std::string rounded(double number) {
    char digits[40];
    const auto [end, error] =
        std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6);
    return {digits, end};
}

std::string formatted(const char* form, ...) {
    va_list values, again;
    va_start(values, form);
    va_copy(again, values);
    std::string text(std::max(0, std::vsnprintf(nullptr, 0, form, values)), '\0');
    std::vsnprintf(text.data(), text.size() + 1, form, again);
    va_end(again);
    va_end(values);
    return text;
}

std::optional<double> to_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return value;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r\n\v\f";
    const std::size_t from = text.find_first_not_of(kBlank);
    if (from == std::string_view::npos) return {};
    return text.substr(from, text.find_last_not_of(kBlank) - from + 1);
}

std::string lower(std::string_view text) {
    std::string small(text);
    for (char& c : small)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return small;
}

std::string list_of(const std::vector<std::string>& words) {
    constexpr std::size_t kMostShown = 40;
    std::string list;
    for (std::size_t i = 0; i < std::min(words.size(), kMostShown); ++i)
        list += (i ? ", " : "") + words[i];
    if (words.size() > kMostShown)
        list += " and " + std::to_string(words.size() - kMostShown) + " more";
    return list;
}

void refuse(const std::filesystem::path& file, int line, const std::string& why) {
    throw InputError(file.string() + ":" + std::to_string(line) + ": " + why);
}

std::string read_whole(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream content;
    content << in.rdbuf();
    if (!in || std::filesystem::is_directory(file))
        throw IoError(file.string() + ": cannot be read; check its name and permissions");
    return std::move(content).str();
}

}  // namespace myotet
