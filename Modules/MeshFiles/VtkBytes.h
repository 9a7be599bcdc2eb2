// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace myotet::meshfiles {

/// How VTK's XML files store the bytes of their arrays: the same way all
/// through a file.
struct VtkStorage {
    enum class Compressor { none, zlib, lz4, lzma };
    Compressor compressor = Compressor::none;
    std::size_t header_bytes = 4;  ///< of the lengths before each array: 4 or 8
    bool big_endian = false;
};

enum class VtkNumber { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// Bytes of one array: `from` begins with its lengths and may go on past its
/// end; `base64` says that the bytes are written as letters. `where` begins
/// messages. Throws IoError when `from` ends too early, InputError when it is
/// damaged. Memory: no more than the compressor can have made of `from`.
[[nodiscard]] std::string vtk_array_bytes(std::string_view from, bool base64,
                                          const VtkStorage& storage, const std::string& where);

/// The numbers in such bytes; a rest that is shorter than a number is left out.
[[nodiscard]] std::vector<double> vtk_reals(std::string_view bytes, VtkNumber kind,
                                            const VtkStorage& storage);
/// As vtk_reals; `kind` is an integer's. Values beyond 2^63 become negative.
[[nodiscard]] std::vector<std::int64_t> vtk_integers(std::string_view bytes, VtkNumber kind,
                                                     const VtkStorage& storage);

}  // namespace myotet::meshfiles
