// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/WriteVdb.h"

#include <openvdb/Grid.h>
#include <openvdb/io/File.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "Core/AtomicFile.h"
#include "Core/Errors.h"
#include "Core/Sha256.h"

namespace myotet::levelset {
namespace {

constexpr int kCells = LevelSet::kBrickCells, kSamples = LevelSet::kBrickSamples;

using Tree = openvdb::tree::Tree4<float, 5, 4, 3>::Type;
using Grid = openvdb::Grid<Tree>;

// Lattices of one spacing are in step when their origins are whole samples apart.
openvdb::Coord offset_between(const LevelSet& first, const LevelSet& other) {
    const Vec3 steps = (other.origin - first.origin) / first.spacing;
    constexpr double kInStep = 1e-3;  // of a sample: far above rounding
    const Vec3 whole = steps.array().round();
    if (!(std::abs(other.spacing / first.spacing - 1) < 1e-9 &&
          (steps - whole).cwiseAbs().maxCoeff() < kInStep))
        throw MeshError("the level sets of one tissue are on different lattices; write each alone");
    return {static_cast<int>(whole[0]), static_cast<int>(whole[1]), static_cast<int>(whole[2])};
}

void add_component(const LevelSet& phi, const openvdb::Coord& offset, float width,
                   Grid::Accessor& grid) {
    for (std::size_t slot = 0; slot < phi.brick_of.size(); ++slot) {
        if (phi.brick_of[slot] < 0) continue;
        const auto s = static_cast<int>(slot);
        const openvdb::Coord low =
            offset + openvdb::Coord(s % phi.bricks[0] * kCells,
                                    s / phi.bricks[0] % phi.bricks[1] * kCells,
                                    s / (phi.bricks[0] * phi.bricks[1]) * kCells);
        const float* values =
            phi.values.data() + static_cast<std::size_t>(phi.brick_of[slot]) * LevelSet::kBrickSize;
        for (int k = 0; k < kCells; ++k)
            for (int j = 0; j < kCells; ++j)
                for (int i = 0; i < kCells; ++i) {
                    const float value = values[(k * kSamples + j) * kSamples + i];
                    const openvdb::Coord at = low.offsetBy(i, j, k);
                    if (std::abs(value) < width && value < grid.getValue(at))
                        grid.setValue(at, value);
                }
    }
}

openvdb::math::Transform::Ptr transform_of(const LevelSet& phi, const Frame& frame) {
    // OpenVDB multiplies rows from the left: the transpose of the usual matrix.
    openvdb::math::Mat4d m = openvdb::math::Mat4d::identity();
    const Vec3 origin = frame.to_lps(phi.origin);
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) m(b, a) = frame.rotation(a, b) * phi.spacing;
        m(3, a) = origin[a];
    }
    return openvdb::math::Transform::createLinearTransform(m);
}

// OpenVDB gives each file a random identifier, behind 8 bytes of magic number,
// three 4 byte versions and one flag. One made of the content replaces it.
void replace_identifier(std::string& bytes) {
    constexpr std::size_t kAt = 8 + 3 * 4 + 1, kLength = 36;
    MYOTET_CHECK(bytes.size() > kAt + kLength && bytes[kAt + 8] == '-', "unknown .vdb header");
    bytes.replace(kAt, kLength, "00000000-0000-0000-0000-000000000000");
    const std::string digest = sha256(bytes);
    std::size_t from = 0;
    for (std::size_t i = kAt; i < kAt + kLength; ++i)
        if (bytes[i] != '-') bytes[i] = digest[from++];
}

std::string serialised(const openvdb::GridPtrVec& grids, const std::filesystem::path& temporary) {
    openvdb::io::File file(temporary.string());
    file.setCompression(openvdb::io::COMPRESS_ACTIVE_MASK);  // level sets are never zipped
    file.write(grids);
    file.close();
    std::ifstream in(temporary, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

void write_vdb(std::span<const LevelSet* const> components, const VdbTissue& tissue,
               const std::filesystem::path& file) {
    MYOTET_CHECK(!components.empty(), "a tissue without level set is written");
    const LevelSet& first = *components.front();
    const auto width = static_cast<float>(first.band);
    const auto grid = Grid::create(width);
    auto accessor = grid->getAccessor();
    for (const LevelSet* phi : components)
        add_component(*phi, offset_between(first, *phi), width, accessor);
    openvdb::tools::signedFloodFill(grid->tree());
    grid->setTransform(transform_of(first, tissue.frame));
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->setName(tissue.name);
    grid->insertMeta("label", openvdb::Int32Metadata(tissue.label));
    grid->insertMeta("SPACE", openvdb::StringMetadata("LPS"));
    grid->insertMeta("units", openvdb::StringMetadata("mm"));
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        try {
            std::string bytes = serialised({grid}, temporary);
            replace_identifier(bytes);
            std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
            if (!out.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush())
                throw IoError(file.string() + ": cannot be written; check the space left");
        } catch (const openvdb::Exception& error) {
            throw IoError(file.string() + ": cannot be written (" + error.what() +
                          "); check that the folder may be written to and has space left");
        }
    });
}

}  // namespace myotet::levelset
