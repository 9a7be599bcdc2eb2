// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/ReadVectors.h"

#include <nifti2_io.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <utility>

#include "Core/Errors.h"
#include "Segmentation/Formats.h"
#include "Segmentation/NiftiHeader.h"
#include "Segmentation/NrrdData.h"
#include "Segmentation/ValueStream.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kComponents = 3;

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
    throw InputError(file.string() + ": " + why);
}

/// Puts the values of a file, in its order, where they belong.
class Vectors {
public:
    explicit Vectors(ValueStream& values) : values_(values) { all_.reserve(values.voxels()); }

    void take(double value) {
        const bool together = values_.layout().interleaved;
        const std::size_t voxel = together ? done_ / kComponents : done_ % values_.voxels();
        const std::size_t component = together ? done_ % kComponents : done_ / values_.voxels();
        if (std::isinf(value))
            refuse(values_.file(), values_.voxel_text(done_) + " has the value " +
                                       number_text(value) +
                                       ", but components of vectors are finite, or NaN where "
                                       "there is no vector; correct it");
        if (component == 0) all_.emplace_back(0, 0, 0);  // committed as the data arrive
        all_[voxel][static_cast<Eigen::Index>(component)] = value;
        ++done_;
    }
    [[nodiscard]] std::vector<Vec3> finish() { return std::move(all_); }

private:
    ValueStream& values_;
    std::vector<Vec3> all_;
    std::size_t done_ = 0;
};

std::vector<Vec3> read_all(ByteStream& stream, const ScalarLayout& layout,
                           const NiftiScaling& scaling, std::vector<std::string>& warnings) {
    ValueStream values(stream, layout);
    try {
        Vectors vectors(values);
        const auto take = [&](double value) {
            vectors.take(scaling.slope * value + scaling.intercept);
        };
        if (layout.ascii)
            for (std::size_t n = 0; n < values.count(); ++n) take(values.next_number());
        else
            with_type(layout.type, [&]<class T>(T) {
                values.read_binary<T>(
                    values.count(), [&](const unsigned char* bytes, std::size_t piece) {
                        for (std::size_t n = 0; n < piece; ++n)
                            take(static_cast<double>(value_at<T>(bytes + n * sizeof(T))));
                    });
            });
        values.finish(warnings);
        return vectors.finish();
    } catch (const std::bad_alloc&) {
        throw ResourceError(stream.file().string() + ": " + size_text(layout) +
                            " voxels do not fit in memory; crop the volume or use a larger "
                            "machine");
    } catch (const std::length_error&) {
        throw ResourceError(stream.file().string() + ": " + size_text(layout) +
                            " voxels are more than a program can hold; crop the volume");
    }
}

/// Refuses an image that has not three values a voxel, or says that they are no vectors.
void check_components(const NiftiHeader& h, const fs::path& file) {
    std::int64_t volumes = 1, along = 4;
    for (int n = 4; n <= h.dim[0]; ++n) {
        if (h.dim[n] <= 1) continue;
        if (volumes != 1 || n > 5 || h.dim[n] != kComponents)
            refuse(file, "holds " + std::to_string(h.dim[n]) + " values along dimension " +
                             std::to_string(n) +
                             ", but vectors have three along dimension 5, or 4, and none along "
                             "others; export one vector a voxel");
        volumes = h.dim[n];
        along = n;
    }
    if (volumes != kComponents)
        refuse(file,
               "holds one value a voxel, but vectors have three along dimension 5, or 4; "
               "name a file of vectors");
    const bool vectors = h.intent_code == NIFTI_INTENT_NONE ||
                         h.intent_code == NIFTI_INTENT_VECTOR ||
                         h.intent_code == NIFTI_INTENT_DISPVECT;
    if (!vectors)
        refuse(file, "says that its three values along dimension " + std::to_string(along) +
                         " are of the intent " + std::to_string(h.intent_code) +
                         ", but vectors have the intent 1007 (or none); export vectors");
}

VectorVolume read_nifti_vectors(const fs::path& file) {
    ByteStream stream(file, starts_as_gzip(file) ? Coding::deflate : Coding::plain);
    const NiftiHeader h = read_nifti_header(stream);
    VectorVolume volume;
    volume.size = nifti_size(h, file);
    check_components(h, file);
    const std::optional<ScalarType> type = nifti_type(h.datatype);
    if (!type)
        refuse(file, "stores voxels of datatype " + std::to_string(h.datatype) +
                         ", which are no numbers; export vectors of float or double");
    const NiftiPlace place{.remedy =
                               "keep the one that is right in the file, and set the other's "
                               "code (sform_code or qform_code) to 0"};
    volume.index_to_lps = nifti_index_to_lps(h, place, file, volume.warnings);
    stream.skip(nifti_gap(h, file), "header extensions");
    const ScalarLayout layout{
        .type = *type, .swap_bytes = h.swapped, .size = volume.size, .layers = kComponents};
    volume.vectors =
        read_all(stream, layout, nifti_scaling(h).value_or(NiftiScaling{}), volume.warnings);
    for (Vec3& v : volume.vectors) v = Vec3(-v[0], -v[1], v[2]);  // RAS to LPS
    return volume;
}

VectorVolume read_nrrd_vectors(const fs::path& file) {
    const TextHeader header = read_nrrd_header(file);
    NrrdMeaning meaning = interpret_nrrd(header, file, NrrdHolds::vectors);
    NrrdData data = open_nrrd_data(header, meaning, file);
    VectorVolume volume;
    volume.size = meaning.size;
    volume.index_to_lps = meaning.index_to_lps;
    volume.warnings = std::move(meaning.warnings);
    volume.vectors = read_all(data.stream, data.layout, {}, volume.warnings);
    for (Vec3& v : volume.vectors) v = meaning.frame_to_lps * v;
    return volume;
}

}  // namespace

VectorVolume read_vectors(const fs::path& file) {
    check_file(file, "file of vectors");
    const Format format = format_of(file);
    if (format != Format::nifti && format != Format::nrrd)
        refuse(file, "the extension '" + file.extension().string() +
                         "' names no format of vectors that is known here; use .nii, .nii.gz, "
                         ".nrrd or .nhdr");
    VectorVolume volume =
        format == Format::nifti ? read_nifti_vectors(file) : read_nrrd_vectors(file);
    if (!std::ranges::any_of(volume.vectors, [](const Vec3& v) { return v.squaredNorm() > 0; }))
        refuse(file,
               "holds no vector (each is zero or not a number), but at least one is "
               "needed; check what was exported");
    return volume;
}

}  // namespace myotet::segmentation
