// SPDX-License-Identifier: Apache-2.0
#include <dcmtk/config/osconfig.h>
//
#include <dcmtk/dcmdata/dcistrmb.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmfg/fgpixmsr.h>
#include <dcmtk/dcmfg/fgplanor.h>
#include <dcmtk/dcmfg/fgplanpo.h>
#include <dcmtk/dcmfg/fgseg.h>
#include <dcmtk/dcmiod/cielabutil.h>
#include <dcmtk/dcmseg/segdoc.h>
#include <dcmtk/dcmseg/segment.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>
#include <set>

#include "Core/Errors.h"
#include "Segmentation/DicomGrid.h"
#include "Segmentation/DicomOutline.h"
#include "Segmentation/Formats.h"
#include "Segmentation/LayerPacker.h"

namespace myotet::segmentation {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLabelmapSeg = "1.2.840.10008.5.1.4.1.1.66.7";
// Frames of two slices far apart make a large volume of a small file; a header
// that makes more of it than this lies.
constexpr double kMostVoxelsPerByte = 4096;

/// DCMTK's object, read by us: DCMTK's own way to load one loses its memory
/// when the reading fails (3.6.7).
struct Segmentation : DcmSegmentation {
    using DcmSegmentation::readWithoutPixelData;
};

/// A checked object. Its pixels are kept as they are, bit after bit, no frame
/// starting a new byte (DICOM PS3.5, section 8.1.1): DCMTK 3.6.7 makes empty
/// frames of them where a frame's number of pixels is no multiple of 8.
struct Loaded {
    std::unique_ptr<Segmentation> segmentation = std::make_unique<Segmentation>();
    int rows = 0, columns = 0;
    Uint32 frames = 0;
    std::vector<std::uint8_t> pixels;
};

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
    throw InputError(file.string() + ": " + why);
}

/// DCMTK logs to the terminal, values of the patient among it.
void silence_dcmtk() {
    static std::once_flag once;
    std::call_once(once, [] { OFLog::configure(OFLogger::OFF_LOG_LEVEL); });
}

std::string text_at(DcmItem& item, const DcmTagKey& tag) {
    OFString value;
    return item.findAndGetOFString(tag, value).good() ? std::string(value.c_str()) : std::string();
}

/// Refuses objects that are no binary segmentation, by their name.
void check_kind(DcmDataset& data, const fs::path& file) {
    const std::string kind = text_at(data, DCM_SOPClassUID);
    if (kind == kLabelmapSeg)
        refuse(file,
               "is a label map segmentation (DICOM Supplement 243), which is not read; "
               "convert it to a binary segmentation or .nii.gz");
    if (kind != UID_SegmentationStorage) {
        const char* name = dcmFindNameOfUID(kind.c_str());
        refuse(file, "is no DICOM segmentation but '" +
                         (name ? std::string(name) : kind.substr(0, 64)) +
                         "'; name the segmentation's file");
    }
    const std::string type = text_at(data, DCM_SegmentationType);
    if (type == "FRACTIONAL")
        refuse(file,
               "is a fractional segmentation, whose voxels are probabilities or "
               "occupancies; threshold it and export a binary one");
    if (type != "BINARY")
        refuse(file, "has the segmentation type '" + type.substr(0, 16) +
                         "', but BINARY is read; export a binary segmentation");
}

/// Rows, columns, frames and pixels, refused when they are not as many as told.
Loaded take_pixels(DcmDataset& data, const fs::path& file) {
    Uint16 rows = 0, columns = 0, bits = 0;
    Sint32 frames = 0;
    (void)data.findAndGetUint16(DCM_Rows, rows);
    (void)data.findAndGetUint16(DCM_Columns, columns);
    (void)data.findAndGetUint16(DCM_BitsAllocated, bits);
    (void)data.findAndGetSint32(DCM_NumberOfFrames, frames);
    if (rows == 0 || columns == 0 || frames < 1 || bits != 1)
        refuse(file, "the header tells of " + std::to_string(frames) + " frames of " +
                         std::to_string(columns) + " x " + std::to_string(rows) + " pixels of " +
                         std::to_string(bits) +
                         " bit, but there must be frames of pixels of 1 bit; export it again");
    const Uint8* bytes = nullptr;
    unsigned long there = 0;
    if (data.findAndGetUint8Array(DCM_PixelData, bytes, &there).bad() || bytes == nullptr)
        refuse(file, "holds no pixels that can be read; export it again");
    const std::uint64_t needed = (std::uint64_t{rows} * columns * frames + 7) / 8;
    if (there < needed || there > needed + 1)  // the length is even
        refuse(file, "holds " + std::to_string(there) + " bytes of pixels where its header's " +
                         std::to_string(frames) + " frames take " + std::to_string(needed) +
                         "; it is damaged: copy or export it again");
    DcmSequenceOfItems* groups = nullptr;
    if (data.findAndGetSequence(DCM_PerFrameFunctionalGroupsSequence, groups).bad() ||
        groups == nullptr || groups->card() != static_cast<unsigned long>(frames))
        refuse(file, "does not tell the place of each of its " + std::to_string(frames) +
                         " frames; export it again");
    return {.rows = rows,
            .columns = columns,
            .frames = static_cast<Uint32>(frames),
            .pixels = {bytes, bytes + there}};
}

Loaded load(const fs::path& file) {
    const DicomBytes bytes = read_dicom_bytes(file);
    silence_dcmtk();
    DcmDataset data;
    DcmInputBufferStream stream;
    stream.setBuffer(bytes.data.data(), static_cast<offile_off_t>(bytes.data.size()));
    stream.setEos();
    data.transferInit();
    const OFCondition parsed = data.read(stream, DcmXfer(bytes.transfer_syntax.c_str()).getXfer());
    data.transferEnd();
    if (parsed.bad())
        refuse(file, "its DICOM elements cannot be parsed (" + std::string(parsed.text()) +
                         "); export it again");
    check_kind(data, file);
    Loaded object = take_pixels(data, file);
    (void)data.convertToUTF8();  // what has no known character set stays as it is
    const OFCondition status = object.segmentation->readWithoutPixelData(data);
    if (status.bad())
        refuse(file, "is no valid DICOM segmentation (" + std::string(status.text()) +
                         "); export it again");
    return object;
}

template <class Group>
Group& group_of(DcmSegmentation& segmentation, Uint32 frame, DcmFGTypes::E_FGType type,
                const char* what, const fs::path& file) {
    auto* group = dynamic_cast<Group*>(segmentation.getFunctionalGroups().get(frame, type));
    if (group == nullptr)
        refuse(file, "frame " + std::to_string(frame + 1) + " has no " + what +
                         ", so its place is unknown; export it again");
    return *group;
}

/// The planes' orientation and spacings, of one frame.
FramePlanes plane_of(DcmSegmentation& segmentation, Uint32 frame, const fs::path& file) {
    FramePlanes p;
    auto& orientation = group_of<FGPlaneOrientationPatient>(
        segmentation, frame, DcmFGTypes::EFG_PLANEORIENTPATIENT, "image orientation", file);
    Vec3 &row = p.along_row, &column = p.along_column;
    auto& measures = group_of<FGPixelMeasures>(segmentation, frame, DcmFGTypes::EFG_PIXELMEASURES,
                                               "pixel spacing", file);
    if (orientation
            .getImageOrientationPatient(row[0], row[1], row[2], column[0], column[1], column[2])
            .bad() ||
        measures.getPixelSpacing(p.row_spacing, 0).bad() ||
        measures.getPixelSpacing(p.column_spacing, 1).bad())
        refuse(file, "frame " + std::to_string(frame + 1) +
                         " has an image orientation or pixel spacing that is no row of numbers; "
                         "export it again");
    // Optional: they stay 0 when absent.
    (void)measures.getSpacingBetweenSlices(p.slice_spacing);
    (void)measures.getSliceThickness(p.slice_thickness);
    return p;
}

bool same_planes(const FramePlanes& a, const FramePlanes& b) {
    constexpr double kSame = 1e-4;  // directions and mm; files have six digits
    return (a.along_row - b.along_row).norm() <= kSame &&
           (a.along_column - b.along_column).norm() <= kSame &&
           std::abs(a.row_spacing - b.row_spacing) <= kSame &&
           std::abs(a.column_spacing - b.column_spacing) <= kSame;
}

FramePlanes planes_of(const Loaded& object, const fs::path& file) {
    DcmSegmentation& segmentation = *object.segmentation;
    FramePlanes planes = plane_of(segmentation, 0, file);
    planes.rows = object.rows;
    planes.columns = object.columns;
    for (Uint32 n = 0; n < object.frames; ++n) {
        if (!same_planes(plane_of(segmentation, n, file), planes))
            refuse(file, "frame " + std::to_string(n + 1) +
                             " has another orientation or pixel spacing than the first, but all "
                             "lie on one grid; resample it and export it again");
        auto& place = group_of<FGPlanePosPatient>(segmentation, n, DcmFGTypes::EFG_PLANEPOSPATIENT,
                                                  "image position", file);
        Vec3 p = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
        if (place.getImagePositionPatient(p[0], p[1], p[2]).bad())
            refuse(file, "frame " + std::to_string(n + 1) +
                             " has an image position that is not three numbers; export it again");
        planes.positions.push_back(p);
    }
    return planes;
}

/// The numbers of each segment's frames.
std::map<std::int32_t, std::vector<Uint32>> frames_of(const Loaded& object, const FrameGrid& grid,
                                                      const fs::path& file) {
    DcmSegmentation& segmentation = *object.segmentation;
    std::map<std::int32_t, std::vector<Uint32>> frames;
    std::set<std::pair<std::int32_t, int>> seen;
    for (Uint32 n = 0; n < object.frames; ++n) {
        Uint16 number = 0;
        auto& group = group_of<FGSegmentation>(segmentation, n, DcmFGTypes::EFG_SEGMENTATION,
                                               "segment number", file);
        if (group.getReferencedSegmentNumber(number).bad() ||
            segmentation.getSegment(number) == nullptr)
            refuse(file, "frame " + std::to_string(n + 1) + " belongs to segment " +
                             std::to_string(number) +
                             ", which the file does not describe; export it again");
        if (!seen.emplace(number, grid.slice_of[n]).second)
            refuse(file, "frame " + std::to_string(n + 1) + " is a second one of segment " +
                             std::to_string(number) +
                             " in the same place; export each time point by itself");
        frames[number].push_back(n);
    }
    return frames;
}

/// SegmentLabel and RecommendedDisplayCIELabValue; nothing else of a segment.
std::map<std::int32_t, LabelName> names_of(DcmSegmentation& segmentation) {
    std::map<std::int32_t, LabelName> names;
    for (std::size_t n = 1; n <= segmentation.getNumberOfSegments(); ++n) {
        DcmSegment* segment = segmentation.getSegment(n);
        OFString label;
        if (segment == nullptr || segment->getSegmentLabel(label).bad() || label.empty()) continue;
        LabelName& name = names[static_cast<std::int32_t>(n)];
        name.name = label.c_str();
        Uint16 l = 0, a = 0, b = 0;
        if (segment->getRecommendedDisplayCIELabValue(l, a, b).bad()) continue;
        std::array<double, 3> colour{};
        IODCIELabUtil::dicomLab2RGB(colour[0], colour[1], colour[2], l, a, b);
        for (double& channel : colour) channel = std::clamp(channel, 0.0, 1.0);
        name.colour = colour;
    }
    return names;
}

/// A frame's pixels, a byte each; the first bit is a byte's lowest.
std::vector<std::uint8_t> unpacked(const std::vector<std::uint8_t>& pixels, std::size_t frame,
                                   std::size_t plane, const fs::path& file) {
    if (pixels.size() * 8 < (frame + 1) * plane)
        refuse(file, "holds fewer pixels than frames; it is damaged: copy or export it again");
    std::vector<std::uint8_t> mask(plane);
    for (std::size_t n = 0, bit = frame * plane; n < plane; ++n, ++bit)
        mask[n] = pixels[bit / 8] >> (bit % 8) & 1;
    return mask;
}

}  // namespace

LabelFile read_dicom_seg(const fs::path& file) {
    const Loaded object = load(file);
    FrameGrid grid = find_grid(planes_of(object, file), file);
    const auto frames = frames_of(object, grid, file);
    const std::size_t plane = static_cast<std::size_t>(grid.size[0]) * grid.size[1];
    LayerPacker packer(grid.size, file,
                       kMostVoxelsPerByte * static_cast<double>(fs::file_size(file)));
    for (const auto& [number, of_segment] : frames) {
        std::vector<std::vector<std::uint8_t>> masks;
        std::vector<MaskRun> runs;
        for (const Uint32 n : of_segment) {
            masks.push_back(unpacked(object.pixels, n, plane, file));
            runs.push_back({static_cast<std::size_t>(grid.slice_of[n]) * plane, masks.back()});
        }
        (void)packer.add(number, runs);
    }
    LabelFile result;
    result.layers = packer.finish(grid.index_to_lps, names_of(*object.segmentation));
    result.warnings = std::move(grid.warnings);
    return result;
}

}  // namespace myotet::segmentation
