// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace myotet::meshfiles {

/// Rows of numbers under a name; the first index counts rows.
struct NpzArray {
    std::string name;
    std::size_t columns = 1;  ///< 1: an array of one dimension
    std::variant<std::vector<double>, std::vector<std::int32_t>> values;  ///< row by row
};

/// Writes .npz, which numpy.load reads: a zip archive of an .npy file (format 1.0) an array, not
/// compressed, without dates. The bytes depend on the arguments alone. Throws MeshError when a
/// name is empty or another's or a row is not whole, ResourceError beyond 4 GB, IoError.
void write_npz(std::span<const NpzArray> arrays, const std::filesystem::path& file);

}  // namespace myotet::meshfiles
