// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "Core/TetMesh.h"
#include "PageFacts.h"

namespace myotet::app {

/// One moment of a contraction's bodies.
struct ContractFrame {
    double time = 0;                 ///< s
    std::vector<Vec3> points;        ///< mm
    std::vector<double> body;        ///< a tetrahedron: which body it is of, from 0
    std::vector<double> activation;  ///< a tetrahedron
    std::vector<double> stretch;     ///< a tetrahedron
    std::vector<double> fibre;       ///< three a tetrahedron, zeros without fibres
    std::vector<double> stress;      ///< nine a tetrahedron, MPa
};

/// The frames in a folder of results: files of ParaView, or an XDMF series.
class ContractFrames {
public:
    /// Finds what report.json names. Throws InputError, IoError.
    ContractFrames(const RunJson& run, std::filesystem::path folder);

    [[nodiscard]] std::size_t count() const;
    /// Each throws InputError or IoError when a file is damaged or not there.
    [[nodiscard]] std::vector<Tet> tets() const;
    [[nodiscard]] ContractFrame frame(std::size_t number) const;
    /// Names of the bones, and one of them at a frame; some may not be in each.
    [[nodiscard]] std::vector<std::string> bones() const;
    [[nodiscard]] TriMesh bone(const std::string& name, std::size_t number) const;

private:
    [[nodiscard]] ContractFrame frame_of_files(std::size_t number) const;
    [[nodiscard]] ContractFrame frame_of_series(std::size_t number) const;

    std::filesystem::path folder_;
    std::vector<std::string> bodies_;                        // a file a frame,
    std::map<std::string, std::vector<std::string>> bones_;  // and a bone
    std::filesystem::path series_;                           // or empty
    std::vector<double> times_;
    std::map<std::string, std::string> grids_;  // of bones in the series
};

}  // namespace myotet::app
