// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "Core/LabelVolume.h"
#include "Support/TemporaryFolder.h"

namespace myotet::segmentation::samples {

/// A small volume without symmetry: five labels, unequal sides.
inline LabelVolume make_volume(const Mat3& axes = Vec3(1, 2, 3).asDiagonal()) {
    LabelVolume volume;
    volume.size = {5, 4, 3};
    volume.index_to_lps.linear() = axes;
    volume.index_to_lps.translation() = Vec3(-12.5, 40, 7.25);
    volume.values.assign(60, 0);
    for (int n = 0; n < 60; ++n) volume.values[n] = n % 7 < 5 ? n % 7 : 0;
    volume.names[1] = {"biceps", std::array<double, 3>{1, 0.5, 0}};
    volume.names[2] = {"vastus <lateralis> & \"co\"", {}};
    volume.names[4] = {"m. soleus", {}};
    return volume;
}

inline Mat3 oblique_axes() {
    return (Eigen::AngleAxisd(0.3, Vec3::UnitX()) * Eigen::AngleAxisd(0.5, Vec3::UnitZ()))
               .toRotationMatrix() *
           Vec3(1, 2, 3).asDiagonal();
}

/// The bytes of an uncompressed NIfTI-1 file of 2 x 2 x 2 bytes; tests change
/// single fields by their offset in the standard.
inline std::string nifti_bytes() {
    std::string bytes(352 + 8, '\0');
    const auto put = [&](std::size_t at, auto value) {
        std::memcpy(bytes.data() + at, &value, sizeof value);
    };
    put(0, std::int32_t{348});
    const std::int16_t dim[8] = {3, 2, 2, 2, 1, 1, 1, 1};
    for (int n = 0; n < 8; ++n) put(40 + 2 * n, dim[n]);
    put(70, std::int16_t{2});  // unsigned bytes
    put(72, std::int16_t{8});
    for (int n = 0; n < 4; ++n) put(76 + 4 * n, 1.0F);
    put(108, 352.0F);
    bytes[123] = 2;  // mm
    put(254, std::int16_t{1});
    const float srow[12] = {2, 0, 0, 10, 0, 3, 0, 20, 0, 0, 4, 30};
    for (int n = 0; n < 12; ++n) put(280 + 4 * n, srow[n]);
    std::memcpy(bytes.data() + 344, "n+1", 4);
    for (int n = 0; n < 8; ++n) bytes[352 + n] = static_cast<char>(n);
    return bytes;
}

template <class T>
std::string with(std::string bytes, std::size_t offset, T value) {
    return bytes.replace(offset, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
}

inline std::filesystem::path write_bytes(const std::filesystem::path& file,
                                         const std::string& bytes) {
    std::filesystem::remove(file);  // rewriting in place makes some file systems wait for the disk
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
}

inline std::string read_bytes(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace myotet::segmentation::samples
