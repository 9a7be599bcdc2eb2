// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "LevelSet/RegionMap.h"

namespace myotet::levelset {

/// The lattice that all regions share: sample (I, J, K) at spacing * (I, J, K)
/// in local coordinates, block B holding the samples from 8 B on.
struct SharedLattice {
    double spacing = 0;                 ///< mm
    Index3 blocks{0, 0, 0};             ///< that cover the volume and a margin
    Eigen::Affine3d local_to_index;     ///< local coordinates, mm, to voxel index
    Vec3 plane_spacing = Vec3::Zero();  ///< between voxel planes of each axis, mm
    /// The axis across slices so thick that regions are interpolated between
    /// them by shape; -1: none.
    int thick_axis = -1;

    [[nodiscard]] std::size_t slot(const Index3& b) const {
        return (static_cast<std::size_t>(b[2]) * blocks[1] + b[1]) * blocks[0] + b[0];
    }
};

/// A sample that stands for a voxel whose middle no sample is near.
struct Claim {
    std::uint64_t sample;  ///< 512 * slot of the shared block + place in the block
    Index3 voxel;
    std::uint8_t axes;  ///< bit a: along axis a the sample counts as the voxel's middle
};

/// Where the lattice is wider than the voxels, or out of step with them, a
/// sheet, tube or speck one voxel thick would fall between the samples. Each of
/// its voxels without a sample within a fifth of its side from its middle
/// therefore claims those nearest to it, smaller regions first; such a sample
/// is measured as if it lay in the middle. Sorted by sample.
[[nodiscard]] std::vector<Claim> claim_samples(const RegionMap& map, const SharedLattice& lattice);

/// The claims on the samples of one shared block.
[[nodiscard]] std::span<const Claim> claims_of_block(const std::vector<Claim>& claims,
                                                     std::size_t slot);

}  // namespace myotet::levelset
