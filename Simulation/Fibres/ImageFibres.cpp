// SPDX-License-Identifier: Apache-2.0
#include "Fibres/ImageFibres.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "Core/Errors.h"
#include "Core/Parallel.h"
#include "Fibres/Dyads.h"
#include "Fibres/Gaps.h"
#include "Fibres/Laplace.h"

namespace myotet::fibres {
namespace {

constexpr std::size_t kGrain = 1024;
// Of a voxel: centroids on the outermost faces count as inside in spite of rounding.
constexpr double kFace = 1e-9;
// Weights below this are rounding of a centroid that lies in a voxel's centre.
constexpr double kNoWeight = 1e-12;

bool inside(const VectorImage& image, const Vec3& index) {
    for (int a = 0; a < 3; ++a)
        if (!(index[a] >= -0.5 - kFace && index[a] <= image.size[a] - 0.5 + kFace)) return false;
    return true;
}

/// Half a voxel beyond the outermost centres their value stays.
DyadSum dyads_at(const VectorImage& image, const Vec3& index) {
    Index3 low;
    Vec3 share;
    for (int a = 0; a < 3; ++a) {
        const double at = std::clamp(index[a], 0.0, image.size[a] - 1.0);
        low[a] = std::clamp(static_cast<int>(at), 0, std::max(image.size[a] - 2, 0));
        share[a] = at - low[a];
    }
    DyadSum sum;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        Index3 voxel;
        for (int a = 0; a < 3; ++a) {
            const int high = corner >> a & 1;
            weight *= high ? share[a] : 1 - share[a];
            voxel[a] = low[a] + high;
        }
        if (!(weight > kNoWeight)) continue;  // beyond the image there is no weight either
        const Vec3& v =
            image.vectors[(static_cast<std::size_t>(voxel[2]) * image.size[1] + voxel[1]) *
                              image.size[0] +
                          voxel[0]];
        const double length = v.stableNorm();
        if (length > 0 && v.allFinite()) sum.add(v / length, weight);
    }
    return sum;
}

void require_inside(const TetMesh& mesh, const VectorImage& image,
                    const Eigen::Affine3d& to_index) {
    std::size_t outside = 0, first = 0;
    for (std::size_t t = mesh.tets.size(); t-- > 0;)
        if (!inside(image, to_index * centroid_of(mesh, mesh.tets[t]))) {
            ++outside;
            first = t;
        }
    if (outside == 0) return;
    const Vec3 x = centroid_of(mesh, mesh.tets[first]);
    throw InputError(std::to_string(outside) + " of " + std::to_string(mesh.tets.size()) +
                     " tetrahedra lie outside the fibre image, the first of them number " +
                     std::to_string(first) + " at " + std::to_string(x.x()) + ", " +
                     std::to_string(x.y()) + ", " + std::to_string(x.z()) +
                     " mm; use an image that covers the muscle in the same frame (LPS)");
}

void point_to_insertion(const TetMesh& mesh, const ImageOptions& options,
                        std::vector<Vec3>& direction) {
    const FibreField along = laplace_fibres(mesh, options.origin_nodes, options.insertion_nodes);
    for (std::size_t t = 0; t < direction.size(); ++t)
        if (direction[t].dot(along.direction[t]) < 0) direction[t] = -direction[t];
}

}  // namespace

void VectorImage::validate() const {
    double voxels = 1;
    for (int a = 0; a < 3; ++a) {
        if (size[a] < 1)
            throw InputError("the fibre image has " + std::to_string(size[a]) +
                             " voxels along an axis, but it must have at least one");
        voxels *= size[a];
    }
    if (static_cast<double>(vectors.size()) != voxels)
        throw InputError("the fibre image has " + std::to_string(vectors.size()) +
                         " vectors, but its size makes " + std::to_string(voxels));
    if (!index_to_lps.matrix().allFinite() || !(std::abs(index_to_lps.linear().determinant()) > 0))
        throw InputError(
            "the fibre image's index_to_lps is singular or not finite; give it a spacing, an "
            "origin and three different directions");
}

Eigen::Affine3d place_image(const Vec3& spacing, const Vec3& origin, const Mat3& direction) {
    Eigen::Affine3d placed = Eigen::Affine3d::Identity();
    placed.linear() = direction * spacing.asDiagonal();
    placed.translation() = origin;
    return placed;
}

FibreField image_fibres(const TetMesh& mesh, const VectorImage& image,
                        const ImageOptions& options) {
    image.validate();
    require_positive(mesh);
    if (options.origin_nodes.empty() != options.insertion_nodes.empty())
        throw InputError(std::string("the fibre image has ") +
                         (options.origin_nodes.empty() ? "insertion" : "origin") +
                         " nodes but not the other attachment's; give both or none");
    const Eigen::Affine3d to_index = image.index_to_lps.inverse();
    require_inside(mesh, image, to_index);
    FibreField fibres{std::vector<Vec3>(mesh.tets.size(), Vec3::Zero()), {}};
    parallel_for(0, mesh.tets.size(), kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) {
            const DyadSum sum = dyads_at(image, to_index * centroid_of(mesh, mesh.tets[t]));
            if (const auto principal = sum.principal()) fibres.direction[t] = *principal;
        }
    });
    const auto has_one = [](const Vec3& v) { return !v.isZero(0); };
    if (std::none_of(fibres.direction.begin(), fibres.direction.end(), has_one))
        throw InputError(
            "the fibre image has no vector at any of the mesh's tetrahedra; check that both are "
            "of the same muscle and in the same frame (LPS)");
    if (const std::size_t filled = fill_gaps(mesh, fibres.direction); filled > 0)
        fibres.notes.push_back("the image has no direction at " + std::to_string(filled) + " of " +
                               std::to_string(mesh.tets.size()) +
                               " tetrahedra, which take their neighbours'");
    if (!options.origin_nodes.empty()) point_to_insertion(mesh, options, fibres.direction);
    return fibres;
}

}  // namespace myotet::fibres
