// SPDX-License-Identifier: Apache-2.0
#include "Core/AtomicFile.h"

#include <unistd.h>

#include <fstream>
#include <string>

#include "Core/Errors.h"

namespace myotet {
namespace fs = std::filesystem;

void write_atomically(const fs::path& final_path,
                      const std::function<void(const fs::path&)>& write) {
    // Hidden, unique to this process, with the final extension last.
    fs::path temporary = final_path;
    temporary.replace_filename("." + final_path.stem().string() + ".part" +
                               std::to_string(::getpid()) + final_path.extension().string());
    std::error_code ignored;
    try {
        write(temporary);
        std::error_code error;
        fs::rename(temporary, final_path, error);
        if (error)
            throw IoError(final_path.string() + ": cannot be written (" + error.message() +
                          "); check that the folder exists and may be written to");
    } catch (...) {
        fs::remove(temporary, ignored);
        throw;
    }
}

void write_atomically(const fs::path& final_path, std::string_view content) {
    write_atomically(final_path, [&](const fs::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out.write(content.data(), static_cast<std::streamsize>(content.size()));
        out.close();
        if (!out)
            throw IoError(final_path.string() +
                          ": cannot be written; check that the folder exists, may be written to "
                          "and has space left");
    });
}

}  // namespace myotet
