// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "Core/LabelVolume.h"
#include "Segmentation/ReadLabels.h"

namespace myotet::segmentation {

/// A format, by a file's extension.
enum class Format { none, nifti, nrrd, metaimage, dicom };
[[nodiscard]] Format format_of(const std::filesystem::path& file);

/// Throws IoError unless it is a file, and one with content; `what` is the kind of file to
/// name instead.
void check_file(const std::filesystem::path& file, const char* what);

/// The formats, each read into a LabelFile with the names found in the file
/// itself. Errors as read_labels; labels and tables are not looked at yet.
[[nodiscard]] LabelFile read_nifti(const std::filesystem::path& file, const ReadOptions& options);
[[nodiscard]] LabelFile read_nrrd(const std::filesystem::path& file, const ReadOptions& options);
[[nodiscard]] LabelFile read_metaimage(const std::filesystem::path& file);
[[nodiscard]] LabelFile read_dicom_seg(const std::filesystem::path& file);

/// The formats out; `file` is written in place.
void write_nifti(const LabelVolume& volume, const std::filesystem::path& file);
void write_nrrd(const LabelVolume& volume, const std::filesystem::path& file);
void write_metaimage(const LabelVolume& volume, const std::filesystem::path& file);

/// Throws InputError when a transform is not finite, has a spacing that is not
/// positive or does not span space.
void check_geometry(const Eigen::Affine3d& index_to_lps, const std::filesystem::path& file);

/// Throws InputError when a count of voxels along an axis is not positive or past 2^31 - 1.
[[nodiscard]] Index3 checked_size(const std::array<std::int64_t, 3>& size,
                                  const std::filesystem::path& file);

/// Names in a CaretExtension, the XML that neuroimaging tools put into NIfTI
/// headers: <Label Key="3" Red="1" ..>name</Label>. What is not a label is passed over.
[[nodiscard]] std::map<std::int32_t, LabelName> parse_caret_labels(std::string_view xml);
/// The same, out.
[[nodiscard]] std::string format_caret_labels(const std::map<std::int32_t, LabelName>& names);

}  // namespace myotet::segmentation
