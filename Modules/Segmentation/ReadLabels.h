// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "Core/LabelVolume.h"

namespace myotet::segmentation {

/// What a label file says, checked, with the names found in it or beside it.
struct LabelFile {
    /// At least one, all on one grid. A file whose segments overlap has several:
    /// a tissue is known by its layer and its value there.
    std::vector<LabelVolume> layers = std::vector<LabelVolume>(1);
    std::filesystem::path names_from;   ///< table or file the names came from; empty: none
    std::vector<std::string> warnings;  ///< what the user should know, a sentence each
};

/// Which of a NIfTI file's two transforms places its voxels.
enum class Orientation {
    agreed,  ///< the sform where both agree within half a voxel; refused where they do not
    sform,
    qform,
};

/// How a label file is read.
struct ReadOptions {
    std::filesystem::path names;  ///< table of names; empty: the file's own, else one beside it
    Orientation orientation = Orientation::agreed;  ///< refused for what is no NIfTI file
    /// NIfTI or NRRD with a volume for each label, of 0 and one other value, which
    /// may overlap: volume n, counted from 0, is label n + 1.
    bool one_hot = false;
};

/// Reads .nii .nii.gz .nrrd .seg.nrrd .nhdr .mha .mhd and DICOM segmentations
/// (.dcm). Names come from the table options.names, else from the file itself,
/// else from a table beside it; a table beside it that makes no sense is a
/// warning. Nothing else of a header's text is kept: no patient, date or comment.
/// Throws IoError when the file cannot be read or is cut short, InputError when
/// its content breaks a rule (NaN spacing, no labels, not whole numbers ...),
/// ResourceError when it does not fit in memory.
/// Memory: 4 bytes a voxel and layer and a little; cost: one pass over the file.
[[nodiscard]] LabelFile read_labels(const std::filesystem::path& file,
                                    const ReadOptions& options = {});

/// Writes a label volume as .nii, .nii.gz, .nrrd or .mha, by the extension, in
/// the smallest integer type that holds it; never half-written under its name.
/// Names travel in NIfTI and NRRD. Throws InputError or IoError.
void write_labels(const LabelVolume& volume, const std::filesystem::path& file);

/// True when the extension is one that read_labels knows.
[[nodiscard]] bool is_label_file(const std::filesystem::path& file);

}  // namespace myotet::segmentation
