// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace myotet::skeleton {

/// Numbers over time, as in .mot and .sto files.
struct Table {
    std::string title;
    bool in_degrees = false;                ///< as the file says
    std::vector<std::string> columns;       ///< without the time
    std::vector<double> times;              ///< s, ascending
    std::vector<std::vector<double>> rows;  ///< a number a column
};

/// Reads .mot and .sto, whatever its header is like: `nRows=3`, `datarows 3`, none of them,
/// tabs or spaces, empty lines; what follows `endheader` is what counts. Also .csv: names
/// of columns, then numbers; the first column is the time. Throws IoError when it
/// cannot be read, InputError "file:12: ..." when a number is none or not finite, times do
/// not ascend, a row has too few or too many numbers, or the header's count of rows is wrong.
[[nodiscard]] Table read_table(const std::filesystem::path& file);

/// Writes .sto with the header that every reader takes: title, `version=1`, `nRows`,
/// `nColumns`, `inDegrees`, then `units=` and what the caller says of them. Numbers are the
/// shortest texts that read back the same. Throws InputError as read_table, IoError.
void write_table(const Table& table, const std::string& units, const std::filesystem::path& file);

/// The column of a name, also by the last part of a path such as
/// `/jointset/elbow/r_elbow_flex/value` or `/forceset/BRA/activation`; -1: there is none.
[[nodiscard]] int find_column(const Table& table, const std::string& name);

}  // namespace myotet::skeleton
