// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "Core/LabelVolume.h"

namespace myotet::segmentation {

/// Label values and names in the JSON that dcmqi's converters write beside
/// their files: segmentAttributes, lists of lists of {labelID, SegmentLabel,
/// recommendedDisplayRGBValue} (github.com/QIICR/dcmqi, doc/schemas/seg-schema.json).
/// A segment without a label is called by the meaning of its codes, as "Kidney Left".
/// Throws InputError when the text is no such table.
[[nodiscard]] std::vector<std::pair<std::int32_t, LabelName>> parse_dcmqi_table(
    const std::string& text, const std::filesystem::path& file);

}  // namespace myotet::segmentation
