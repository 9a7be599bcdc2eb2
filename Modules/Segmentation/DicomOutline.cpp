// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/DicomOutline.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <new>
#include <span>
#include <string_view>

#include "Core/Errors.h"
#include "Segmentation/ByteStream.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPreamble = 128;
constexpr std::uint32_t kItem = 0xFFFEE000, kItemEnd = 0xFFFEE00D, kSequenceEnd = 0xFFFEE0DD,
                        kPixelData = 0x7FE00010, kTransferSyntax = 0x00020010;
constexpr std::uint32_t kUndefined = 0xFFFFFFFF;
// Functional groups nest six deep, code sequences in them a few more.
constexpr std::size_t kDeepest = 32;

constexpr std::string_view kImplicit = "1.2.840.10008.1.2", kExplicit = "1.2.840.10008.1.2.1",
                           kBigEndian = "1.2.840.10008.1.2.2", kDeflated = "1.2.840.10008.1.2.1.99";

/// What an element's head says.
struct Element {
    std::uint32_t tag = 0, length = 0;
    bool sequence = false;
    bool unknown = false;  ///< of unknown representation: what it holds has none written
};

/// Walks elements one by one, without recursion.
class Walk {
public:
    Walk(std::span<const unsigned char> bytes, bool is_explicit, bool big, const fs::path& file)
        : bytes_(bytes), big_(big), file_(file), levels_{{bytes.size(), is_explicit, false}} {}

    /// To the end; throws when something does not fit.
    void check_all();
    /// One element of the top level that is no sequence; its value lies before `at()`.
    Element step_flat();
    [[nodiscard]] std::size_t at() const { return at_; }
    [[nodiscard]] std::uint32_t peek_group() const {
        return bytes_.size() - at_ < 2 ? 0xFFFF : number(at_, 2);
    }

private:
    struct Level {
        std::size_t end;        // first byte behind it, or the parent's when it has no length
        bool is_explicit;       // value representations are written
        bool open = false;      // ends with a delimiter
        bool of_items = false;  // a sequence: items stand in it
    };

    [[nodiscard]] std::uint32_t number(std::size_t at, std::size_t size) const;
    Element head();
    void descend(const Element& element);
    [[nodiscard]] bool starts_with_item(const Element& element) const;
    [[noreturn]] void cut_short() const {
        throw IoError(file_.string() +
                      ": the file ends inside its DICOM elements; it is cut short: copy or export "
                      "it again");
    }
    [[noreturn]] void damaged(const char* what) const {
        throw InputError(file_.string() + ": the DICOM elements " + what + " at byte " +
                         std::to_string(at_) +
                         " of the data set; the file is damaged: copy or "
                         "export it again");
    }

    std::span<const unsigned char> bytes_;
    bool big_;
    const fs::path& file_;
    std::vector<Level> levels_;
    std::size_t at_ = 0;
};

std::uint32_t Walk::number(std::size_t at, std::size_t size) const {
    std::uint32_t value = 0;
    for (std::size_t n = 0; n < size; ++n)
        value |= std::uint32_t{bytes_[at + (big_ ? size - 1 - n : n)]} << (8 * n);
    return value;
}

bool is_one_of(std::string_view vr, std::span<const std::string_view> known) {
    return std::ranges::find(known, vr) != known.end();
}

// Value representations [DICOM PS3.5, sec. 6.2] with a length of two bytes, and of four.
constexpr std::array<std::string_view, 21> kShortForms = {"AE", "AS", "AT", "CS", "DA", "DS", "DT",
                                                          "FD", "FL", "IS", "LO", "LT", "PN", "SH",
                                                          "SL", "SS", "ST", "TM", "UI", "UL", "US"};
constexpr std::array<std::string_view, 13> kLongForms = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                         "SV", "UC", "UN", "UR", "UT", "UV"};

/// Reads tag, value representation and length; `at_` is then at the value.
Element Walk::head() {
    const Level& level = levels_.back();
    const auto need = [&](std::size_t count) {
        if (level.end - at_ >= count) return;
        if (level.end == bytes_.size()) cut_short();
        damaged("do not fit into their sequence");
    };
    need(8);
    Element element;
    element.tag = number(at_, 2) << 16 | number(at_ + 2, 2);
    const bool delimiter = element.tag >> 16 == 0xFFFE;
    if (level.is_explicit && !delimiter) {
        const std::string_view vr(reinterpret_cast<const char*>(bytes_.data()) + at_ + 4, 2);
        const bool long_form = is_one_of(vr, kLongForms);
        // Readers differ in the length they take behind any other.
        if (!long_form && !is_one_of(vr, kShortForms))
            damaged("hold a value representation that DICOM does not know");
        need(long_form ? 12 : 8);
        element.length = long_form ? number(at_ + 8, 4) : number(at_ + 6, 2);
        element.sequence = vr == "SQ" || element.length == kUndefined;
        element.unknown = vr == "UN";
        at_ += long_form ? 12 : 8;
    } else {
        element.length = number(at_ + 4, 4);
        at_ += 8;
        element.sequence =
            !delimiter && (element.length == kUndefined || starts_with_item(element));
    }
    if (element.length != kUndefined) need(element.length);
    return element;
}

/// Without value representations, a sequence with a length shows by its first item.
bool Walk::starts_with_item(const Element& element) const {
    return element.tag != kPixelData && element.length >= 8 && bytes_.size() - at_ >= 8 &&
           (number(at_, 2) << 16 | number(at_ + 2, 2)) == kItem;
}

void Walk::descend(const Element& element) {
    if (levels_.size() > kDeepest) damaged("nest deeper than any segmentation's");
    if (element.tag == kPixelData)
        throw InputError(file_.string() +
                         ": its pixels are compressed, which is not read; save it uncompressed "
                         "(explicit little endian)");
    const Level& parent = levels_.back();
    const bool open = element.length == kUndefined;
    levels_.push_back({open ? parent.end : at_ + element.length,
                       parent.is_explicit && !element.unknown, open, element.tag != kItem});
}

void Walk::check_all() {
    for (;;) {
        while (at_ == levels_.back().end && !levels_.back().open) {
            if (levels_.size() == 1) return;
            levels_.pop_back();
        }
        if (at_ == levels_.back().end) cut_short();  // still open
        const Level level = levels_.back();
        const Element element = head();
        if (element.tag == kItemEnd || element.tag == kSequenceEnd) {
            if (!level.open || level.of_items != (element.tag == kSequenceEnd))
                damaged("end a sequence that is not open");
            levels_.pop_back();
        } else if (level.of_items != (element.tag == kItem)) {
            damaged("hold something else where an item of a sequence should stand");
        } else if (element.sequence || element.tag == kItem) {
            descend(element);
        } else {
            at_ += element.length;
        }
    }
}

Element Walk::step_flat() {
    const Element element = head();
    if (element.sequence || element.tag == kItem) damaged("of the file's head hold a sequence");
    at_ += element.length;
    return element;
}

std::vector<unsigned char> read_whole(const fs::path& file) {
    ByteStream stream(file, Coding::plain);
    std::vector<unsigned char> bytes(stream.at_most());
    stream.read_exactly(bytes.data(), bytes.size(), "data");
    return bytes;
}

/// Inflates a raw deflate stream (RFC 1951), which has no checksum.
std::vector<unsigned char> inflated(std::span<const unsigned char> packed, const fs::path& file) {
    z_stream z{};
    if (inflateInit2(&z, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
    const auto end_with = [&](const char* why) {
        inflateEnd(&z);
        throw IoError(file.string() + ": the compressed data " + why +
                      "; copy or export the file again");
    };
    constexpr std::size_t kChunk = std::size_t{1} << 20;
    std::vector<unsigned char> plain;
    z.next_in = const_cast<unsigned char*>(packed.data());
    int status = Z_OK;
    std::size_t fed = 0;
    while (status != Z_STREAM_END) {
        if (z.avail_in == 0) {
            z.avail_in = static_cast<uInt>(std::min(packed.size() - fed, kChunk));
            fed += z.avail_in;
            if (z.avail_in == 0) end_with("are cut short");
        }
        const std::size_t done = z.total_out;
        plain.resize(done + kChunk);
        z.next_out = plain.data() + done;
        z.avail_out = static_cast<uInt>(kChunk);
        status = inflate(&z, Z_NO_FLUSH);
        if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR)
            end_with("are damaged");
    }
    plain.resize(z.total_out);
    inflateEnd(&z);
    return plain;
}

/// The transfer syntax that the file meta information names; `begin` is then
/// where the data set starts.
std::string read_meta(std::span<const unsigned char> bytes, std::size_t& begin,
                      const fs::path& file) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (bytes.size() < kPreamble + 4 || text.substr(kPreamble, 4) != "DICM")
        throw InputError(file.string() +
                         ": does not carry DICOM's mark 'DICM'; convert it to a DICOM file, .nrrd "
                         "or .nii.gz");
    const auto meta = bytes.subspan(kPreamble + 4);
    Walk walk(meta, true, false, file);
    std::string syntax;
    while (walk.peek_group() == 2) {
        const Element element = walk.step_flat();
        if (element.tag == kTransferSyntax)
            syntax = text.substr(kPreamble + 4 + walk.at() - element.length, element.length);
    }
    while (!syntax.empty() && (syntax.back() == '\0' || syntax.back() == ' ')) syntax.pop_back();
    begin = kPreamble + 4 + walk.at();
    return syntax;
}

}  // namespace

DicomBytes read_dicom_bytes(const fs::path& file) {
    std::vector<unsigned char> bytes = read_whole(file);
    std::size_t begin = 0;
    DicomBytes result;
    result.transfer_syntax = read_meta(bytes, begin, file);
    if (result.transfer_syntax == kDeflated) {
        result.data = inflated(std::span(bytes).subspan(begin), file);
        result.transfer_syntax = kExplicit;
    } else {
        bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(begin));
        result.data = std::move(bytes);
    }
    const bool is_explicit = result.transfer_syntax != kImplicit;
    const bool big = result.transfer_syntax == kBigEndian;
    if (is_explicit && !big && result.transfer_syntax != kExplicit)
        throw InputError(file.string() + ": the transfer syntax '" +
                         result.transfer_syntax.substr(0, 64) +
                         "' is not read (its pixels are compressed, or it is unknown); save it "
                         "uncompressed (explicit little endian)");
    Walk(result.data, is_explicit, big, file).check_all();
    return result;
}

}  // namespace myotet::segmentation
