// SPDX-License-Identifier: Apache-2.0
// make_seeds OUT [FOLDER ...]: writes inputs for the fuzz target, small ones of
// our own and one for each label file and table in the folders that is small.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <system_error>

#include "Formats.h"
#include "Unit/Segmentation/DicomSample.h"
#include "Unit/Segmentation/Samples.h"

namespace {

namespace fs = std::filesystem;
namespace samples = myotet::segmentation::samples;

// Larger files make the fuzzer slow and teach it little.
constexpr std::uintmax_t kMostBytes = 100'000;

class Seeds {
public:
    explicit Seeds(fs::path out) : out_(std::move(out)) { fs::create_directories(out_); }

    void add(std::uint8_t how, const std::string& bytes) {
        std::ofstream file(out_ / ("seed_" + std::to_string(count_++)), std::ios::binary);
        file << static_cast<char>(how) << bytes;
    }

    /// A file by its ending, as it is; headers of pairs also as if they were whole.
    void add_file(const fs::path& path) {
        const std::string name = path.filename().string();
        if (fs::file_size(path) > kMostBytes) return;
        const auto ends = [&](const char* ending) { return name.ends_with(ending); };
        if (ends(".tsv") || ends(".ctbl") || ends(".json"))
            return add(myotet::fuzz::kTable, samples::read_bytes(path));
        for (std::size_t n = 0; n < myotet::fuzz::kEndings.size(); ++n)
            if (ends(myotet::fuzz::kEndings[n]))
                add(static_cast<std::uint8_t>(n), samples::read_bytes(path));
        if (name.find("dim4_2") != std::string::npos) add(7 | 8, samples::read_bytes(path));
    }

private:
    fs::path out_;
    int count_ = 0;
};

void add_own(Seeds& seeds) {
    const myotet::testing::TemporaryFolder folder;
    const auto volume = samples::make_volume(samples::oblique_axes());
    for (const char* name : {"a.nii", "a.nii.gz"}) {
        myotet::segmentation::write_labels(volume, folder.path() / name);
        seeds.add_file(folder.path() / name);
    }
    seeds.add(0, samples::nifti_bytes());
    std::string one_hot = samples::with(samples::nifti_bytes(), 40, std::int16_t{4});
    one_hot = samples::with(one_hot, 48, std::int16_t{2}).substr(0, 352);
    seeds.add(8, one_hot + std::string("\1\1\0\0\0\0\0\0\0\1\1\0\0\0\0\0", 16));
    constexpr std::uint8_t kVectors = 64;
    std::string vectors = samples::with(samples::nifti_bytes(), 40, std::int16_t{5});
    vectors = samples::with(vectors, 50, std::int16_t{3}).substr(0, 352);
    seeds.add(kVectors, vectors + std::string(24, '\1'));
    seeds.add(kVectors | 1,
              "NRRD0004\ntype: float\ndimension: 4\nsizes: 3 1 1 1\nencoding: ascii\n"
              "space: RAS\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n"
              "kinds: vector domain domain domain\n"
              "measurement frame: (0,1,0) (1,0,0) (0,0,1)\n\n1 nan 0.5\n");
    samples::DicomSample dicom;
    for (const char* syntax : {"1.2.840.10008.1.2.1", "1.2.840.10008.1.2.1.99"}) {
        dicom.transfer_syntax = syntax;
        seeds.add(3, dicom.bytes());
    }
    const std::string place =
        "type: uint8\nencoding: ascii\nspace: LPS\nspace origin: (1,2,3)\n"
        "space units: \"mm\" \"mm\" \"mm\"\n";
    seeds.add(1, "NRRD0004\n" + place +
                     "dimension: 4\nsizes: 2 2 1 1\nkinds: list domain domain domain\n"
                     "space directions: none (1,0,0) (0,1,0) (0,0,1)\nSegment0_ID:=a\n"
                     "Segment0_Name:=bone\nSegment0_LabelValue:=1\nSegment0_Layer:=1\n"
                     "Segment0_Color:=1 0 0\n\n1 1 2 0\n");
    seeds.add(5, "NRRD0004\n" + place +
                     "dimension: 3\nsizes: 4 4 4\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"
                     "encoding: raw\nline skip: 0\nbyte skip: -1\ndata file: data.raw\n");
    seeds.add(6,
              "NDims = 3\nDimSize = 4 4 4\nElementSpacing = 1 2 3\nElementType = MET_UCHAR\n"
              "ElementDataFile = data.raw\n");
    seeds.add(2,
              "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
              "CompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 1 2 3\n"
              "ElementSpacing = 1 2 3\nDimSize = 2 2 2\nElementType = MET_USHORT\n"
              "ElementDataFile = LOCAL\n" +
                  std::string(16, '\1'));
    for (const char* table :
         {"1 biceps\n2: triceps\n", "index\tname\tcolor\n1\tbiceps\t#ff0000\n",
          "1 255 0 0 1 1 1 \"biceps\"\n", "1 biceps 255 0 0 0\n2 bone 1 2 3 0\n",
          "{\"segmentAttributes\": [[{\"labelID\": 1, \"SegmentLabel\": \"biceps\", "
          "\"recommendedDisplayRGBValue\": [1, 2, 3]}]]}"})
        seeds.add(myotet::fuzz::kTable, table);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::cerr << "make_seeds OUT [FOLDER ...]\n";
        return 2;
    }
    Seeds seeds(argv[1]);
    add_own(seeds);
    for (int n = 2; n < argc; ++n) {
        std::error_code ignored;
        for (fs::recursive_directory_iterator it(argv[n], ignored), end; it != end;
             it.increment(ignored))
            if (it->is_regular_file()) seeds.add_file(it->path());
    }
}
