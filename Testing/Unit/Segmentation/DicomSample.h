// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <array>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

namespace myotet::segmentation::samples {

/// A DICOM element in explicit little endian (DICOM PS3.5, section 7.1).
inline std::string element(std::uint32_t tag, const char* vr, std::string value) {
    if (value.size() % 2 != 0) value += std::string(vr) == "UI" ? '\0' : ' ';
    const auto put = [](std::uint32_t number, int bytes) {
        std::string text;
        for (int n = 0; n < bytes; ++n) text += static_cast<char>(number >> (8 * n));
        return text;
    };
    const auto size = static_cast<std::uint32_t>(value.size());
    std::string head = put(tag >> 16, 2) + put(tag & 0xFFFF, 2);
    if (vr[0] == 0) return head + put(size, 4) + value;  // an item
    head += vr;
    const std::string kind = vr;
    const bool long_form = kind == "SQ" || kind == "OB" || kind == "OW" || kind == "UT";
    return head + (long_form ? put(0, 2) + put(size, 4) : put(size, 2)) + value;
}

inline std::string us(std::uint32_t tag, std::initializer_list<int> values) {
    std::string text;
    for (const int v : values) text += {static_cast<char>(v), static_cast<char>(v >> 8)};
    return element(tag, "US", text);
}

inline std::string sequence(std::uint32_t tag, std::initializer_list<std::string> items) {
    std::string text;
    for (const std::string& item : items) text += element(0xFFFEE000, "", item);
    return element(tag, "SQ", text);
}

inline std::string code(std::uint32_t tag, const char* value, const char* meaning) {
    return sequence(tag, {element(0x00080100, "SH", value) + element(0x00080102, "SH", "SCT") +
                          element(0x00080104, "LO", meaning)});
}

/// Raw deflate, as the deflated transfer syntax has it.
inline std::string deflated(const std::string& plain) {
    z_stream z{};
    if (deflateInit2(&z, 6, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("deflateInit2");
    std::string packed(deflateBound(&z, plain.size()), '\0');
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(plain.data()));
    z.avail_in = static_cast<uInt>(plain.size());
    z.next_out = reinterpret_cast<Bytef*>(packed.data());
    z.avail_out = static_cast<uInt>(packed.size());
    deflate(&z, Z_FINISH);
    packed.resize(z.total_out);
    deflateEnd(&z);
    return packed;
}

/// A small binary DICOM segmentation: two segments on slices of 3 x 2 pixels.
/// Tests change its fields.
struct DicomSample {
    struct Frame {
        int segment = 1;
        std::array<double, 3> position{};
        std::string mask;  ///< '0' and '1', row by row
    };
    int rows = 2, columns = 3, number_of_frames = 0;  ///< 0: as many as there are
    std::string transfer_syntax = "1.2.840.10008.1.2.1";
    std::string sop_class = "1.2.840.10008.5.1.4.1.1.66.4";
    std::string type = "BINARY";
    std::string mark = "Archibald^Doe";  ///< of name, id, dates, descriptions
    std::string orientation = "1\\0\\0\\0\\1\\0", pixel_spacing = "0.75\\0.5";
    std::vector<Frame> frames{{1, {-5, 20, 10}, "100000"},
                              {2, {-5, 20, 16}, "000111"},
                              {1, {-5, 20, 12}, "010000"},
                              {2, {-5, 20, 10}, "000001"}};

    [[nodiscard]] std::string bytes() const {
        const std::string set = data_set();
        const std::string meta =
            element(0x00020001, "OB", std::string("\0\1", 2)) +
            element(0x00020002, "UI", sop_class) + element(0x00020003, "UI", "1.2.3.4") +
            element(0x00020010, "UI", transfer_syntax) + element(0x00020012, "UI", "1.2.3");
        std::string length;
        for (int n = 0; n < 4; ++n) length += static_cast<char>(meta.size() >> (8 * n));
        return std::string(128, '\0') + "DICM" + element(0x00020000, "UL", length) + meta +
               (transfer_syntax.ends_with(".99") ? deflated(set) : set);
    }

private:
    [[nodiscard]] std::string segment(int number, const std::string& label,
                                      const std::string& colour) const {
        return code(0x00620003, "123037004", "Anatomical Structure") + us(0x00620004, {number}) +
               element(0x00620005, "LO", label) + element(0x00620006, "ST", mark) +
               element(0x00620008, "CS", "MANUAL") + colour + code(0x0062000F, "71341001", "Bone") +
               element(0x00620020, "UT", mark);
    }
    [[nodiscard]] std::string data_set() const;
};

inline std::string DicomSample::data_set() const {
    std::string pixels, groups;
    int bit = 0;
    for (const Frame& frame : frames) {
        for (const char c : frame.mask) {
            if (bit % 8 == 0) pixels += '\0';
            if (c == '1') pixels.back() = static_cast<char>(pixels.back() | 1 << bit % 8);
            ++bit;
        }
        std::string place;
        for (const double x : frame.position)
            place += (place.empty() ? "" : "\\") + std::to_string(x);
        groups += element(
            0xFFFEE000, "",
            sequence(0x00209111, {element(0x00209157, "UL", std::string("\1\0\0\0\1\0\0\0", 8))}) +
                sequence(0x00209113, {element(0x00200032, "DS", place)}) +
                sequence(0x0062000A, {us(0x0062000B, {frame.segment})}));
    }
    const int count = number_of_frames > 0 ? number_of_frames : static_cast<int>(frames.size());
    const std::string uid = "1.2.3.9";
    return element(0x00080005, "CS", "ISO_IR 100") + element(0x00080008, "CS", "DERIVED\\PRIMARY") +
           element(0x00080016, "UI", sop_class) + element(0x00080018, "UI", "1.2.3.4") +
           element(0x00080020, "DA", "19991231") + element(0x00080023, "DA", "19991231") +
           element(0x00080030, "TM", "235959") + element(0x00080033, "TM", "235959") +
           element(0x00080050, "SH", "") + element(0x00080060, "CS", "SEG") +
           element(0x00080070, "LO", mark) + element(0x00080090, "PN", mark) +
           element(0x00081030, "LO", mark) + element(0x0008103E, "LO", mark) +
           element(0x00081090, "LO", mark) + element(0x00100010, "PN", mark) +
           element(0x00100020, "LO", mark) + element(0x00100030, "DA", "19991231") +
           element(0x00100040, "CS", "O") + element(0x00181000, "LO", mark) +
           element(0x00181020, "LO", mark) + element(0x0020000D, "UI", uid) +
           element(0x0020000E, "UI", uid) + element(0x00200010, "SH", "1") +
           element(0x00200011, "IS", "1") + element(0x00200013, "IS", "1") +
           element(0x00200052, "UI", uid) + element(0x00201040, "LO", "") +
           element(0x00204000, "LT", mark) +
           sequence(0x00209221, {element(0x00209164, "UI", uid)}) +
           sequence(0x00209222, {element(0x00209164, "UI", uid) +
                                 element(0x00209165, "AT", std::string("\x62\0\x0b\0", 4)) +
                                 element(0x00209167, "AT", std::string("\x62\0\x0a\0", 4))}) +
           us(0x00280002, {1}) + element(0x00280004, "CS", "MONOCHROME2") +
           element(0x00280008, "IS", std::to_string(count)) + us(0x00280010, {rows}) +
           us(0x00280011, {columns}) + us(0x00280100, {1}) + us(0x00280101, {1}) +
           us(0x00280102, {0}) + us(0x00280103, {0}) + element(0x00282110, "CS", "00") +
           element(0x00620001, "CS", type) +
           sequence(0x00620002, {segment(1, "biceps", us(0x0062000D, {41661, 41167, 40792})),
                                 segment(2, "M\xfcller", "")}) +
           element(0x00700080, "CS", "SEG") + element(0x00700081, "LO", mark) +
           element(0x00700084, "PN", mark) +
           sequence(0x52009229,
                    {sequence(0x00209116, {element(0x00200037, "DS", orientation)}) +
                     sequence(0x00289110, {element(0x00180050, "DS", "2") +
                                           element(0x00280030, "DS", pixel_spacing)})}) +
           element(0x52009230, "SQ", groups) + element(0x7FE00010, "OB", pixels);
}

}  // namespace myotet::segmentation::samples
