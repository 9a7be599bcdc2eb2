// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace myotet::meshfiles {

/// How VTK's XML files store the bytes of their arrays: the same way all
/// through a file.
struct VtkStorage {
    enum class Compressor { none, zlib, lz4, lzma };
    Compressor compressor = Compressor::none;
    std::size_t header_bytes = 4;  ///< of the lengths before each array: 4 or 8
    bool big_endian = false;
};

/// Bytes of one array: `from` begins with its lengths and may go on past its
/// end; `base64` says that the bytes are written as letters. `where` begins
/// messages. Throws IoError when `from` ends too early, InputError when it is
/// damaged. Memory: no more than the compressor can have made of `from`.
[[nodiscard]] std::string vtk_array_bytes(std::string_view from, bool base64,
                                          const VtkStorage& storage, const std::string& where);

}  // namespace myotet::meshfiles
