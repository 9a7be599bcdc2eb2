// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/ReadLabels.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "Segmentation/Formats.h"
#include "Segmentation/NameTable.h"
#include "Segmentation/TextHeader.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

// A unit cell this much flatter than a box has lost a dimension to rounding.
constexpr double kSingular = 1e-6;

enum class Format { none, nifti, nrrd, metaimage };

Format format_of(const fs::path& file) {
    const std::string name = lower_case(file.filename().string());
    const auto ends = [&](std::string_view suffix) {
        return name.size() > suffix.size() && name.ends_with(suffix);
    };
    if (ends(".nii") || ends(".nii.gz")) return Format::nifti;
    if (ends(".nrrd") || ends(".nhdr")) return Format::nrrd;
    if (ends(".mha") || ends(".mhd")) return Format::metaimage;
    return Format::none;
}

[[noreturn]] void refuse_format(const fs::path& file, const char* formats) {
    throw InputError(file.string() + ": the extension '" + file.extension().string() +
                     "' names no label format that is known here; use " + formats);
}

LabelFile read_format(const fs::path& file) {
    switch (format_of(file)) {
        case Format::nifti:
            return read_nifti(file);
        case Format::nrrd:
            return read_nrrd(file);
        case Format::metaimage:
            return read_metaimage(file);
        case Format::none:
            break;
    }
    refuse_format(file, ".nii, .nii.gz, .nrrd, .seg.nrrd, .mha or .mhd");
}

void check_file(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status))
        throw IoError(file.string() + ": there is no such file; check the path");
    if (!fs::is_regular_file(status))
        throw IoError(file.string() + ": is not a file but a folder or device; name a label file");
    if (fs::file_size(file, error) == 0 && !error)
        throw IoError(file.string() + ": the file is empty; copy or export it again");
}

/// The names in the file win over a table beside it, an explicit table over both.
void add_names(LabelFile& result, const fs::path& file, const fs::path& explicit_table) {
    if (!result.layers.front().names.empty()) result.names_from = file;
    if (!explicit_table.empty()) {
        auto names = read_name_table(explicit_table);
        names.merge(result.layers.front().names);  // for values that the table leaves out
        result.layers.front().names = std::move(names);
        result.names_from = explicit_table;
    } else if (result.layers.front().names.empty()) {
        const std::optional<fs::path> beside = find_name_table(file);
        if (!beside) return;
        try {
            result.layers.front().names = read_name_table(*beside);
            result.names_from = *beside;
        } catch (const Error& error) {
            result.warnings.push_back(
                "The table beside the labels was passed over: " + std::string(error.what()) + ".");
        }
    }
}

}  // namespace

void check_geometry(const Eigen::Affine3d& index_to_lps, const fs::path& file) {
    const Vec3 spacing = index_to_lps.linear().colwise().norm();
    std::ostringstream text;
    text << spacing[0] << " x " << spacing[1] << " x " << spacing[2];
    if (!index_to_lps.matrix().allFinite() || !spacing.allFinite() || !(spacing.minCoeff() > 0))
        throw InputError(file.string() + ": the header gives a spacing of " + text.str() +
                         " mm or a place that is not finite, but spacings are positive numbers; "
                         "correct the header or export the file again");
    // The ratio, so that neither tiny nor huge spacings under- or overflow.
    const double flatness =
        std::abs((index_to_lps.linear() * spacing.cwiseInverse().asDiagonal()).determinant());
    if (!(flatness > kSingular))
        throw InputError(file.string() +
                         ": the header's transform is singular (its axes lie in one plane), but "
                         "it must span space; correct the header or export the file again");
}

Index3 checked_size(const std::array<std::int64_t, 3>& size, const fs::path& file) {
    Index3 checked{};
    for (int axis = 0; axis < 3; ++axis) {
        if (!(size[axis] >= 1 && size[axis] <= std::numeric_limits<int>::max()))
            throw InputError(file.string() + ": the header tells of " + std::to_string(size[axis]) +
                             " voxels along axis " + std::to_string(axis) +
                             ", but there must be 1 to 2147483647; export the file again");
        checked[axis] = static_cast<int>(size[axis]);
    }
    return checked;
}

bool is_label_file(const fs::path& file) { return format_of(file) != Format::none; }

LabelFile read_labels(const fs::path& file, const ReadOptions& options) {
    check_file(file);
    LabelFile result = read_format(file);
    if (std::all_of(result.layers.front().values.begin(), result.layers.front().values.end(),
                    [](std::int32_t v) { return v == 0; }))
        throw InputError(file.string() +
                         ": holds no labels (every voxel is 0), but at least one is needed; check "
                         "that the segmentation was exported and not an empty layer");
    add_names(result, file, options.names);
    return result;
}

void write_labels(const LabelVolume& volume, const fs::path& file) {
    const std::size_t count =
        static_cast<std::size_t>(volume.size[0]) * volume.size[1] * volume.size[2];
    MYOTET_CHECK(count == volume.values.size() && count > 0, "a label volume has all its voxels");
    check_geometry(volume.index_to_lps, file);
    const Format format = format_of(file);
    const std::string extension = lower_case(file.extension().string());
    if (format == Format::none || extension == ".mhd" || extension == ".nhdr")
        refuse_format(file, ".nii, .nii.gz, .nrrd or .mha");
    write_atomically(file, [&](const fs::path& temporary) {
        // Tried first, for a message with the final name; ITK leaks when it cannot open a file.
        if (!std::ofstream(temporary))
            throw IoError(
                file.string() +
                ": cannot be written; check that the folder exists and may be written to");
        if (format == Format::nifti)
            write_nifti(volume, temporary);
        else if (format == Format::nrrd)
            write_nrrd(volume, temporary);
        else
            write_metaimage(volume, temporary);
    });
}

}  // namespace myotet::segmentation
