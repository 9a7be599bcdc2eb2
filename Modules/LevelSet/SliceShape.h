// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "Core/Geometry.h"
#include "LevelSet/SliceSections.h"

namespace myotet::levelset {

/// How a section shrinks to nothing beyond the last slice that shows it. Its
/// radius r falls as (r / r_0)^2 = 1 - beta t - gamma t^2, t in slices, as an
/// ellipsoid's does: beta goes on with the sections before, and a blunt end takes
/// half a slice of volume.
struct SliceCap {
    double beta = 0, gamma = 0;
    /// 1 - r / r_0 at t; beyond the tip it goes on growing.
    [[nodiscard]] double shrunk(double t) const;
    /// Where r is 0; one slice at the most.
    [[nodiscard]] double end() const;
};

/// The cap of a section from its `squared` radius; `before` and `before_that` are
/// those of what it goes on from in the next slices, 0 where there is nothing.
[[nodiscard]] SliceCap cap_of(double squared, double before, double before_that);

/// A part of a region between two slices: sections that lie on each other, or
/// the cap of one that nothing lies on. Numbers are those of maps; -1: none.
struct SlicePiece {
    int lower = -1, upper = -1;               ///< in the two slices
    int below_lower = -1, above_upper = -1;   ///< one slice further, for the slopes
    double lower_slope = 0, upper_slope = 0;  ///< mm a slice, where there is no further map
    Point2 shift{0, 0};  ///< pixels that the part moves from one slice to the next
    SliceCap cap;        ///< of a part with one section
    /// Ends flat half a slice on: cut off by the end of the scan, or too thin to be rounded.
    bool cut = false;
};

/// A region of a scan in thick slices as signed distances within the slices,
/// interpolated between them.
struct SliceShape {
    int axis = 2;
    double thickness = 1;           ///< of a slice, mm
    double pixel = 1;               ///< the smaller side, mm
    int first_gap = 0;              ///< slice below the first gap with pieces
    std::vector<std::size_t> gaps;  ///< where each gap's pieces begin; one more
    std::vector<SlicePiece> pieces;
    std::vector<SliceMap> maps;

    /// Negative inside. A distance only to first order: what counts is where it is 0.
    [[nodiscard]] double value(const Vec3& index) const;
};

/// Shape-based interpolation (Raya and Udupa 1990, IEEE Trans. Med. Imaging
/// 9(1)): cubic across the slices, part by part, along the part's own
/// direction where its sections hardly overlap.
/// Cost: O(pixels of the sections' boxes).
[[nodiscard]] SliceShape slice_shape(const RegionMap& map, RegionMap::Owner owner, int axis,
                                     const Vec3& plane_spacing);

/// Slices at least this many times thicker than pixels are interpolated. Below,
/// smoothing by half a slice levels the steps as well, and meshes of knee bones
/// at 3.6 times are far smaller and better shaped: where the slices run along a
/// surface, interpolation leaves terraces that meshes then have to follow.
inline constexpr double kThickSlices = 3.75;

/// The axis with slices so much thicker than the larger of the other spacings; -1: none.
[[nodiscard]] int thick_axis(const Vec3& plane_spacing);

/// The larger spacing of the two axes within a slice, mm.
[[nodiscard]] double larger_pixel_side(const Vec3& plane_spacing, int axis);

}  // namespace myotet::levelset
