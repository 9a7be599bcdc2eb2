// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>
#include <system_error>

namespace myotet::fuzz {

/// A folder of this process, in memory where there is one; removed at the end.
inline const std::filesystem::path& folder() {
    namespace fs = std::filesystem;
    static const struct Folder {
        Folder() {
            const fs::path memory = "/dev/shm";
            path = (fs::is_directory(memory) ? memory : fs::temp_directory_path()) /
                   ("myotet_fuzz_" + std::to_string(getpid()));
            fs::create_directories(path);
        }
        ~Folder() {
            std::error_code ignored;
            fs::remove_all(path, ignored);
        }
        fs::path path;
    } made;
    return made.path;
}

}  // namespace myotet::fuzz
