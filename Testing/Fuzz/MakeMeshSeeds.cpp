// SPDX-License-Identifier: Apache-2.0
// make_mesh_seeds OUT: writes inputs for the fuzz target of mesh files.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "MeshFormats.h"
#include "Support/TemporaryFolder.h"
#include "Unit/MeshFiles/NamedMeshes.h"

namespace {

namespace fs = std::filesystem;
using namespace myotet;

class Seeds {
public:
    explicit Seeds(fs::path out) : out_(std::move(out)) { fs::create_directories(out_); }

    void add(std::string_view ending, const std::string& bytes) {
        for (std::size_t n = 0; n < fuzz::kMeshEndings.size(); ++n) {
            if (ending != fuzz::kMeshEndings[n]) continue;
            std::ofstream file(out_ / ("mesh_" + std::to_string(count_++)), std::ios::binary);
            file << static_cast<char>(n) << bytes;
        }
    }

private:
    fs::path out_;
    int count_ = 0;
};

void add_written(Seeds& seeds) {
    const testing::TemporaryFolder folder;
    for (const meshfiles::Format& format : meshfiles::formats())
        for (const auto encoding : {meshfiles::Encoding::text, meshfiles::Encoding::binary}) {
            const fs::path file = folder / ("mesh" + std::string(format.extension));
            write_mesh(meshfiles::three_tets(), file, encoding);
            for (const fs::path& part : meshfiles::files_of(file))
                seeds.add(part.extension().string(), testing::read_bytes(part));
        }
    // The names in the .xdmf are those of the pair that lies beside it.
    seeds.add(".xdmf", testing::read_bytes(folder / fuzz::kPair));
}

void add_by_hand(Seeds& seeds) {
    seeds.add(".off",
              "OFF # c\n4 4 0\n0 0 0\n2 0 0\n0 3 0\n0 0 4\n3 0 2 1\n3 0 1 3\n3 0 3 2\n4 1 2 3 0\n");
    seeds.add(".obj", "# SPACE=RAS\nv 0 0 0\nv 2 0 0 1\nv 0 3 0\nvn 0 0 1\ng a\nf 1/1/1 -1//1 2\n");
    seeds.add(".stl",
              "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
              "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n");
    seeds.add(".ply",
              "ply\nformat ascii 1.0\ncomment faces 1007=a\nelement vertex 4\nproperty float x\n"
              "property double y\nproperty short z\nelement face 2\n"
              "property list uchar int vertex_indices\nproperty int tag\nend_header\n"
              "0 0 0\n2 0 0\n0 3 0\n0 0 4\n3 0 2 1 7\n4 0 1 3 2 8\n");
    seeds.add(".ply",
              std::string("ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty char x\n"
                          "property ushort y\nproperty uint z\nelement face 1\n"
                          "property list uchar char vertex_index\nend_header\n") +
                  std::string("\1\0\1\0\0\0\1\2\0\1\0\0\0\1\1\0\2\0\0\0\1\3\0\1\2", 25));
    seeds.add(".bdf",
              "CEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,1.+0,0.,0.\n"
              "GRID*                  3                             0.             1.D0\n"
              "*                     0.\nGRID           4              0.      0.   1.5-1\n"
              "CTETRA         1       9       1       2       3       4\nENDDATA\n");
    const std::string piece =
        "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\" NumberOfPolys=\"1\" "
        "NumberOfStrips=\"1\"><CellData><DataArray type=\"Float64\" Name=\"label\" "
        "NumberOfComponents=\"2\">7 8</DataArray></CellData><Points><DataArray type=\"Float32\" "
        "NumberOfComponents=\"3\">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points>";
    const std::string cells =
        "<DataArray type=\"Int64\" Name=\"connectivity\">0 1 2 3</DataArray>"
        "<DataArray type=\"Int8\" Name=\"offsets\" format=\"binary\">AQAAAA==BA==</DataArray>";
    const std::string head = " version=\"1.0\" byte_order=\"LittleEndian\">";
    seeds.add(".vtu", "<VTKFile type=\"UnstructuredGrid\"" + head + "<UnstructuredGrid>" + piece +
                          "<Cells>" + cells +
                          "<DataArray type=\"UInt8\" Name=\"types\">10</DataArray></Cells></Piece>"
                          "</UnstructuredGrid></VTKFile>");
    seeds.add(".vtp", "<VTKFile type=\"PolyData\"" + head + "<PolyData>" + piece + "<Polys>" +
                          cells + "</Polys><Strips>" + cells +
                          "</Strips></Piece></PolyData></VTKFile>");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "make_mesh_seeds OUT\n";
        return 2;
    }
    Seeds seeds(argv[1]);
    add_written(seeds);
    add_by_hand(seeds);
}
