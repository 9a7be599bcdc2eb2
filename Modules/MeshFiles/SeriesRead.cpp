// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles/SeriesRead.h"

#include <algorithm>
#include <limits>
#include <pugixml.hpp>

#include "Core/Errors.h"
#include "MeshFiles/Hdf5.h"
#include "MeshFiles/RawMesh.h"

namespace myotet::meshfiles {
namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& file, const std::string& defect) {
    throw InputError(file.string() + ": " + defect +
                     "; the series is damaged or not one of Myotet's, make it again");
}

fs::path heavy_of(fs::path file) { return file.replace_extension(".h5"); }

}  // namespace

SeriesContent read_series_content(const fs::path& file) {
    const std::string text = read_bytes(file);
    pugi::xml_document document;
    if (!document.load_buffer(text.data(), text.size())) refuse(file, "is not valid XML");
    SeriesContent content;
    const pugi::xml_node frames = document.child("Xdmf").child("Domain").child("Grid");
    for (const pugi::xml_node frame : frames.children("Grid")) {
        const pugi::xml_attribute time = frame.child("Time").attribute("Value");
        if (!time) refuse(file, "has a frame without a time");
        if (content.times.empty()) {
            const bool several = frame.child("Grid");
            for (pugi::xml_node grid = several ? frame.child("Grid") : frame; grid;
                 grid = several ? grid.next_sibling("Grid") : pugi::xml_node())
                content.grids.emplace_back(grid.attribute("Name").value());
        }
        content.times.push_back(time.as_double());
    }
    if (content.times.empty()) refuse(file, "holds no frames");
    return content;
}

std::vector<std::int32_t> read_series_elements(const fs::path& file, const std::string& grid,
                                               int corners) {
    std::vector<std::int32_t> elements;
    for (const std::int64_t index : read_integers(heavy_of(file), grid + "_elements", corners)) {
        if (index < 0 || index > std::numeric_limits<std::int32_t>::max())
            refuse(file, "names point " + std::to_string(index));
        elements.push_back(static_cast<std::int32_t>(index));
    }
    return elements;
}

std::vector<double> read_series_array(const fs::path& file, const SeriesPlace& place) {
    return read_reals(heavy_of(file),
                      "frame_" + frame_digits(place.frame) + "/" + place.grid + "_" + place.array,
                      place.components);
}

}  // namespace myotet::meshfiles
