// SPDX-License-Identifier: Apache-2.0
#include "ContractFrames.h"

#include <algorithm>

#include "Contraction/FrameFiles.h"
#include "Core/Errors.h"
#include "MeshFiles/SeriesRead.h"
#include "MeshFiles/VtuArrays.h"

namespace myotet::app {
namespace fs = std::filesystem;

namespace {

constexpr const char* kBodiesGrid = "bodies";
constexpr std::string_view kBoneGrid = "bone_";

struct Wanted {
    const char* name;
    int components;
    std::vector<double> ContractFrame::*values;
};
constexpr Wanted kWanted[] = {{"body", 1, &ContractFrame::body},
                              {"activation", 1, &ContractFrame::activation},
                              {"fiber_stretch", 1, &ContractFrame::stretch},
                              {"fiber", 3, &ContractFrame::fibre},
                              {"cauchy_stress", 9, &ContractFrame::stress}};

std::vector<Vec3> points_of(const std::vector<double>& numbers) {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
        points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    return points;
}

// Throws InputError unless each index names a point.
template <class Element>
std::vector<Element> elements_of(const std::vector<std::int32_t>& corners, std::size_t points,
                                 const fs::path& file) {
    std::vector<Element> elements(corners.size() / std::tuple_size_v<Element>);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (static_cast<std::size_t>(corners[i]) >= points)
            throw InputError(file.string() + ": an element names point " +
                             std::to_string(corners[i]) + " of " + std::to_string(points) +
                             "; the file is damaged, make the results again");
        elements[i / std::tuple_size_v<Element>][i % std::tuple_size_v<Element>] = corners[i];
    }
    return elements;
}

}  // namespace

ContractFrames::ContractFrames(const RunJson& run, fs::path folder) : folder_(std::move(folder)) {
    for (const std::string& name : texts_of(run, "files")) {
        const fs::path path(name);
        const std::string stem = path.stem().string();
        if (name == contraction::kSeriesFile) series_ = file_in(folder_, name);
        if (name.starts_with("frames/") && path.extension() == ".vtu") bodies_.push_back(name);
        if (name.starts_with("bones/") && path.extension() == ".vtp")
            bones_[stem.substr(0, stem.rfind('_'))].push_back(name);
    }
    if (series_.empty()) return;
    const meshfiles::SeriesContent content = meshfiles::read_series_content(series_);
    times_ = content.times;
    for (const std::string& grid : content.grids)
        if (grid.starts_with(kBoneGrid)) grids_[grid.substr(kBoneGrid.size())] = grid;
}

std::size_t ContractFrames::count() const {
    return series_.empty() ? bodies_.size() : times_.size();
}

std::vector<Tet> ContractFrames::tets() const {
    if (series_.empty()) return meshfiles::read_vtu(file_in(folder_, bodies_.at(0))).tets;
    return elements_of<Tet>(meshfiles::read_series_elements(series_, kBodiesGrid, 4),
                            frame_of_series(0).points.size(), series_);
}

ContractFrame ContractFrames::frame(std::size_t number) const {
    return series_.empty() ? frame_of_files(number) : frame_of_series(number);
}

ContractFrame ContractFrames::frame_of_files(std::size_t number) const {
    const fs::path file = file_in(folder_, bodies_.at(number));
    meshfiles::MeshArrays arrays = meshfiles::read_vtu_arrays(file);
    ContractFrame frame{.time = arrays.time.value_or(0),
                        .points = meshfiles::read_vtu(file).points};
    for (const Wanted& wanted : kWanted) {
        const auto found = std::ranges::find(arrays.cells, wanted.name,
                                             [](const meshfiles::NamedArray& a) { return a.name; });
        if (found == arrays.cells.end() || found->components != wanted.components)
            throw InputError(file.string() + ": has no array '" + wanted.name +
                             "', which each frame of a contraction has; make the results again");
        frame.*wanted.values = std::move(found->values);
    }
    return frame;
}

ContractFrame ContractFrames::frame_of_series(std::size_t number) const {
    const auto numbers = [&](const char* array, int components) {
        return meshfiles::read_series_array(series_, {number, kBodiesGrid, array, components});
    };
    ContractFrame frame{.time = times_.at(number),
                        .points = points_of(numbers(meshfiles::kSeriesPoints, 3))};
    for (const Wanted& wanted : kWanted)
        frame.*wanted.values = numbers(wanted.name, wanted.components);
    return frame;
}

std::vector<std::string> ContractFrames::bones() const {
    std::vector<std::string> names;
    for (const auto& [name, files] : bones_) names.push_back(name);
    for (const auto& [name, grid] : grids_) names.push_back(name);
    return names;
}

TriMesh ContractFrames::bone(const std::string& name, std::size_t number) const {
    if (series_.empty()) {
        const std::vector<std::string>& files = bones_.at(name);
        return number < files.size() ? meshfiles::read_surface(file_in(folder_, files[number]))
                                     : TriMesh{};
    }
    const std::string& grid = grids_.at(name);
    TriMesh surface;
    surface.points = points_of(
        meshfiles::read_series_array(series_, {number, grid, meshfiles::kSeriesPoints, 3}));
    surface.triangles = elements_of<Triangle>(meshfiles::read_series_elements(series_, grid, 3),
                                              surface.points.size(), series_);
    return surface;
}

}  // namespace myotet::app
