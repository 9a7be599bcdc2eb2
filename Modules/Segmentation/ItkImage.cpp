// SPDX-License-Identifier: Apache-2.0
#include "Segmentation/ItkImage.h"

#include <itkMetaDataObject.h>
#include <itkMetaImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>

#include "Core/Errors.h"

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

template <class T>
std::vector<T> narrowed(const std::vector<std::int32_t>& values) {
    return std::vector<T>(values.begin(), values.end());
}

}  // namespace

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
