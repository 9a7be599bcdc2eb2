// SPDX-License-Identifier: Apache-2.0
#include "Machine.h"

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

#include "Core/Errors.h"

namespace myotet::app {
namespace {

constexpr double kKibi = 1024;
constexpr double kUnknown = std::numeric_limits<double>::infinity();

rusage usage_of_self() {
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return usage;
}

double system_available() {
    std::ifstream in("/proc/meminfo");
    std::string word;
    double kibibytes = 0;
    while (in >> word)
        if (word == "MemAvailable:" && in >> kibibytes) return kibibytes * kKibi;
    return kUnknown;
}

double first_number_in(const char* file) {
    std::ifstream in(file);
    double number = 0;  // the word `max` is no number: no limit
    return in >> number ? number : kUnknown;
}

double group_available() {
    const double limit = first_number_in("/sys/fs/cgroup/memory.max");
    const double used = first_number_in("/sys/fs/cgroup/memory.current");
    return limit < kUnknown && used < kUnknown ? std::max(0.0, limit - used) : kUnknown;
}

}  // namespace

double peak_memory() { return static_cast<double>(usage_of_self().ru_maxrss) * kKibi; }

double available_memory() { return std::min(system_available(), group_available()); }

std::filesystem::path data_folder() {
    namespace fs = std::filesystem;
    std::error_code none;
    const fs::path program = fs::read_symlink("/proc/self/exe", none);
    const char* named = std::getenv("MYOTET_DATA");
    for (const fs::path& folder :
         {fs::path(named ? named : ""), program.parent_path().parent_path() / "share" / "myotet",
          fs::path(MYOTET_DATA_DIR)})
        if (!folder.empty() && fs::exists(folder / "materials", none)) return folder;
    throw IoError(
        "the folder of materials that comes with Myotet is not where it was installed; name the "
        "one that holds 'materials' in the environment variable MYOTET_DATA");
}

double processor_seconds() {
    const rusage usage = usage_of_self();
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace myotet::app
