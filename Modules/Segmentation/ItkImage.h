// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "Core/LabelVolume.h"

namespace myotet::segmentation {

enum class ItkFormat { nrrd, metaimage };

/// Writes voxels with the smallest integer type that holds them, compressed,
/// and `metadata` as key and value. Throws IoError.
void write_itk(const LabelVolume& volume, const std::filesystem::path& file, ItkFormat format,
               const std::map<std::string, std::string>& metadata);

}  // namespace myotet::segmentation
