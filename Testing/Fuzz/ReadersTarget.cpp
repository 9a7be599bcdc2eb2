// SPDX-License-Identifier: Apache-2.0
// libFuzzer's target: whatever the bytes are, a reader gives labels that keep
// its promises, or one of the errors that it may throw, and nothing else.
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "Core/Errors.h"
#include "Folder.h"
#include "Formats.h"
#include "Segmentation/NameTable.h"
#include "Segmentation/ReadVectors.h"

namespace {

namespace fs = std::filesystem;
using myotet::Error;
using myotet::LabelVolume;

void check(bool kept, const char* promise) { MYOTET_CHECK(kept, promise); }

void check_layer(const LabelVolume& layer, const LabelVolume& first) {
    const std::size_t voxels =
        static_cast<std::size_t>(layer.size[0]) * layer.size[1] * layer.size[2];
    check(voxels > 0 && layer.values.size() == voxels, "a volume has all its voxels");
    check(layer.size == first.size, "layers have one size");
    check(layer.index_to_lps.matrix() == first.index_to_lps.matrix(), "layers lie in one place");
    check(layer.voxel_volume() > 0, "voxels have a volume");
    for (const std::int32_t value : layer.values) check(value >= 0, "labels are not negative");
    for (const auto& [value, name] : layer.names) check(!name.name.empty(), "a name is not empty");
}

void read_vectors(const fs::path& file) {
    const auto found = myotet::segmentation::read_vectors(file);
    const std::size_t voxels =
        static_cast<std::size_t>(found.size[0]) * found.size[1] * found.size[2];
    check(voxels > 0 && found.vectors.size() == voxels, "a volume has all its vectors");
    check(found.index_to_lps.matrix().allFinite(), "vectors lie somewhere");
}

/// With the data file that a detached header may name.
const fs::path& folder() {
    static const bool written = [] {
        std::ofstream(myotet::fuzz::folder() / "data.raw", std::ios::binary)
            << std::string(64, '\1');
        return true;
    }();
    (void)written;
    return myotet::fuzz::folder();
}

void read(const fs::path& file, std::size_t ending, std::uint8_t byte) {
    if (ending == myotet::fuzz::kTable) {
        (void)myotet::segmentation::read_name_table(file);
        return;
    }
    if (myotet::fuzz::asks_for_vectors(byte)) {
        read_vectors(file);
        return;
    }
    const auto found = myotet::segmentation::read_labels(file, myotet::fuzz::options_of(byte));
    check(!found.layers.empty(), "there is a layer");
    for (const LabelVolume& layer : found.layers) check_layer(layer, found.layers.front());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::size_t ending = data[0] & 7;
    const fs::path file = folder() / (std::string("scan") + myotet::fuzz::kEndings[ending]);
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
    try {
        read(file, ending, data[0]);
    } catch (const Error&) {
    }
    fs::remove(file);
    return 0;
}
