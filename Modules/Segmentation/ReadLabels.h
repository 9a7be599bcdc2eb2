// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Core/LabelVolume.h"

#include <filesystem>
#include <string>
#include <vector>

namespace myotet::segmentation {

/// What a label file says, checked, with the names found in it or beside it.
struct LabelFile {
    LabelVolume volume;
    std::filesystem::path names_from;   ///< table or file the names came from; empty: none
    std::vector<std::string> warnings;  ///< what the user should know, a sentence each
};

/// Reads .nii .nii.gz .nrrd .seg.nrrd .nhdr .mha .mhd. Names come from the table
/// `names`, else from the file itself, else from a table beside it; a table
/// beside it that makes no sense is a warning.
/// Throws IoError when the file cannot be read or is cut short, InputError when
/// its content breaks a rule (NaN spacing, no labels, not whole numbers ...),
/// ResourceError when it does not fit in memory.
/// Memory: 4 bytes a voxel and a little; cost: one pass over the file.
[[nodiscard]] LabelFile read_labels(const std::filesystem::path& file,
                                    const std::filesystem::path& names = {});

/// Writes a label volume as .nii, .nii.gz, .nrrd or .mha, by the extension, in
/// the smallest integer type that holds it; never half-written under its name.
/// Names travel in NIfTI and NRRD. Throws InputError or IoError.
void write_labels(const LabelVolume& volume, const std::filesystem::path& file);

/// True when the extension is one that read_labels knows.
[[nodiscard]] bool is_label_file(const std::filesystem::path& file);

}  // namespace myotet::segmentation
