// SPDX-License-Identifier: Apache-2.0
#include "Contraction/Words.h"

#include <charconv>
#include <fstream>
#include <sstream>

#include "Core/Errors.h"
#include "Repair/Fields.h"

namespace myotet::contraction {

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

std::optional<double> to_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return value;
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

std::string known_are(const std::string& word, const std::vector<std::string>& candidates) {
    if (candidates.empty()) return "; there are none";
    const std::string near = repair::nearest_word(word, candidates);
    const std::string all = list_of(candidates);
    return near.empty() ? "; known are " + all : "; did you mean '" + near + "'? Known are " + all;
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

}  // namespace myotet::contraction
