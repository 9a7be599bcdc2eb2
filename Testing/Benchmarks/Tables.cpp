// SPDX-License-Identifier: Apache-2.0
// bench_tables [DATA] prints two tables: uniform and graded meshes beside those of other
// meshers, and table 1 of [Teran05] with every way of compression. DATA is a folder with
// data/ and research/PEERS.md; by default the folder `shared` beside the repository.
#include <algorithm>
#include <fstream>
#include <iostream>
#include <sstream>
#include <vector>

#include "MeshFigures.h"

using namespace myotet;
namespace fs = std::filesystem;

namespace {

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, '|');) {
        cell.erase(0, cell.find_first_not_of(' '));
        cell.erase(cell.find_last_not_of(' ') + 1);
        cells.push_back(cell);
    }
    return cells;
}

// Rows of the page's tables that tell of whole meshes of this surface: input, tool, tets,
// verts, min dih, 1%, 99%, max dih, AR mean, AR max, all-4-bdry, int. edges, nonmanif,
// vol ratio, mean dist %, Hausd %, CPU s, MB, Ktet/CPU-s.
constexpr std::size_t kColumns = 20;  // with the empty one before the first bar

void print_peers(const fs::path& page, const std::string& input) {
    std::ifstream in(page);
    for (std::string line; std::getline(in, line);) {
        const auto c = cells_of(line);
        if (c.size() != kColumns || c[1] != input) continue;
        std::cout << "| " << input << " | " << c[2] << " | " << c[3] << " | " << c[5] << " to "
                  << c[8] << " | " << c[10] << ", " << c[9] << " | " << c[11] << ", " << c[12]
                  << " | " << c[15] << " | " << c[17] << " |\n";
    }
}

std::string number(double value, int digits) {
    std::ostringstream out;
    out.setf(std::ios::fixed);
    out.precision(digits);
    out << value;
    return out.str();
}

void print_ours(const bench::MeshFigures& f, const std::string& how) {
    std::cout << "| " << f.name << " | **" << how << "** | " << f.tets << " | "
              << number(f.shapes.min_dihedral_deg, 1) << " to "
              << number(f.shapes.max_dihedral_deg, 1) << " | "
              << number(f.shapes.max_aspect_ratio, 2) << ", "
              << number(f.shapes.mean_aspect_ratio, 2) << " | "
              << f.topology.tets_with_four_boundary_nodes << ", "
              << f.topology.interior_edges_joining_boundary_nodes << " | "
              << number(100 * f.mean_of_diagonal, 3) << " | " << number(f.seconds, 2) << " |"
              << std::endl;
}

void print_against_peers(const fs::path& shared) {
    std::cout << "| surface | mesher | tetrahedra | dihedral angles | aspect ratio: largest, mean "
                 "| forbidden tetrahedra, edges | mean distance, % of diagonal | processor s |\n"
                 "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    struct Row {
        const char* input;
        const char* file;
        double fine, coarse;
    };
    constexpr Row kRows[] = {
        {"bunny", "bench_surfaces/bunny.off", 0.0152, 0.0262},
        {"dragon", "bench_surfaces/dragon.off", 0.0120, 0.0210},
        {"armadillo", "surfaces_classic/odedstein/armadillo/armadillo.obj", 0.0114, 0.0198},
        {"sphere", "bench_surfaces/sphere.off", 0.0192, 0.0332}};
    for (const Row& row : kRows) {
        const fs::path file = shared / "data" / row.file;
        if (!fs::exists(file)) {
            std::cerr << file << " is not here\n";
            continue;
        }
        print_peers(shared / "research/PEERS.md", row.input);
        print_ours(bench::mesh_surface(file, row.fine, 3, {.uniform = true, .draft = true}),
                   "Myotet, uniform, draft");
        for (const double edge : {row.coarse, row.fine})
            print_ours(bench::mesh_surface(file, edge, 4, {.uniform = true}), "Myotet, uniform");
        print_ours(bench::mesh_surface(file, row.fine, 4, {}), "Myotet, graded");
    }
}

void print_table_one(const fs::path& shared) {
    using enum meshing::Compression;
    std::cout << "\n| shape | compression | tetrahedra | aspect ratio: largest, mean | dihedral "
                 "angles | distance, % of an edge: mean, largest | forbidden | processor s |\n"
                 "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    struct Row {
        const char* file;
        double edge;
        double aspect_ratio = meshing::Options{}.aspect_ratio;
    };
    const Row kRows[] = {{"odedstein/skull/skull.obj", 0.0205, 4.0},
                         {"quartet/dragon.obj", 0.0064},
                         {"odedstein/scorpion/scorpion.obj", 0.0038}};
    const std::pair<const char*, std::vector<meshing::Compression>> kWays[] = {
        {"springs", {springs}},
        {"fem", {fem}},
        {"optimization", {optimization}},
        {"fem,optimization", {fem, optimization}}};
    for (const Row& row : kRows) {
        const fs::path file = shared / "data/surfaces_classic" / row.file;
        if (!fs::exists(file)) {
            std::cerr << file << " is not here\n";
            continue;
        }
        for (const auto& [name, way] : kWays) {
            const auto f = bench::mesh_surface(
                file, row.edge, 4,
                {.components = 1, .aspect_ratio = row.aspect_ratio, .compression = way});
            std::cout << "| " << f.name << " | " << name << " | " << f.tets << " | "
                      << number(f.shapes.max_aspect_ratio, 2) << ", "
                      << number(f.shapes.mean_aspect_ratio, 2) << " | "
                      << number(f.shapes.min_dihedral_deg, 1) << " to "
                      << number(f.shapes.max_dihedral_deg, 1) << " | "
                      << number(100 * f.mean_of_edge, 2) << ", " << number(100 * f.max_of_edge, 1)
                      << " | "
                      << f.topology.tets_with_four_boundary_nodes +
                             f.topology.interior_edges_joining_boundary_nodes
                      << " | " << number(f.seconds, 1) << " |" << std::endl;
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    const fs::path shared = argc > 1 ? fs::path(argv[1]) : fs::path(MYOTET_SHARED_DIR);
    try {
        print_against_peers(shared);
        print_table_one(shared);
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
