// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
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

/// The same, and after these, for each of so many frames in their order, the tables that
/// `tables_of` gives, their reals as 32-bit numbers; a name may have groups, `frame_0003/points`.
/// No more than one frame's numbers are in memory. Throws IoError.
struct FrameTable {
    std::string name;
    std::int64_t columns = 1;
    std::vector<double> reals;
};
void write_hdf5(std::span<const Table> tables, std::size_t frames,
                const std::function<std::vector<FrameTable>(std::size_t)>& tables_of,
                const std::filesystem::path& file);

/// All numbers of a dataset of `columns` columns. Throws IoError when it cannot
/// be read, InputError when it has another shape.
[[nodiscard]] std::vector<double> read_reals(const std::filesystem::path& file,
                                             const std::string& dataset, std::int64_t columns);
[[nodiscard]] std::vector<std::int64_t> read_integers(const std::filesystem::path& file,
                                                      const std::string& dataset,
                                                      std::int64_t columns);

}  // namespace myotet::meshfiles
