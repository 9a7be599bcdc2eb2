// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace myotet::contraction {

/// A file of a time series, and its time.
struct TimedFile {
    double time = 0;             ///< s
    std::filesystem::path file;  ///< as the collection shall name it: relative to its folder
};

/// Writes a .pvd collection, which ParaView opens as one animation. The bytes
/// depend on the arguments alone. Several files may have one time: they are its
/// parts. Throws InputError when times descend or a file is none, IoError.
void write_pvd(std::span<const TimedFile> frames, const std::filesystem::path& file);

/// A quantity of a history, such as {"tension", "N"}; no unit: a pure number.
struct Column {
    std::string name, unit;
};

/// Numbers over time.
struct History {
    std::vector<Column> columns;            ///< the first is the time, s
    std::vector<std::vector<double>> rows;  ///< a number a column
};

/// Writes .csv: a line of names, `tension [N]`, then a line a row; numbers are
/// the shortest texts that read back the same. Throws InputError for a name
/// that stands twice or holds a comma, quote or line break, a row of another
/// length and a number that is not finite; IoError.
void write_history(const History& history, const std::filesystem::path& file);

}  // namespace myotet::contraction
