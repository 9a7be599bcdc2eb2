// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Fibres/FibreField.h"

namespace myotet::fibres {

/// A vector a voxel, as from diffusion imaging. Zero vectors and those that are not
/// numbers stand for voxels that have none.
struct VectorImage {
    Index3 size{0, 0, 0};  ///< voxels along i, j, k
    /// Voxel index (i, j, k), a voxel's centre being at whole numbers, to LPS, mm; not singular.
    Eigen::Affine3d index_to_lps = Eigen::Affine3d::Identity();
    std::vector<Vec3> vectors;  ///< LPS, of any length and sign; i fastest
    /// Throws InputError naming the field, its value and the rule.
    void validate() const;
};

/// Places index_to_lps from what image files hold: distances of voxel centres in mm, the
/// position of the first and, as columns, the unit vectors of i, j, k in LPS.
[[nodiscard]] Eigen::Affine3d place_image(const Vec3& spacing, const Vec3& origin,
                                          const Mat3& direction);

struct ImageOptions {
    /// If both are given, fibres point from origin to insertion: along the potential of
    /// laplace_potential, of which they have the errors. Without, as the image's vectors do.
    std::vector<std::int32_t> origin_nodes, insertion_nodes;
};

/// Fibres of an image at the centroids: the principal direction of the eight voxels'
/// v v^T / |v|^2 with trilinear weights, so that v and -v are the same [Basser02].
/// Voxels without a vector are left out; where all are, or no direction prevails, the
/// neighbours' mean line; a note says of how many tetrahedra.
/// Throws InputError when the image is not valid, when it has no vector near the mesh,
/// when one set of nodes is given without the other, and when centroids lie outside the
/// voxels, saying how many. Cost: 1 us a tetrahedron.
[[nodiscard]] FibreField image_fibres(const TetMesh& mesh, const VectorImage& image,
                                      const ImageOptions& options = {});

}  // namespace myotet::fibres
