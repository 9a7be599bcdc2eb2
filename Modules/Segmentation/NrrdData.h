// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "Segmentation/ByteStream.h"
#include "Segmentation/NrrdHeader.h"

namespace myotet::segmentation {

/// The values of an NRRD file, from the first on, and how they lie there.
struct NrrdData {
    ByteStream stream;
    ScalarLayout layout;
};

/// Finds them in the file itself or the one that its header names, by encoding,
/// line skip and byte skip. Throws IoError, InputError.
[[nodiscard]] NrrdData open_nrrd_data(const TextHeader& header, const NrrdMeaning& meaning,
                                      const std::filesystem::path& file);

}  // namespace myotet::segmentation
