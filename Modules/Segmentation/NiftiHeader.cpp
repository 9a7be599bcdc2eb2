// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/NiftiHeader.h"

#include <nifti2_io.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include "Core/Errors.h"
#include "Segmentation/Formats.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

// Quaternions are written with seven digits.
constexpr double kUnitQuaternion = 1e-3;
// Two transforms that differ by less place every voxel in the same voxel.
constexpr double kSameWithinVoxels = 0.5;

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
    throw InputError(file.string() + ": " + why);
}

template <class Raw>
NiftiHeader common_form(const Raw& raw) {
    NiftiHeader h;
    for (int n = 0; n < 8; ++n) {
        h.dim[n] = raw.dim[n];
        h.pixdim[n] = raw.pixdim[n];
    }
    h.datatype = raw.datatype;
    h.intent_code = raw.intent_code;
    h.vox_offset = static_cast<double>(raw.vox_offset);
    h.scl_slope = raw.scl_slope;
    h.scl_inter = raw.scl_inter;
    h.qform_code = raw.qform_code;
    h.sform_code = raw.sform_code;
    h.xyzt_units = raw.xyzt_units;
    h.quatern = {raw.quatern_b, raw.quatern_c, raw.quatern_d,
                 raw.qoffset_x, raw.qoffset_y, raw.qoffset_z};
    for (int c = 0; c < 4; ++c) h.srow.col(c) << raw.srow_x[c], raw.srow_y[c], raw.srow_z[c];
    return h;
}

bool spans_space(const Eigen::Affine3d& a) {
    if (!a.matrix().allFinite()) return false;
    const Vec3 lengths = a.linear().colwise().norm();
    return lengths.minCoeff() > 0 && std::abs(a.linear().determinant()) > 1e-6 * lengths.prod();
}

std::optional<Eigen::Affine3d> sform(const NiftiHeader& h) {
    if (h.sform_code <= 0) return {};
    Eigen::Affine3d a = Eigen::Affine3d::Identity();
    a.affine() = h.srow;
    return a;
}

std::optional<Eigen::Affine3d> qform(const NiftiHeader& h) {
    if (h.qform_code <= 0) return {};
    Eigen::Affine3d a = Eigen::Affine3d::Identity();
    // The library makes a rotation of anything; b, c, d of one have at most length 1.
    if (!(Vec3(h.quatern.data()).norm() <= 1 + kUnitQuaternion)) {
        a.matrix().setConstant(std::numeric_limits<double>::quiet_NaN());
        return a;
    }
    // Asked for a rotation alone: the library would take a spacing of zero or NaN as 1.
    const nifti_dmat44 m =
        nifti_quatern_to_dmat44(h.quatern[0], h.quatern[1], h.quatern[2], h.quatern[3],
                                h.quatern[4], h.quatern[5], 1, 1, 1, h.pixdim[0] < 0 ? -1.0 : 1.0);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c)
            a.matrix()(r, c) = m.m[r][c] * (c < 3 ? std::abs(h.pixdim[c + 1]) : 1.0);
    return a;
}

/// The affine of last resort: spacing alone.
Eigen::Affine3d pixdim_only(const NiftiHeader& h, const fs::path& file,
                            std::vector<std::string>& warnings) {
    warnings.push_back(file.string() +
                       " says nothing of its place in the patient; its axes were taken as right, "
                       "anterior and superior, its first voxel as the origin.");
    Eigen::Affine3d a = Eigen::Affine3d::Identity();
    for (int n = 0; n < 3; ++n) {
        if (h.pixdim[n + 1] < 0)
            warnings.push_back(file.string() + ": the spacing along axis " + std::to_string(n) +
                               " is negative; its sign was dropped.");
        a.linear()(n, n) = std::abs(h.pixdim[n + 1]);
    }
    return a;
}

std::string place_text(const Vec3& ras) {
    std::ostringstream text;
    text << "(" << ras[0] << ", " << ras[1] << ", " << ras[2] << ")";
    return text.str();
}

/// Refuses a header whose transforms place some voxel more than half a voxel
/// apart: nothing in the file tells which is right.
void compare_forms(const Eigen::Affine3d& s, const Eigen::Affine3d& q, const Index3& size,
                   const char* remedy, const fs::path& file) {
    double apart = 0;
    Vec3 worst = Vec3::Zero();
    for (int corner = 0; corner < 8; ++corner) {  // an affine difference is largest at one
        const Vec3 index((corner & 1) * (size[0] - 1), (corner >> 1 & 1) * (size[1] - 1),
                         (corner >> 2) * (size[2] - 1));
        const double distance = (s * index - q * index).norm();
        if (distance > apart) worst = index;
        apart = std::max(apart, distance);
    }
    if (apart > kSameWithinVoxels * s.linear().colwise().norm().minCoeff())
        refuse(file, "the header's two transforms disagree: voxel " + place_text(worst) +
                         " lies at " + place_text(s * worst) + " RAS by the sform and at " +
                         place_text(q * worst) +
                         " by the qform, but they may differ by half a voxel at most; " + remedy);
}

/// The transform that a user asked for by name.
Eigen::Affine3d chosen(const std::optional<Eigen::Affine3d>& form, const char* name,
                       const fs::path& file) {
    if (!form || !spans_space(*form))
        refuse(file, std::string("the ") + name + " is asked for, but the header has " +
                         (form ? "one that is singular or not finite" : "none") +
                         "; leave --orientation out");
    return *form;
}

/// Index to RAS: sform first, then qform, then the spacing alone.
Eigen::Affine3d index_to_ras(const NiftiHeader& h, const NiftiPlace& place, const fs::path& file,
                             std::vector<std::string>& warnings) {
    const std::optional<Eigen::Affine3d> s = sform(h), q = qform(h);
    if (place.orientation == Orientation::sform) return chosen(s, "sform", file);
    if (place.orientation == Orientation::qform) return chosen(q, "qform", file);
    if (!s && !q) return pixdim_only(h, file, warnings);
    const bool use_s = s && spans_space(*s), use_q = q && spans_space(*q);
    if (use_s && use_q) compare_forms(*s, *q, nifti_size(h, file), place.remedy, file);
    if (s && q && use_s != use_q)
        warnings.push_back(file.string() + ": the " + (use_s ? "qform" : "sform") +
                           " in the header is singular or not finite; the " +
                           (use_s ? "sform" : "qform") + " was used.");
    if (s && (use_s || !use_q)) return *s;  // check_geometry refuses what spans no space
    return *q;
}

/// Millimetres per unit of length that the header uses.
double unit_in_mm(const NiftiHeader& h, const fs::path& file, std::vector<std::string>& warnings) {
    switch (XYZT_TO_SPACE(h.xyzt_units)) {
        case NIFTI_UNITS_METER:
            return 1000;
        case NIFTI_UNITS_MICRON:
            return 1e-3;
        case NIFTI_UNITS_MM:
            return 1;
        default:
            warnings.push_back(file.string() +
                               " does not say its unit of length; millimetres were assumed.");
            return 1;
    }
}

}  // namespace

// The header's own size, 348 or 540, tells version and byte order.
NiftiHeader read_nifti_header(ByteStream& stream) {
    const fs::path& file = stream.file();
    std::int32_t sizeof_hdr = 0;
    stream.read_exactly(&sizeof_hdr, sizeof sizeof_hdr, "header");
    std::int32_t swapped_size = sizeof_hdr;
    nifti_swap_4bytes(1, &swapped_size);
    const auto is = [&](std::int32_t size) { return sizeof_hdr == size || swapped_size == size; };
    const auto read_rest = [&]<class Raw>(Raw& raw, int version) {
        std::memcpy(&raw, &sizeof_hdr, sizeof sizeof_hdr);
        stream.read_exactly(reinterpret_cast<char*>(&raw) + sizeof sizeof_hdr,
                            sizeof(Raw) - sizeof sizeof_hdr, "header");
        const std::string_view magic(raw.magic, 3), expected = version == 1 ? "n+1" : "n+2";
        if (magic != expected)
            refuse(file, magic.starts_with("ni")
                             ? "is the header of a pair of files (.hdr and .img), which are not "
                               "read; save it as one .nii.gz file"
                             : "the header does not carry NIfTI's mark 'n+1'; convert the file to "
                               "NIfTI (.nii.gz)");
        const bool swapped = sizeof_hdr != static_cast<std::int32_t>(sizeof(Raw));
        if (swapped) swap_nifti_header(&raw, version);
        NiftiHeader h = common_form(raw);
        h.version = version;
        h.swapped = swapped;
        return h;
    };
    if (is(sizeof(nifti_1_header))) {
        nifti_1_header raw;
        return read_rest(raw, 1);
    }
    if (is(sizeof(nifti_2_header))) {
        nifti_2_header raw;
        return read_rest(raw, 2);
    }
    refuse(file,
           "the header's size reads " + std::to_string(sizeof_hdr) +
               " where NIfTI has 348 or 540; this is not a NIfTI file: convert it to .nii.gz");
}

Index3 nifti_size(const NiftiHeader& h, const fs::path& file) {
    if (!(h.dim[0] >= 1 && h.dim[0] <= 7))
        refuse(file, "the header tells of " + std::to_string(h.dim[0]) +
                         " dimensions where NIfTI has 1 to 7; export the file again");
    if (h.dim[0] < 3)
        refuse(file, "holds an image of " + std::to_string(h.dim[0]) +
                         " dimensions, but tetrahedra need three; export the whole stack");
    return checked_size({h.dim[1], h.dim[2], h.dim[3]}, file);
}

std::optional<ScalarType> nifti_type(int datatype) {
    switch (datatype) {
        case NIFTI_TYPE_INT8:
            return ScalarType::int8;
        case NIFTI_TYPE_UINT8:
            return ScalarType::uint8;
        case NIFTI_TYPE_INT16:
            return ScalarType::int16;
        case NIFTI_TYPE_UINT16:
            return ScalarType::uint16;
        case NIFTI_TYPE_INT32:
            return ScalarType::int32;
        case NIFTI_TYPE_UINT32:
            return ScalarType::uint32;
        case NIFTI_TYPE_INT64:
            return ScalarType::int64;
        case NIFTI_TYPE_UINT64:
            return ScalarType::uint64;
        case NIFTI_TYPE_FLOAT32:
            return ScalarType::float32;
        case NIFTI_TYPE_FLOAT64:
            return ScalarType::float64;
        default:
            return {};
    }
}

bool is_nifti_colour(int datatype) {
    return datatype == NIFTI_TYPE_RGB24 || datatype == NIFTI_TYPE_RGBA32;
}

Eigen::Affine3d nifti_index_to_lps(const NiftiHeader& h, const NiftiPlace& place,
                                   const fs::path& file, std::vector<std::string>& warnings) {
    Eigen::Affine3d ras = index_to_ras(h, place, file, warnings);
    ras.affine() *= unit_in_mm(h, file, warnings);
    const Eigen::Affine3d lps = Eigen::Scaling(-1.0, -1.0, 1.0) * ras;
    check_geometry(lps, file);
    return lps;
}

std::optional<NiftiScaling> nifti_scaling(const NiftiHeader& h) {
    // Slope 0 means "none" by the standard; not-a-number is taken so by every reader.
    if (!std::isfinite(h.scl_slope) || h.scl_slope == 0) return {};
    return NiftiScaling{h.scl_slope, std::isfinite(h.scl_inter) ? h.scl_inter : 0};
}

std::uint64_t nifti_gap(const NiftiHeader& h, const fs::path& file) {
    const std::uint64_t header = h.version == 1 ? 348 : 540;
    const double least = h.version == 1 ? 352 : 544;
    if (h.vox_offset == 0) return static_cast<std::uint64_t>(least) - header;
    if (!(h.vox_offset >= least && h.vox_offset <= 1e15 &&
          h.vox_offset == std::floor(h.vox_offset)))
        refuse(file, "the header says that voxels start at byte " + std::to_string(h.vox_offset) +
                         ", which must be a whole number from " +
                         std::to_string(static_cast<int>(least)) + " on; export the file again");
    return static_cast<std::uint64_t>(h.vox_offset) - header;
}

}  // namespace myotet::segmentation
