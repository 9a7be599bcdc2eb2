// SPDX-License-Identifier: Apache-2.0
#include <nifti2_io.h>

#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "Core/Errors.h"
#include "Segmentation/Formats.h"
#include "Segmentation/NiftiHeader.h"
#include "Segmentation/OneHot.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

// Label tables take kilobytes; what is larger is some other tool's data.
constexpr std::uint64_t kMostExtensionBytes = std::uint64_t{1} << 24;
constexpr double kSlopeTolerance = 1e-6;
// More labels than any atlas has; a header that tells of more lies.
constexpr std::int64_t kMostLabels = 65535;

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
    throw InputError(file.string() + ": " + why);
}

/// Volumes in the file: one, or with `one_hot` one for each label.
std::int64_t volume_count(const NiftiHeader& h, bool one_hot, const fs::path& file) {
    for (int n = one_hot ? 5 : 4; n <= h.dim[0]; ++n)
        if (h.dim[n] > 1)
            refuse(file, "holds " + std::to_string(h.dim[n]) + " volumes along dimension " +
                             std::to_string(n) +
                             ", but one label volume is needed; extract one of them, or ask for "
                             "--one-hot when each of four dimensions' volumes is the mask of one "
                             "label");
    if (!one_hot || h.dim[0] < 4) return 1;
    if (!(h.dim[4] >= 1 && h.dim[4] <= kMostLabels))
        refuse(file, "the header tells of " + std::to_string(h.dim[4]) +
                         " volumes, but there must be 1 to " + std::to_string(kMostLabels) +
                         "; export the file again");
    return h.dim[4];
}

ScalarType label_type(int datatype, const fs::path& file) {
    if (is_nifti_colour(datatype))
        refuse(file, "stores colours (datatype " + std::to_string(datatype) +
                         "), but labels are numbers; export the label map, not its picture");
    const std::optional<ScalarType> type = nifti_type(datatype);
    if (!type)
        refuse(file, "stores voxels of datatype " + std::to_string(datatype) +
                         ", which holds no labels; export with an integer type");
    return *type;
}

void check_scaling(const NiftiHeader& h, const fs::path& file) {
    const std::optional<NiftiScaling> scaling = nifti_scaling(h);
    if (!scaling) return;
    if (std::abs(scaling->slope - 1) > kSlopeTolerance ||
        std::abs(scaling->intercept) > kSlopeTolerance)
        refuse(file, "the header scales values by " + std::to_string(scaling->slope) +
                         " and adds " + std::to_string(scaling->intercept) +
                         ", which would change the labels; save the label map with slope 1 and "
                         "intercept 0");
}

/// Reads from the header's end to the voxels' start and finds label names on the way.
std::map<std::int32_t, LabelName> read_extensions(ByteStream& stream, const NiftiHeader& h,
                                                  std::uint64_t bytes) {
    if (bytes > kMostExtensionBytes) {
        stream.skip(bytes, "header extensions");
        return {};
    }
    std::vector<char> block(static_cast<std::size_t>(bytes));
    stream.read_exactly(block.data(), block.size(), "header extensions");
    if (block[0] == 0) return {};  // the four bytes that say whether there are any
    std::map<std::int32_t, LabelName> names;
    for (std::size_t at = 4; at + 8 <= block.size();) {
        std::int32_t size = 0;
        std::memcpy(&size, block.data() + at, sizeof size);
        if (h.swapped) nifti_swap_4bytes(1, &size);
        if (size < 8 || static_cast<std::size_t>(size) > block.size() - at) break;
        // TotalSegmentator writes code 0, Connectome Workbench 30; the text itself decides.
        names.merge(
            parse_caret_labels({block.data() + at + 8, static_cast<std::size_t>(size) - 8}));
        at += size;
    }
    return names;
}

}  // namespace

LabelFile read_nifti(const fs::path& file, const ReadOptions& options) {
    ByteStream stream(file, starts_as_gzip(file) ? Coding::deflate : Coding::plain);
    const NiftiHeader h = read_nifti_header(stream);
    LabelFile result;
    const Index3 size = nifti_size(h, file);
    const ScalarLayout layout{.type = label_type(h.datatype, file),
                              .swap_bytes = h.swapped,
                              .size = size,
                              .layers = volume_count(h, options.one_hot, file)};
    check_scaling(h, file);

    const NiftiPlace place{options.orientation,
                           "say which is right with --orientation sform or --orientation qform"};
    const Eigen::Affine3d lps = nifti_index_to_lps(h, place, file, result.warnings);

    const auto names = read_extensions(stream, h, nifti_gap(h, file));
    if (options.one_hot) {
        OneHot labels(size, file);
        read_volumes(stream, layout, result.warnings,
                     [&](std::vector<std::int32_t>&& volume) { labels.take(volume); });
        result.layers = labels.finish(lps, names, result.warnings);
    } else {
        result.layers.front() = {size, lps, read_scalars(stream, layout, result.warnings), names};
    }
    return result;
}

}  // namespace myotet::segmentation
