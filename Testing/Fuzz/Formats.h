// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "Segmentation/ReadLabels.h"

namespace myotet::fuzz {

/// An input is one byte that says how to read, then the bytes of a file. The
/// byte's lowest three bits choose the ending of the file's name.
inline constexpr std::array<const char*, 8> kEndings{".nii", ".nrrd", ".mha", ".dcm",
                                                     ".txt", ".nhdr", ".mhd", ".nii.gz"};
inline constexpr std::size_t kTable = 4;  ///< the ending that is a table of names

/// Bit 6 asks for vectors.
inline bool asks_for_vectors(std::uint8_t byte) { return (byte >> 6 & 1) != 0; }

/// Bit 3 asks for masks of labels, bits 4 and 5 for one of NIfTI's transforms.
inline segmentation::ReadOptions options_of(std::uint8_t byte) {
    segmentation::ReadOptions options;
    options.one_hot = (byte >> 3 & 1) != 0;
    if ((byte >> 4 & 3) == 1) options.orientation = segmentation::Orientation::sform;
    if ((byte >> 4 & 3) == 2) options.orientation = segmentation::Orientation::qform;
    return options;
}

}  // namespace myotet::fuzz
