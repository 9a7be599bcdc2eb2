// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/ItkImage.h"

#include "Core/Errors.h"
#include "Segmentation/Formats.h"

#include <itkMetaDataObject.h>
#include <itkMetaImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <cmath>

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

itk::ImageIOBase::Pointer make_io(ItkFormat format) {
    if (format == ItkFormat::nrrd) return itk::NrrdImageIO::New().GetPointer();
    return itk::MetaImageIO::New().GetPointer();
}

/// ITK's messages span lines and name source files; the last line tells the cause.
std::string cause(const itk::ExceptionObject& error) {
    std::string text = error.GetDescription();
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    text.erase(0, text.find_last_of('\n') + 1);  // npos + 1 is 0
    if (const auto address = text.find("): ");
        text.starts_with("ITK ERROR") && address != std::string::npos)
        text.erase(0, address + 3);
    return text;
}

ScalarType integer_type(std::size_t bytes, bool is_signed) {
    switch (bytes) {
        case 1: return is_signed ? ScalarType::int8 : ScalarType::uint8;
        case 2: return is_signed ? ScalarType::int16 : ScalarType::uint16;
        case 4: return is_signed ? ScalarType::int32 : ScalarType::uint32;
        default: return is_signed ? ScalarType::int64 : ScalarType::uint64;
    }
}

ScalarType scalar_type(itk::IOComponentEnum type, const fs::path& file) {
    using Type = itk::IOComponentEnum;
    switch (type) {
        case Type::CHAR: return ScalarType::int8;
        case Type::UCHAR: return ScalarType::uint8;
        case Type::SHORT: return ScalarType::int16;
        case Type::USHORT: return ScalarType::uint16;
        case Type::INT: return ScalarType::int32;
        case Type::UINT: return ScalarType::uint32;
        case Type::LONG: return integer_type(sizeof(long), true);
        case Type::ULONG: return integer_type(sizeof(long), false);
        case Type::LONGLONG: return ScalarType::int64;
        case Type::ULONGLONG: return ScalarType::uint64;
        case Type::FLOAT: return ScalarType::float32;
        case Type::DOUBLE: return ScalarType::float64;
        default:
            throw InputError(file.string() +
                             ": the type of its voxels holds no labels; export with an integer "
                             "type");
    }
}

void check_dimensions(const itk::ImageIOBase& io, const fs::path& file) {
    if (io.GetNumberOfComponents() != 1)
        throw InputError(file.string() + ": holds " + std::to_string(io.GetNumberOfComponents()) +
                         " layers or components a voxel, but one label a voxel is needed; "
                         "overlapping layers are not supported yet: export a single label map");
    const unsigned dimensions = io.GetNumberOfDimensions();
    if (dimensions < 3)
        throw InputError(file.string() + ": holds an image of " + std::to_string(dimensions) +
                         " dimensions, but tetrahedra need three; export the whole stack");
    for (unsigned n = 3; n < dimensions; ++n)
        if (io.GetDimensions(n) != 1)
            throw InputError(file.string() + ": holds " + std::to_string(io.GetDimensions(n)) +
                             " volumes, but one label volume is needed; extract one of them");
}

template <class T>
std::vector<T> narrowed(const std::vector<std::int32_t>& values) {
    return std::vector<T>(values.begin(), values.end());
}

}  // namespace

ItkHeader read_itk_header(const fs::path& file) {
    const itk::ImageIOBase::Pointer io = make_io(ItkFormat::nrrd);
    try {
        io->SetFileName(file.string());
        io->ReadImageInformation();
    } catch (const itk::ExceptionObject& error) {
        throw InputError(file.string() + ": the header makes no sense (" + cause(error) +
                         "); export the file again");
    }
    check_dimensions(*io, file);
    ItkHeader header;
    header.type = scalar_type(io->GetComponentType(), file);
    header.size = checked_size({static_cast<std::int64_t>(io->GetDimensions(0)),
                                static_cast<std::int64_t>(io->GetDimensions(1)),
                                static_cast<std::int64_t>(io->GetDimensions(2))},
                               file);
    for (unsigned axis = 0; axis < 3; ++axis) {
        const double spacing = io->GetSpacing(axis);
        if (!(spacing > 0))  // a mirrored axis is the direction's to say
            throw InputError(file.string() + ": the header gives a spacing of " +
                             std::to_string(spacing) + " mm along axis " + std::to_string(axis) +
                             ", but spacings are positive; correct the header");
        const std::vector<double> direction = io->GetDirection(axis);
        for (unsigned row = 0; row < 3; ++row)
            header.index_to_lps.linear()(row, axis) = direction[row] * spacing;
        header.index_to_lps.translation()[axis] = io->GetOrigin(axis);
    }
    check_geometry(header.index_to_lps, file);
    return header;
}

void write_itk(const LabelVolume& volume, const fs::path& file, ItkFormat format,
               const std::map<std::string, std::string>& metadata) {
    const itk::ImageIOBase::Pointer io = make_io(format);
    const Vec3 spacing = volume.spacing();
    io->SetNumberOfDimensions(3);
    io->SetNumberOfComponents(1);
    io->SetPixelType(itk::IOPixelEnum::SCALAR);
    itk::ImageIORegion region(3);
    for (unsigned axis = 0; axis < 3; ++axis) {
        const Vec3 direction = volume.index_to_lps.linear().col(axis) / spacing[axis];
        io->SetDimensions(axis, volume.size[axis]);
        io->SetSpacing(axis, spacing[axis]);
        io->SetOrigin(axis, volume.index_to_lps.translation()[axis]);
        io->SetDirection(axis, std::vector<double>(direction.begin(), direction.end()));
        region.SetSize(axis, volume.size[axis]);
    }
    io->SetIORegion(region);
    io->SetUseCompression(true);
    for (const auto& [key, value] : metadata)
        itk::EncapsulateMetaData<std::string>(io->GetMetaDataDictionary(), key, value);
    const std::int32_t largest =
        volume.values.empty() ? 0 : *std::max_element(volume.values.begin(), volume.values.end());
    try {
        io->SetFileName(file.string());
        if (largest <= 255) {
            io->SetComponentType(itk::IOComponentEnum::UCHAR);
            io->Write(narrowed<unsigned char>(volume.values).data());
        } else if (largest <= 32767) {
            io->SetComponentType(itk::IOComponentEnum::SHORT);
            io->Write(narrowed<short>(volume.values).data());
        } else {
            io->SetComponentType(itk::IOComponentEnum::INT);
            io->Write(volume.values.data());
        }
    } catch (const itk::ExceptionObject& error) {
        throw IoError(file.string() + ": cannot be written (" + cause(error) +
                      "); check that the folder exists, may be written to and has space left");
    }
}

}  // namespace myotet::segmentation
