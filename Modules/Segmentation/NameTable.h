// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>

#include "Core/LabelVolume.h"

namespace myotet::segmentation {

/// Reads a table of label names: BIDS _dseg.tsv, ITK-SNAP, FreeSurfer LUT,
/// Slicer .ctbl, MRIcron, dcmqi JSON, or plain lines `value name`; told apart by content.
/// A name for 0 is passed over.
/// Throws IoError, or InputError with the line that makes no sense.
[[nodiscard]] std::map<std::int32_t, LabelName> read_name_table(const std::filesystem::path& file);

/// The table that lies beside a label file under a usual name, if any.
[[nodiscard]] std::optional<std::filesystem::path> find_name_table(
    const std::filesystem::path& label_file);

/// Writes `value name` lines, sorted by value.
void write_name_table(const std::map<std::int32_t, LabelName>& names,
                      const std::filesystem::path& file);

}  // namespace myotet::segmentation
