// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace myotet::segmentation {

/// The data set of a DICOM file, uncompressed, of which the outline is sound.
struct DicomBytes {
    std::string transfer_syntax;      ///< of `data`; deflated data are inflated: explicit, little
    std::vector<unsigned char> data;  ///< the elements behind the file meta information
};

/// Reads a DICOM file (DICOM PS3.10) and walks its elements (PS3.5, section 7)
/// before a parser sees it: each length lies within its parent, sequences end,
/// and they nest no deeper than any segmentation's. DCMTK takes what it got of
/// a file that is cut short and follows any nesting until its stack is full.
/// Throws IoError when the file is cut short, InputError when it is no DICOM
/// file, damaged or its pixels are compressed.
/// Memory: the file's size, twice when deflated.
[[nodiscard]] DicomBytes read_dicom_bytes(const std::filesystem::path& file);

}  // namespace myotet::segmentation
