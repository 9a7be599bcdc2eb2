// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/ReadLabels.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "Segmentation/CleanName.h"
#include "Segmentation/Formats.h"
#include "Segmentation/NameTable.h"
#include "Segmentation/TextHeader.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

// A unit cell this much flatter than a box has lost a dimension to rounding.
constexpr double kSingular = 1e-6;

[[noreturn]] void refuse_format(const fs::path& file, const char* formats) {
    throw InputError(file.string() + ": the extension '" + file.extension().string() +
                     "' names no label format that is known here; use " + formats);
}

LabelFile read_format(const fs::path& file, const ReadOptions& options) {
    const Format format = format_of(file);
    if (options.orientation != Orientation::agreed && format != Format::nifti)
        throw InputError(file.string() +
                         ": has no sform and qform, which NIfTI files alone have; leave "
                         "--orientation out");
    if (options.one_hot && format != Format::nifti && format != Format::nrrd)
        throw InputError(file.string() +
                         ": --one-hot reads NIfTI and NRRD files with a volume for each label, "
                         "which this is not; leave it out");
    switch (format) {
        case Format::nifti:
            return read_nifti(file, options);
        case Format::nrrd:
            return read_nrrd(file, options);
        case Format::metaimage:
            return read_metaimage(file);
        case Format::dicom:
            return read_dicom_seg(file);
        case Format::none:
            break;
    }
    refuse_format(file, ".nii, .nii.gz, .nrrd, .seg.nrrd, .mha, .mhd or .dcm");
}

bool is_empty(const LabelVolume& layer) {
    return std::all_of(layer.values.begin(), layer.values.end(),
                       [](std::int32_t value) { return value == 0; });
}

using Names = std::map<std::int32_t, LabelName>;

bool is_named(const LabelFile& labels) {
    return std::any_of(labels.layers.begin(), labels.layers.end(),
                       [](const LabelVolume& layer) { return !layer.names.empty(); });
}

/// The values of a layer.
std::set<std::int32_t> values_in(const LabelVolume& layer) {
    std::set<std::int32_t> found;
    std::int32_t last = 0;  // most voxels have their neighbour's value
    for (const std::int32_t value : layer.values)
        if (value != last) found.insert(last = value);
    return found;
}

/// Gives the table's names to their values; values that it leaves out keep theirs.
/// A table knows no layers, so it names a value in each layer that holds it.
void apply_table(LabelFile& labels, const fs::path& table) {
    const Names names = read_name_table(table);
    labels.names_from = table;
    if (labels.layers.size() == 1) {
        for (const auto& [value, name] : names) labels.layers.front().names[value] = name;
        return;
    }
    std::set<std::int32_t> seen;
    for (LabelVolume& layer : labels.layers)
        for (const std::int32_t value : values_in(layer)) {
            const auto name = names.find(value);
            if (name == names.end()) continue;
            layer.names[value] = name->second;
            if (!seen.insert(value).second)
                labels.warnings.push_back(table.string() + ": value " + std::to_string(value) +
                                          " is in several layers, and all of them now carry its "
                                          "name.");
        }
}

/// The names in the file win over a table beside it, an explicit table over both.
void add_names(LabelFile& labels, const fs::path& file, const fs::path& explicit_table) {
    if (is_named(labels)) labels.names_from = file;
    if (!explicit_table.empty()) return apply_table(labels, explicit_table);
    if (is_named(labels)) return;
    const std::optional<fs::path> beside = find_name_table(file);
    if (!beside) return;
    try {
        apply_table(labels, *beside);
    } catch (const Error& error) {
        labels.warnings.push_back(
            "The table beside the labels was passed over: " + std::string(error.what()) + ".");
    }
}

void clean_names(Names& names) {
    for (auto& [value, label] : names) label.name = clean_name(label.name);
    std::erase_if(names, [](const auto& entry) { return entry.second.name.empty(); });
}

}  // namespace

Format format_of(const fs::path& file) {
    const std::string name = lower_case(file.filename().string());
    const auto ends = [&](std::string_view suffix) {
        return name.size() > suffix.size() && name.ends_with(suffix);
    };
    if (ends(".nii") || ends(".nii.gz")) return Format::nifti;
    if (ends(".nrrd") || ends(".nhdr")) return Format::nrrd;
    if (ends(".mha") || ends(".mhd")) return Format::metaimage;
    if (ends(".dcm")) return Format::dicom;
    return Format::none;
}

void check_file(const fs::path& file, const char* what) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status))
        throw IoError(file.string() + ": there is no such file; check the path");
    if (!fs::is_regular_file(status))
        throw IoError(file.string() + ": is not a file but a folder or device; name a " + what);
    if (fs::file_size(file, error) == 0 && !error)
        throw IoError(file.string() + ": the file is empty; copy or export it again");
}

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
    check_file(file, "label file");
    LabelFile result = read_format(file, options);
    if (std::all_of(result.layers.begin(), result.layers.end(), is_empty))
        throw InputError(file.string() +
                         ": holds no labels (every voxel is 0), but at least one is needed; check "
                         "that the segmentation was exported and not an empty layer");
    add_names(result, file, options.names);
    for (LabelVolume& layer : result.layers) clean_names(layer.names);
    return result;
}

void write_labels(const LabelVolume& volume, const fs::path& file) {
    const std::size_t count =
        static_cast<std::size_t>(volume.size[0]) * volume.size[1] * volume.size[2];
    MYOTET_CHECK(count == volume.values.size() && count > 0, "a label volume has all its voxels");
    check_geometry(volume.index_to_lps, file);
    const Format format = format_of(file);
    const std::string extension = lower_case(file.extension().string());
    if (format == Format::none || format == Format::dicom || extension == ".mhd" ||
        extension == ".nhdr")
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
