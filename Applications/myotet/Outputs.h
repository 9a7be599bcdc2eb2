// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace myotet::app {

/// "<value>_<name>", "<layer>-<value>_<name>" for layers above 0, with every character that a file
/// system or a shell might stumble over replaced by '_'; letters beyond ASCII stay.
[[nodiscard]] std::string file_stem(int layer, std::int32_t value, std::string_view name);

/// A folder that results go to. It is created by the first file; unless
/// keep() is called, what was written is removed again.
class OutputFolder {
public:
    /// Throws IoError when files cannot be written there; leaves nothing behind.
    explicit OutputFolder(std::filesystem::path folder);
    ~OutputFolder();
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    /// Calls write(path of `name` in the folder); a name may have folders. Throws ResourceError
    /// when writing fails, since the folder could be written to before.
    void write(const std::string& name,
               const std::function<void(const std::filesystem::path&)>& write);
    void keep() { kept_ = true; }

private:
    /// Creates a folder and those above it; returns the new ones, outermost first.
    static std::vector<std::filesystem::path> make_folders(const std::filesystem::path& folder);

    std::filesystem::path folder_;
    std::vector<std::filesystem::path> made_;  ///< folders and files, in order
    bool kept_ = false;
};

}  // namespace myotet::app
