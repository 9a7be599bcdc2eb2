// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Contraction/Measure.h"
#include "MeshFiles/Series.h"

namespace myotet::contraction {

/// How a run's frames become files.
enum class Series {
    by_count,  ///< pvd up to kMostPvdFrames frames, else xdmf
    pvd,       ///< a .vtu a frame and a .vtp a bone, and a .pvd that lists them
    xdmf       ///< one .h5 of all numbers and one .xdmf that describes it
};

inline constexpr std::size_t kMostPvdFrames = 500;

/// Names of what is written.
inline constexpr const char* kCollectionFile = "contraction.pvd";
inline constexpr const char* kSeriesFile = "contraction.xdmf";

/// The frames of a run, written as they come so that an interrupted run loses none.
/// As .pvd each is its own files, `frames/frame_0000.vtu` and `bones/NAME_0000.vtp`. As .xdmf
/// each is first a part, `frames/frame_0000.moment`, and gather() makes the series of them.
class FrameFiles {
public:
    struct Options {
        std::filesystem::path folder;    ///< of the results
        std::vector<std::string> bones;  ///< names of the surfaces that each frame is given
        Series series = Series::pvd;     ///< decided: pvd or xdmf
        std::string fingerprint;         ///< of the run; parts of another one are refused
    };
    explicit FrameFiles(Options options);

    /// Makes the folders. Throws IoError.
    void make_folders() const;
    /// Takes away what an earlier run wrote, of both kinds.
    void clear() const;
    /// Writes a frame and, as .pvd, the collection so far; `times` are those of the frames
    /// up to this one, s. Throws IoError.
    void write(const Moment& frame, std::span<const TriMesh> bones, std::span<const double> times);
    /// Makes the .xdmf series of its parts, where it is one; as .pvd there is nothing left to do.
    /// The parts are removed when the run is `complete`; otherwise it may go on with them.
    /// Throws InputError when a part is missing or of another run, IoError.
    void gather(const Moment& still, std::span<const TriMesh> bones, std::span<const double> times,
                bool complete) const;
    /// What there is of so many frames, relative to the folder; the collection is the last.
    [[nodiscard]] std::vector<std::filesystem::path> files(std::size_t frames) const;

private:
    [[nodiscard]] std::filesystem::path bone_file(std::size_t bone, std::size_t frame) const;
    void write_part(const Moment& frame, std::span<const TriMesh> bones, std::size_t number) const;

    Options options_;
};

/// by_count decided for so many frames.
[[nodiscard]] Series decided(Series series, std::size_t frames);

/// Removes a folder's files whose names end in _ and a number of four digits or more, as
/// those of frames do.
void remove_numbered(const std::filesystem::path& folder, const std::string& extension);

}  // namespace myotet::contraction
