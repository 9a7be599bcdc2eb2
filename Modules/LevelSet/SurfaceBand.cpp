// SPDX-License-Identifier: Apache-2.0
#include "LevelSet/SurfaceBand.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "Core/Parallel.h"

namespace myotet::levelset {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;
static_assert(Leaf::DIM == Band::kSide);

// The surface in sample coordinates, as the converter asks for it.
struct Adapter {
    const TriMesh& surface;
    Vec3 origin;
    double spacing;

    [[nodiscard]] std::size_t polygonCount() const { return surface.triangles.size(); }
    [[nodiscard]] std::size_t pointCount() const { return surface.points.size(); }
    [[nodiscard]] static std::size_t vertexCount(std::size_t) { return 3; }
    void getIndexSpacePoint(std::size_t polygon, std::size_t corner, openvdb::Vec3d& out) const {
        const Vec3 p = (surface.points[surface.triangles[polygon][corner]] - origin) / spacing;
        out = openvdb::Vec3d(p.x(), p.y(), p.z());
    }
};

struct Interrupter {
    const ProgressSink& progress;
    void start(const char*) {}
    void end() {}
    bool wasInterrupted(int = -1) { return progress.interrupted(); }
};

// OpenVDB stores k fastest.
void copy_leaf(const Leaf& leaf, float width, float* out) {
    constexpr int n = Band::kSide;
    const float* from = leaf.buffer().data();
    for (int k = 0; k < n; ++k)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                *out++ = std::clamp(from[(i * n + j) * n + k], -width, width);
}

}  // namespace

Band surface_band(const TriMesh& surface, double spacing, double half_width,
                  ProgressSink& progress) {
    constexpr int n = Band::kSide;
    Box box;
    for (const Triangle& t : surface.triangles)
        for (const std::int32_t v : t) box.include(surface.points[v]);
    // Outside the band, two coarse cells and one block remain on every side.
    const double margin = (std::ceil(half_width) + 2 * n) * spacing;
    Band band;
    band.spacing = spacing;
    band.width = static_cast<float>(half_width * spacing);
    band.origin = box.min - Vec3::Constant(margin);
    for (int a = 0; a < 3; ++a)
        band.blocks[a] =
            static_cast<int>(std::ceil((box.extent()[a] + 2 * margin) / (n * spacing)));

    openvdb::initialize();
    Interrupter interrupter{progress};
    const auto transform = openvdb::math::Transform::createLinearTransform(spacing);
    const Adapter adapter{surface, band.origin, spacing};
    const float half = static_cast<float>(half_width);
    const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
        interrupter, adapter, *transform, half, half, openvdb::tools::DISABLE_RENORMALIZATION);
    progress.check();

    std::vector<const Leaf*> leaves;
    grid->tree().getNodes(leaves);
    std::sort(leaves.begin(), leaves.end(),
              [](const Leaf* a, const Leaf* b) { return a->origin() < b->origin(); });
    band.block_of.assign(static_cast<std::size_t>(band.blocks[0]) * band.blocks[1] * band.blocks[2],
                         Band::kOutside);
    for (const Leaf* leaf : leaves) {
        const openvdb::Coord c = leaf->origin();
        const Index3 place{c.x() / n, c.y() / n, c.z() / n};
        MYOTET_CHECK(c.x() >= 0 && c.y() >= 0 && c.z() >= 0 && place[0] < band.blocks[0] &&
                         place[1] < band.blocks[1] && place[2] < band.blocks[2],
                     "a distance sample lies outside the box of its surface");
        band.block_of[band.slot(place)] = static_cast<std::int32_t>(band.position.size());
        band.position.push_back(place);
    }
    band.values.resize(leaves.size() * Band::kSize);
    parallel_for(0, leaves.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            copy_leaf(*leaves[i], band.width, band.block(static_cast<std::int32_t>(i)));
    });
    mark_unstored_blocks(band);
    return band;
}

}  // namespace myotet::levelset
