// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace myotet::skeleton {

/// Numbers over time, as in .mot and .sto files.
struct Table {
    std::string title;
    bool in_degrees = false;                ///< its angles, if any
    std::vector<std::string> columns;       ///< without the time
    std::vector<double> times;              ///< s, ascending
    std::vector<std::vector<double>> rows;  ///< a number a column
};

/// Reads .mot and .sto, whatever its header is like: `nRows=3`, `datarows 3`, none of them,
/// tabs or spaces, empty lines; what follows `endheader` is what counts. Also .csv: names
/// of columns, then numbers; the first column is the time. Angles are in degrees when the
/// header says so, or when a .mot says neither that nor a version, as SIMM's motions do.
/// Throws IoError when it
/// cannot be read, InputError "file:12: ..." when a number is none or not finite, times do
/// not ascend, a row has too few or too many numbers, or the header's count of rows is wrong.
[[nodiscard]] Table read_table(const std::filesystem::path& file);

/// Writes .sto with the header that every reader takes: title, `version=1`, `nRows`,
/// `nColumns`, `inDegrees`, then `units=` and what the caller says of them. Numbers are the
/// shortest texts that read back the same. Throws InputError as read_table, IoError.
void write_table(const Table& table, const std::string& units, const std::filesystem::path& file);

/// What a column is of: `r_elbow_flex` for `/jointset/elbow/r_elbow_flex/value`, `BRA` for
/// `/forceset/BRA/activation` or `BRA.activation`, otherwise the last part of its path.
[[nodiscard]] std::string_view short_name(std::string_view column);

/// The column of a name or short name; -1: there is none. Throws InputError when two have it.
[[nodiscard]] int find_column(const Table& table, const std::string& name);

}  // namespace myotet::skeleton
