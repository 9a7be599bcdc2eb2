// SPDX-License-Identifier: Apache-2.0
// libFuzzer's target: whatever the bytes are, a reader gives a mesh that holds
// together, or one of the errors that it may throw, and nothing else.
#include <fstream>

#include "Core/Errors.h"
#include "Folder.h"
#include "MeshFiles/MeshFiles.h"
#include "MeshFormats.h"
#include "Unit/MeshFiles/NamedMeshes.h"

namespace {

namespace fs = std::filesystem;
using namespace myotet;
using meshfiles::NamedMesh;

void check(bool kept, const char* promise) { MYOTET_CHECK(kept, promise); }

template <std::size_t N>
void check_indices(const std::array<std::int32_t, N>& nodes, std::size_t count) {
    for (const std::int32_t n : nodes)
        check(n >= 0 && static_cast<std::size_t>(n) < count, "a node is one of the mesh");
}

void check_mesh(const NamedMesh& named) {
    const TetMesh& mesh = named.mesh;
    for (const Vec3& p : mesh.points) check(p.allFinite(), "coordinates are numbers");
    for (const Tet& tet : mesh.tets) check_indices(tet, mesh.points.size());
    check(mesh.labels.size() == mesh.tets.size(), "a tetrahedron has a label");
    check(!mesh.tets.empty() || !named.faces.empty(), "a mesh is not empty");
    for (const meshfiles::FaceSet& set : named.faces)
        for (const Triangle& face : set.triangles) check_indices(face, mesh.points.size());
    for (const meshfiles::NodeSet& set : named.nodes)
        for (const std::int32_t node : set.nodes)
            check_indices(std::array{node}, mesh.points.size());
}

/// Where the bytes go, and what to read then.
struct Place {
    fs::path bytes, mesh;
};
Place place_of(std::size_t ending) {
    const std::string_view said = fuzz::kMeshEndings[ending];
    const fs::path file = fuzz::folder() / ("file" + std::string(said));
    if (said != ".h5") return {file, file};
    return {fuzz::folder() / "other.h5", fuzz::folder() / "other.xdmf"};
}

/// A sound .xdmf and its .h5 for those inputs that are one of them.
void write_pairs() {
    for (const char* name : {fuzz::kPair, "other.xdmf"})
        write_mesh(meshfiles::three_tets(), fuzz::folder() / name);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0 || (data[0] & 15) >= fuzz::kMeshEndings.size()) return 0;
    static const bool ready = (write_pairs(), true);
    check(ready, "the pairs are written");
    const Place place = place_of(data[0] & 15);
    std::ofstream(place.bytes, std::ios::binary)
        .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
    try {
        check_mesh(meshfiles::read_mesh(place.mesh));
    } catch (const Error&) {
    }
    fs::remove(place.bytes);
    return 0;
}
