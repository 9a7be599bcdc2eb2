// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace myotet::meshfiles {

/// A table of numbers, rows x columns, row by row.
struct Table {
    std::string name;
    std::int64_t columns = 1;
    std::span<const double> reals;           ///< either these
    std::span<const std::int32_t> integers;  ///< or these
};

/// Writes each table as a dataset of the HDF5 file's root: 64-bit reals,
/// 32-bit integers, contiguous, without times of writing. Throws IoError.
void write_hdf5(std::span<const Table> tables, const std::filesystem::path& file);

/// All numbers of a dataset of `columns` columns. Throws IoError when it cannot
/// be read, InputError when it has another shape.
[[nodiscard]] std::vector<double> read_reals(const std::filesystem::path& file,
                                             const std::string& dataset, std::int64_t columns);
[[nodiscard]] std::vector<std::int64_t> read_integers(const std::filesystem::path& file,
                                                      const std::string& dataset,
                                                      std::int64_t columns);

}  // namespace myotet::meshfiles
