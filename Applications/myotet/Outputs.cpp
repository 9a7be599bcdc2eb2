// SPDX-License-Identifier: Apache-2.0
#include "Outputs.h"

#include <unistd.h>

#include <algorithm>
#include <ranges>

#include "Core/Errors.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongestName = 100;  // bytes; file systems take 255

bool harmless(unsigned char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ||
           c == '.' || c >= 0x80;
}

/// Cuts a UTF-8 text between characters.
std::string_view shortened(std::string_view text) {
    if (text.size() <= kLongestName) return text;
    std::size_t end = kLongestName;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
    return text.substr(0, end);
}

[[noreturn]] void refuse(const fs::path& folder, const std::string& why) {
    throw IoError(folder.string() + ": cannot be used as output folder, because " + why +
                  "; name another with -o");
}

}  // namespace

std::string file_stem(std::int32_t value, std::string_view name) {
    std::string safe(shortened(name));
    std::ranges::replace_if(
        safe, [](unsigned char c) { return !harmless(c); }, '_');
    return std::to_string(value) + "_" + safe;
}

OutputFolder::OutputFolder(fs::path folder) : folder_(std::move(folder)) {
    fs::path standing = fs::absolute(folder_).lexically_normal();
    if (!standing.has_filename()) standing = standing.parent_path();
    std::error_code ignored;
    while (!fs::exists(standing, ignored) && standing.has_relative_path())
        standing = standing.parent_path();
    if (!fs::is_directory(standing, ignored))
        refuse(folder_, standing.string() + " is not a folder");
    if (::access(standing.c_str(), W_OK | X_OK) != 0)
        refuse(folder_, standing.string() + " may not be written to");
}

OutputFolder::~OutputFolder() {
    if (kept_) return;
    std::error_code ignored;  // a folder that holds other things stays
    for (const fs::path& made : made_ | std::views::reverse) fs::remove(made, ignored);
}

void OutputFolder::write(const std::string& name,
                         const std::function<void(const fs::path&)>& write) {
    fs::path missing = folder_;
    std::vector<fs::path> to_make;
    while (!missing.empty() && !fs::exists(missing)) {
        to_make.push_back(missing);
        missing = missing.parent_path();
    }
    std::error_code error;
    fs::create_directories(folder_, error);
    made_.insert(made_.end(), to_make.rbegin(), to_make.rend());
    if (error) refuse(folder_, "it cannot be created (" + error.message() + ")");
    try {
        write(folder_ / name);
    } catch (const IoError& failure) {
        throw ResourceError(failure.what());
    }
    made_.push_back(folder_ / name);
}

}  // namespace myotet::app
