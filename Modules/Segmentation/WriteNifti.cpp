// SPDX-License-Identifier: Apache-2.0
#include <nifti2_io.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>

#include "Core/Errors.h"
#include "Segmentation/Formats.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "the header is written as it lies");

constexpr int kHeaderBytes = 348;
// NIfTI-1 keeps sizes in 16 bits.
constexpr int kMostVoxels = 32767;
// A rotation is stored in the qform only when the axes are orthogonal to this.
constexpr double kOrthogonal = 1e-6;
constexpr std::size_t kChunk = std::size_t{1} << 16;

/// A gzip file, or a plain one by zlib's transparent mode; same bytes for the same content.
class Output {
public:
    explicit Output(const fs::path& file)
        : file_(file), out_(gzopen(file.c_str(), file.extension() == ".gz" ? "wb6" : "wbT")) {
        if (!out_) fail();
    }
    void write(const void* bytes, std::size_t count) {
        if (count > 0 &&
            gzwrite(out_.get(), bytes, static_cast<unsigned>(count)) != static_cast<int>(count))
            fail();
    }
    void close() {
        if (gzclose(out_.release()) != Z_OK) fail();
    }

private:
    [[noreturn]] void fail() const {
        throw IoError(file_.string() +
                      ": cannot be written; check that the folder exists, may be written to and "
                      "has space left");
    }
    struct Close {
        void operator()(gzFile file) const { gzclose(file); }
    };
    fs::path file_;
    std::unique_ptr<gzFile_s, Close> out_;
};

void set_transforms(nifti_1_header& h, const LabelVolume& volume) {
    const Eigen::Affine3d ras = Eigen::Scaling(-1.0, -1.0, 1.0) * volume.index_to_lps;
    h.sform_code = NIFTI_XFORM_SCANNER_ANAT;
    for (int c = 0; c < 4; ++c) {
        h.srow_x[c] = static_cast<float>(ras.matrix()(0, c));
        h.srow_y[c] = static_cast<float>(ras.matrix()(1, c));
        h.srow_z[c] = static_cast<float>(ras.matrix()(2, c));
    }
    const Vec3 spacing = volume.spacing();
    for (int n = 0; n < 3; ++n) h.pixdim[n + 1] = static_cast<float>(spacing[n]);
    h.pixdim[0] = 1;
    const Mat3 axes = ras.linear() * spacing.cwiseInverse().asDiagonal();
    if ((axes.transpose() * axes - Mat3::Identity()).cwiseAbs().maxCoeff() > kOrthogonal)
        return;  // sheared: a quaternion cannot say it
    nifti_dmat44 m{};
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) m.m[r][c] = ras.matrix()(r, c);
    double b, c, d, x, y, z, dx, dy, dz, qfac;
    nifti_dmat44_to_quatern(m, &b, &c, &d, &x, &y, &z, &dx, &dy, &dz, &qfac);
    h.qform_code = NIFTI_XFORM_SCANNER_ANAT;
    h.quatern_b = static_cast<float>(b);
    h.quatern_c = static_cast<float>(c);
    h.quatern_d = static_cast<float>(d);
    h.qoffset_x = static_cast<float>(x);
    h.qoffset_y = static_cast<float>(y);
    h.qoffset_z = static_cast<float>(z);
    h.pixdim[0] = static_cast<float>(qfac);
}

nifti_1_header make_header(const LabelVolume& volume, std::int32_t largest) {
    nifti_1_header h;
    std::memset(&h, 0, sizeof h);
    h.sizeof_hdr = kHeaderBytes;
    h.dim[0] = 3;
    for (int n = 1; n < 8; ++n) h.dim[n] = n <= 3 ? static_cast<short>(volume.size[n - 1]) : 1;
    h.datatype = largest <= 255     ? NIFTI_TYPE_UINT8
                 : largest <= 32767 ? NIFTI_TYPE_INT16
                                    : NIFTI_TYPE_INT32;
    h.bitpix = largest <= 255 ? 8 : largest <= 32767 ? 16 : 32;
    h.xyzt_units = NIFTI_UNITS_MM;
    h.intent_code = NIFTI_INTENT_LABEL;
    std::memcpy(h.magic, "n+1", 4);
    set_transforms(h, volume);
    return h;
}

template <class T>
void write_values(Output& out, const std::vector<std::int32_t>& values) {
    std::vector<T> chunk(kChunk);
    for (std::size_t done = 0; done < values.size();) {
        const std::size_t piece = std::min(kChunk, values.size() - done);
        std::transform(values.begin() + done, values.begin() + done + piece, chunk.begin(),
                       [](std::int32_t v) { return static_cast<T>(v); });
        out.write(chunk.data(), piece * sizeof(T));
        done += piece;
    }
}

}  // namespace

void write_nifti(const LabelVolume& volume, const fs::path& file) {
    if (*std::max_element(volume.size.begin(), volume.size.end()) > kMostVoxels)
        throw InputError(file.string() +
                         ": NIfTI holds at most 32767 voxels along an axis; write .nrrd instead");
    const std::int32_t largest = *std::max_element(volume.values.begin(), volume.values.end());
    nifti_1_header header = make_header(volume, largest);

    // Extensions: their size and code, then the text, padded to 16 bytes.
    std::string extension;
    if (!volume.names.empty()) {
        extension = format_caret_labels(volume.names);
        extension.resize((extension.size() + 8 + 15) / 16 * 16 - 8, '\0');
    }
    const std::int32_t extension_head[2] = {static_cast<std::int32_t>(extension.size() + 8), 0};
    const char extender[4] = {extension.empty() ? '\0' : '\1', 0, 0, 0};
    header.vox_offset =
        static_cast<float>(kHeaderBytes + 4 + (extension.empty() ? 0 : extension.size() + 8));

    Output out(file);
    out.write(&header, sizeof header);
    out.write(extender, sizeof extender);
    if (!extension.empty()) {
        out.write(extension_head, sizeof extension_head);
        out.write(extension.data(), extension.size());
    }
    if (largest <= 255)
        write_values<std::uint8_t>(out, volume.values);
    else if (largest <= 32767)
        write_values<std::int16_t>(out, volume.values);
    else
        write_values<std::int32_t>(out, volume.values);
    out.close();
}

}  // namespace myotet::segmentation
