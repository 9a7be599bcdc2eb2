// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "Elasticity/Points.h"

namespace myotet::test {

/// A mesh of another program's, in mm: linear tetrahedra, or quadratic ones beside them.
struct ReferenceMesh {
    TetMesh linear;                       ///< corners only
    elasticity::QuadraticMesh quadratic;  ///< without tetrahedra where there are none
    std::vector<Vec3> fibres;             ///< |T|, or none
    [[nodiscard]] const std::vector<Vec3>& points() const {
        return quadratic.tets.empty() ? linear.points : quadratic.points;
    }
};

/// Reads NAME.nodes, NAME.elems and, where it is there, NAME.fibers, in metres.
inline ReferenceMesh read_reference_mesh(const std::filesystem::path& name) {
    const auto rows = [&](const std::string& extension) {
        std::ifstream file(name.string() + extension);
        std::vector<std::vector<double>> all;
        for (std::string line; std::getline(file, line);) {
            std::istringstream text(line);
            all.emplace_back();
            for (double v = 0; text >> v;) all.back().push_back(v);
            if (all.back().empty()) all.pop_back();
        }
        return all;
    };
    ReferenceMesh mesh;
    for (const auto& r : rows(".nodes"))
        mesh.linear.points.emplace_back(1e3 * r[0], 1e3 * r[1], 1e3 * r[2]);
    for (const auto& r : rows(".elems")) {
        std::array<std::int32_t, 10> ten{};
        for (std::size_t i = 1; i < r.size(); ++i) ten[i - 1] = static_cast<std::int32_t>(r[i]);
        mesh.linear.labels.push_back(static_cast<std::int32_t>(r[0]));
        mesh.linear.tets.push_back({ten[0], ten[1], ten[2], ten[3]});
        if (r.size() > 5) mesh.quadratic.tets.push_back(ten);
    }
    if (!mesh.quadratic.tets.empty()) mesh.quadratic.points = mesh.linear.points;
    for (const auto& r : rows(".fibers")) mesh.fibres.emplace_back(r[0], r[1], r[2]);
    return mesh;
}

/// A history: columns by name, as the file has them (SI units).
inline std::map<std::string, std::vector<double>> read_history(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::string line;
    std::getline(in, line);
    std::vector<std::string> names;
    std::istringstream header(line);
    for (std::string name; std::getline(header, name, ',');) names.push_back(name);
    std::map<std::string, std::vector<double>> table;
    while (std::getline(in, line)) {
        std::istringstream row(line);
        for (const std::string& name : names) {
            std::string cell;
            std::getline(row, cell, ',');
            table[name].push_back(std::stod(cell));
        }
    }
    return table;
}

/// Length, width and height in cells, each cell of a block cut into five tetrahedra with
/// alternating parity.
inline TetMesh five_tet_block(const Vec3& size, const std::array<int, 3>& cells) {
    constexpr int kFive[5][4][3] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                    {{1, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1}},
                                    {{1, 0, 1}, {0, 0, 1}, {1, 1, 1}, {1, 0, 0}},
                                    {{0, 1, 1}, {1, 1, 1}, {0, 0, 1}, {0, 1, 0}},
                                    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}};
    TetMesh mesh;
    const auto node = [&](int i, int j, int k) {
        return (i * (cells[1] + 1) + j) * (cells[2] + 1) + k;
    };
    for (int i = 0; i <= cells[0]; ++i)
        for (int j = 0; j <= cells[1]; ++j)
            for (int k = 0; k <= cells[2]; ++k)
                mesh.points.emplace_back(size.x() * i / cells[0], size.y() * j / cells[1],
                                         size.z() * k / cells[2]);
    for (int i = 0; i < cells[0]; ++i)
        for (int j = 0; j < cells[1]; ++j)
            for (int k = 0; k < cells[2]; ++k)
                for (const auto& corners : kFive) {
                    Tet tet{};
                    const int flip = (i + j + k) % 2;
                    for (int c = 0; c < 4; ++c)
                        tet[c] = node(i + (flip ? 1 - corners[c][0] : corners[c][0]),
                                      j + corners[c][1], k + corners[c][2]);
                    if (flip) std::swap(tet[2], tet[3]);
                    const auto& p = mesh.points;
                    if (signed_volume(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]) < 0)
                        std::swap(tet[2], tet[3]);
                    mesh.tets.push_back(tet);
                }
    mesh.labels.assign(mesh.tets.size(), 0);
    return mesh;
}

}  // namespace myotet::test
