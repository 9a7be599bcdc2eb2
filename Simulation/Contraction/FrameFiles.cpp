// SPDX-License-Identifier: Apache-2.0
#include "Contraction/FrameFiles.h"

#include <algorithm>
#include <cctype>

#include "Contraction/Checkpoint.h"
#include "Core/Errors.h"

namespace myotet::contraction {
namespace fs = std::filesystem;

namespace {

// Of a frame's number, at least.
constexpr std::size_t kDigits = 4;

fs::path frame_file(std::size_t frame, const char* extension) {
    return fs::path("frames") / ("frame_" + meshfiles::frame_digits(frame) + extension);
}

std::vector<double> flat(std::span<const Vec3> points) {
    std::vector<double> numbers;
    for (const Vec3& p : points) numbers.insert(numbers.end(), p.begin(), p.end());
    return numbers;
}

// A quantity's name in a part: the grid's number and its own.
std::string key_of(std::size_t grid, const std::string& array) {
    return std::to_string(grid) + " " + array;
}

// "bone_left_radius"; with its number where another has that name already.
std::string plain_name(std::size_t number, std::string name,
                       std::span<const meshfiles::SeriesGrid> before) {
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';
    name = "bone_" + name;
    const bool taken = std::ranges::any_of(before, [&](const auto& g) { return g.name == name; });
    return taken ? name + "_" + std::to_string(number) : name;
}

// Grid 0 is the bodies, the bones follow.
std::vector<meshfiles::SeriesGrid> grids_of(const Moment& still, std::span<const TriMesh> bones,
                                            const std::vector<std::string>& names) {
    std::vector<meshfiles::SeriesGrid> grids{{.name = "bodies",
                                              .points = still.mesh.points.size(),
                                              .tets = still.mesh.tets,
                                              .triangles = {},
                                              .labels = still.mesh.labels,
                                              .label_names = still.names,
                                              .arrays = {}}};
    for (const auto& array : still.arrays.points)
        grids[0].arrays.push_back({array.name, array.components, true});
    for (const auto& array : still.arrays.cells)
        grids[0].arrays.push_back({array.name, array.components, false});
    for (std::size_t b = 0; b < bones.size(); ++b)
        grids.push_back({.name = plain_name(b, names[b], grids),
                         .points = bones[b].points.size(),
                         .tets = {},
                         .triangles = bones[b].triangles,
                         .labels = {},
                         .label_names = {},
                         .arrays = {}});
    return grids;
}

}  // namespace

FrameFiles::FrameFiles(Options options) : options_(std::move(options)) {
    MYOTET_CHECK(options_.series != Series::by_count,
                 "a series is decided before frames are written");
}

void FrameFiles::make_folders() const {
    std::error_code failed;
    fs::create_directories(options_.folder / "frames", failed);
    if (!failed && !options_.bones.empty() && options_.series == Series::pvd)
        fs::create_directories(options_.folder / "bones", failed);
    if (failed)
        throw IoError(options_.folder.string() + ": cannot make the folder: " + failed.message());
}

void FrameFiles::clear() const {
    for (const char* extension : {".vtu", ".moment"})
        remove_numbered(options_.folder / "frames", extension);
    remove_numbered(options_.folder / "bones", ".vtp");
    std::error_code none;
    for (const char* name : {kCollectionFile, kSeriesFile, "contraction.h5"})
        fs::remove(options_.folder / name, none);
}

fs::path FrameFiles::bone_file(std::size_t bone, std::size_t frame) const {
    return fs::path("bones") /
           (options_.bones[bone] + "_" + meshfiles::frame_digits(frame) + ".vtp");
}

void FrameFiles::write_part(const Moment& frame, std::span<const TriMesh> bones,
                            std::size_t number) const {
    Checkpoint part{.fingerprint = options_.fingerprint, .time = frame.arrays.time.value_or(0)};
    part.reals[key_of(0, meshfiles::kSeriesPoints)] = flat(frame.mesh.points);
    for (const auto& array : frame.arrays.points) part.reals[key_of(0, array.name)] = array.values;
    for (const auto& array : frame.arrays.cells) part.reals[key_of(0, array.name)] = array.values;
    for (std::size_t b = 0; b < bones.size(); ++b)
        part.reals[key_of(b + 1, meshfiles::kSeriesPoints)] = flat(bones[b].points);
    write_checkpoint(part, options_.folder / frame_file(number, ".moment"));
}

void FrameFiles::write(const Moment& frame, std::span<const TriMesh> bones,
                       std::span<const double> times) {
    const std::size_t number = times.size() - 1;
    if (options_.series == Series::xdmf) return write_part(frame, bones, number);
    meshfiles::write_vtu(frame.mesh, frame.names, frame.arrays,
                         options_.folder / frame_file(number, ".vtu"));
    for (std::size_t b = 0; b < bones.size(); ++b)
        meshfiles::write_vtp(bones[b], {}, options_.folder / bone_file(b, number));
    std::vector<TimedFile> listed;
    for (std::size_t i = 0; i < times.size(); ++i) {
        listed.push_back({times[i], frame_file(i, ".vtu")});
        for (std::size_t b = 0; b < options_.bones.size(); ++b)
            listed.push_back({times[i], bone_file(b, i)});
    }
    write_pvd(listed, options_.folder / kCollectionFile);
}

void FrameFiles::gather(const Moment& still, std::span<const TriMesh> bones,
                        std::span<const double> times, bool complete) const {
    if (options_.series != Series::xdmf || times.empty()) return;
    const std::vector<meshfiles::SeriesGrid> grids = grids_of(still, bones, options_.bones);
    std::size_t read = times.size();  // the number of the part at hand
    Checkpoint part;
    const auto numbers_of = [&](std::size_t frame, std::size_t grid, const std::string& array) {
        if (frame != read)
            part = read_checkpoint(options_.folder / frame_file(frame, ".moment"),
                                   options_.fingerprint);
        read = frame;
        const auto found = part.reals.find(key_of(grid, array));
        return found == part.reals.end() ? std::vector<double>() : found->second;
    };
    meshfiles::write_series(grids, times, numbers_of, options_.folder / kSeriesFile);
    if (!complete) return;
    remove_numbered(options_.folder / "frames", ".moment");
    std::error_code not_empty;
    fs::remove(options_.folder / "frames", not_empty);
}

std::vector<fs::path> FrameFiles::files(std::size_t frames) const {
    if (options_.series == Series::xdmf) return {"contraction.h5", kSeriesFile};
    std::vector<fs::path> names;
    for (std::size_t i = 0; i < frames; ++i) {
        names.push_back(frame_file(i, ".vtu"));
        for (std::size_t b = 0; b < options_.bones.size(); ++b) names.push_back(bone_file(b, i));
    }
    names.emplace_back(kCollectionFile);
    return names;
}

Series decided(Series series, std::size_t frames) {
    if (series != Series::by_count) return series;
    return frames > kMostPvdFrames ? Series::xdmf : Series::pvd;
}

void remove_numbered(const fs::path& folder, const std::string& extension) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        const std::string stem = entry.path().stem().string();
        const std::size_t last = stem.find_last_not_of("0123456789");
        const bool numbered =
            last != std::string::npos && stem[last] == '_' && stem.size() - last > kDigits;
        if (numbered && entry.path().extension() == extension) fs::remove(entry.path(), none);
    }
}

}  // namespace myotet::contraction
