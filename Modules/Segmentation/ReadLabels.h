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
    std::filesystem::path names_from;      ///< table or file the names came from; empty: none
    std::vector<std::string> warnings;     ///< what the user should know, a sentence each
};

/// Reads .nii .nii.gz .nrrd .seg.nrrd .mha .mhd. A name table beside the file
/// is found by itself; `names` names one explicitly (empty: look beside).
/// Throws IoError when the file cannot be read or is cut short, InputError when
/// its content breaks a rule (NaN spacing, no labels, not whole numbers ...).
[[nodiscard]] LabelFile read_labels(const std::filesystem::path& file,
                                    const std::filesystem::path& names = {});

/// Writes a label volume as .nii.gz, .nrrd or .mha, by the extension.
void write_labels(const LabelVolume& volume, const std::filesystem::path& file);

/// True when the extension is one that read_labels knows.
[[nodiscard]] bool is_label_file(const std::filesystem::path& file);

}  // namespace myotet::segmentation
