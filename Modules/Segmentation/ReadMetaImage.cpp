// SPDX-License-Identifier: Apache-2.0
#include "Core/Errors.h"
#include "Segmentation/Formats.h"
#include "Segmentation/ItkImage.h"
#include "Segmentation/TextHeader.h"

#include <bit>

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

bool is_true(const std::string& text) {
    return !text.empty() && (text[0] == 'T' || text[0] == 't' || text[0] == '1');
}

/// Asked before ITK, which would print its complaints.
void check_fields(const TextHeader& header, const fs::path& file) {
    for (const char* field : {"NDims", "DimSize", "ElementType"})
        if (header.get(lower_case(field)).empty())
            throw InputError(file.string() + ": the header has no line '" + field +
                             " = ...'; export the file again");
    const std::string dimensions = header.get("ndims");
    if (const std::int64_t n = whole_number(dimensions, "NDims", file); n < 3 || n > 4)
        throw InputError(file.string() + ": holds an image of " + dimensions +
                         " dimensions, but tetrahedra need three; export one whole stack");
}

ByteStream open_data(const TextHeader& header, const fs::path& file) {
    const std::string name = header.get("elementdatafile");
    const Coding coding = is_true(header.get("compresseddata")) ? Coding::deflate : Coding::plain;
    // CompressedDataSize is not needed: the compressed stream knows its own end.
    if (lower_case(name) == "local") return ByteStream(file, coding, header.data_offset);
    const fs::path data = data_file_beside(file, name);
    const std::string text = header.get("headersize");
    const std::int64_t skip = text.empty() ? 0 : whole_number(text, "HeaderSize", file);
    if (skip < 0)
        throw InputError(file.string() + ": HeaderSize = " + text +
                         " leaves the start of the voxels open; write the number of bytes to skip");
    return ByteStream(data, coding, static_cast<std::uint64_t>(skip));
}

}  // namespace

LabelFile read_metaimage(const fs::path& file) {
    const TextHeader header = read_metaimage_header(file);
    check_fields(header, file);
    const ItkHeader itk = read_itk_header(file, ItkFormat::metaimage);
    LabelFile result;
    result.volume.size = itk.size;
    result.volume.index_to_lps = itk.index_to_lps;
    if (header.get("elementspacing").empty() && header.get("elementsize").empty())
        result.warnings.push_back(file.string() + " does not say its spacing; 1 mm was assumed.");

    std::string order = header.get("binarydatabyteordermsb");
    if (order.empty()) order = header.get("elementbyteordermsb");
    const std::string binary = header.get("binarydata");
    const ScalarLayout layout{itk.type,
                              is_true(order) != (std::endian::native == std::endian::big),
                              !binary.empty() && !is_true(binary), itk.size};
    ByteStream stream = open_data(header, file);
    result.volume.values = read_scalars(stream, layout, result.warnings);
    return result;
}

void write_metaimage(const LabelVolume& volume, const fs::path& file) {
    write_itk(volume, file, ItkFormat::metaimage, {});
}

}  // namespace myotet::segmentation
