// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cmath>

#include "Core/Errors.h"
#include "Segmentation/Formats.h"
#include "Segmentation/ItkImage.h"
#include "Segmentation/Scalars.h"
#include "Segmentation/TextHeader.h"

// The header is read here and not by ITK, whose MetaIO prints to the terminal
// when it meets a damaged one.

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

bool is_true(const std::string& text) {
    return !text.empty() && (text[0] == 'T' || text[0] == 't' || text[0] == '1');
}

/// The value of the first of several synonymous fields.
std::string first_of(const TextHeader& header, std::initializer_list<const char*> names) {
    for (const char* name : names)
        if (std::string text = header.get(lower_case(name)); !text.empty()) return text;
    return {};
}

std::string required(const TextHeader& header, const char* name, const fs::path& file) {
    std::string text = first_of(header, {name});
    if (text.empty())
        throw InputError(file.string() + ": the header has no line '" + name +
                         " = ...'; export the file again");
    return text;
}

/// `count` numbers apart by white space; empty text gives none.
std::vector<double> numbers(const std::string& text, std::size_t count, const char* name,
                            const fs::path& file) {
    std::vector<double> values = parse_numbers(text);
    if (!text.empty() && values.size() < count)
        throw InputError(file.string() + ": the header's " + name + " reads '" +
                         text.substr(0, 60) + "' but must be " + std::to_string(count) +
                         " numbers; correct the header");
    return values;
}

std::int64_t dimensions_of(const TextHeader& header, const fs::path& file) {
    const std::int64_t n = whole_number(required(header, "NDims", file), "NDims", file);
    if (n < 3 || n > 4)
        throw InputError(file.string() + ": holds an image of " + std::to_string(n) +
                         " dimensions, but tetrahedra need three; export one whole stack");
    return n;
}

Index3 size_of(const TextHeader& header, std::int64_t dimensions, const fs::path& file) {
    const auto size = numbers(required(header, "DimSize", file), dimensions, "DimSize", file);
    std::array<std::int64_t, 3> whole{};
    for (int n = 0; n < 3; ++n) {
        if (!(std::abs(size[n]) < 1e15 && size[n] == std::floor(size[n])))
            throw InputError(file.string() + ": the header's DimSize reads '" +
                             header.get("dimsize").substr(0, 60) +
                             "' but must be whole numbers; correct the header");
        whole[n] = static_cast<std::int64_t>(size[n]);
    }
    if (dimensions == 4 && size[3] != 1)
        throw InputError(file.string() + ": holds several volumes (DimSize = " +
                         header.get("dimsize").substr(0, 60) +
                         "), but one label volume is needed; extract one of them");
    const std::string channels = header.get("elementnumberofchannels");
    if (!channels.empty() && whole_number(channels, "ElementNumberOfChannels", file) != 1)
        throw InputError(file.string() + ": holds " + channels +
                         " values a voxel, but one label a voxel is needed; save overlapping "
                         "layers as .seg.nrrd, or export a single label map");
    return checked_size(whole, file);
}

/// Offset is the centre of the first voxel; line n of TransformMatrix is the
/// direction of index axis n, in LPS.
Eigen::Affine3d transform_of(const TextHeader& header, std::int64_t dimensions,
                             const fs::path& file) {
    const auto n = static_cast<std::size_t>(dimensions);
    const auto spacing =
        numbers(first_of(header, {"ElementSpacing", "ElementSize"}), n, "ElementSpacing", file);
    const auto offset =
        numbers(first_of(header, {"Offset", "Position", "Origin"}), n, "Offset", file);
    const auto matrix = numbers(first_of(header, {"TransformMatrix", "Rotation", "Orientation"}),
                                n * n, "TransformMatrix", file);
    Eigen::Affine3d a = Eigen::Affine3d::Identity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double step = spacing.empty() ? 1.0 : spacing[axis];
        if (!(step > 0))  // a mirrored axis is the matrix's to say
            throw InputError(file.string() + ": the header gives a spacing of " +
                             std::to_string(step) + " mm along axis " + std::to_string(axis) +
                             ", but spacings are positive; correct the header");
        for (std::size_t row = 0; row < 3; ++row)
            a.linear()(row, axis) = step * (matrix.empty() ? row == axis : matrix[axis * n + row]);
        a.translation()[axis] = offset.empty() ? 0.0 : offset[axis];
    }
    check_geometry(a, file);
    return a;
}

ScalarType type_of(const TextHeader& header, const fs::path& file) {
    const std::string type = required(header, "ElementType", file);
    // MetaImage's long has 4 bytes on every machine.
    for (const auto& [name, scalar] : {std::pair{"MET_CHAR", ScalarType::int8},
                                       {"MET_UCHAR", ScalarType::uint8},
                                       {"MET_SHORT", ScalarType::int16},
                                       {"MET_USHORT", ScalarType::uint16},
                                       {"MET_INT", ScalarType::int32},
                                       {"MET_UINT", ScalarType::uint32},
                                       {"MET_LONG", ScalarType::int32},
                                       {"MET_ULONG", ScalarType::uint32},
                                       {"MET_LONG_LONG", ScalarType::int64},
                                       {"MET_ULONG_LONG", ScalarType::uint64},
                                       {"MET_FLOAT", ScalarType::float32},
                                       {"MET_DOUBLE", ScalarType::float64}})
        if (type == name) return scalar;
    throw InputError(file.string() + ": stores voxels of the type '" + type.substr(0, 40) +
                     "', which holds no labels; export with an integer type");
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
    const std::int64_t dimensions = dimensions_of(header, file);
    LabelFile result;
    result.layers.front().size = size_of(header, dimensions, file);
    result.layers.front().index_to_lps = transform_of(header, dimensions, file);
    if (first_of(header, {"ElementSpacing", "ElementSize"}).empty())
        result.warnings.push_back(file.string() + " does not say its spacing; 1 mm was assumed.");

    const bool stored_big =
        is_true(first_of(header, {"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}));
    const std::string binary = header.get("binarydata");
    const ScalarLayout layout{.type = type_of(header, file),
                              .swap_bytes = stored_big != (std::endian::native == std::endian::big),
                              .ascii = !binary.empty() && !is_true(binary),
                              .size = result.layers.front().size};
    ByteStream stream = open_data(header, file);
    result.layers.front().values = read_scalars(stream, layout, result.warnings);
    return result;
}

void write_metaimage(const LabelVolume& volume, const fs::path& file) {
    write_itk(volume, file, ItkFormat::metaimage, {});
}

}  // namespace myotet::segmentation
