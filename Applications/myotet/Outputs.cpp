// SPDX-License-Identifier: Apache-2.0
#include "Outputs.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
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

/// Last made, first removed; a folder that holds other things stays.
void remove_all(const std::vector<fs::path>& made) {
    std::error_code ignored;
    for (const fs::path& path : made | std::views::reverse) fs::remove(path, ignored);
}

}  // namespace

std::string file_stem(int layer, std::int32_t value, std::string_view name) {
    std::string safe(shortened(name));
    std::ranges::replace_if(
        safe, [](unsigned char c) { return !harmless(c); }, '_');
    return (layer > 0 ? std::to_string(layer) + "-" : "") + std::to_string(value) + "_" + safe;
}

OutputFolder::OutputFolder(fs::path folder) : folder_(std::move(folder)) {
    // Rights alone do not tell: the disk may be read-only, or not take files.
    const std::vector<fs::path> fresh = make_folders(folder_);
    const fs::path probe = folder_ / (".probe" + std::to_string(::getpid()));
    const bool taken = static_cast<bool>(std::ofstream(probe) << ' ' << std::flush);
    std::error_code ignored;
    fs::remove(probe, ignored);
    remove_all(fresh);
    if (!taken) refuse(folder_, "no file can be created there");
}

OutputFolder::~OutputFolder() {
    if (!kept_) remove_all(made_);
}

std::vector<fs::path> OutputFolder::make_folders(const fs::path& folder) {
    std::vector<fs::path> fresh;
    std::error_code error;
    for (fs::path missing = folder; !missing.empty() && !fs::exists(missing, error);
         missing = missing.parent_path())
        fresh.insert(fresh.begin(), missing);
    fs::create_directories(folder, error);
    if (!fs::is_directory(folder, error)) {
        remove_all(fresh);
        refuse(folder, error ? "it cannot be created (" + error.message() + ")"
                             : "it is a file, not a folder");
    }
    return fresh;
}

void OutputFolder::write(const std::string& name,
                         const std::function<void(const fs::path&)>& write) {
    const std::vector<fs::path> fresh = make_folders((folder_ / name).parent_path());
    made_.insert(made_.end(), fresh.begin(), fresh.end());
    try {
        write(folder_ / name);
    } catch (const IoError& failure) {
        throw ResourceError(failure.what());
    }
    made_.push_back(folder_ / name);
}

}  // namespace myotet::app
