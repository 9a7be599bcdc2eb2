// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "Core/LabelVolume.h"
#include "Core/TetMesh.h"
#include "Report/Picture.h"
#include "Report/Sides.h"
#include "Report/Stroke.h"

namespace myotet::report {

/// Of slices across one of the patient's axes, all of what a box holds, as radiologists look
/// at them: x (0) from the left, y (1) from the front, z (2) from below.
struct SliceView {
    int axis = 2;
    Box box;  ///< LPS, mm; not empty

    [[nodiscard]] double width() const;   ///< mm
    [[nodiscard]] double height() const;  ///< mm
    [[nodiscard]] Sides sides() const;
    /// Where a point is in the slice's picture: mm from its left and its top.
    [[nodiscard]] Vec2 to_picture(const Vec3& point) const;
    /// The point of the slice at `at` mm along the axis that is at a place of the picture.
    [[nodiscard]] Vec3 to_patient(const Vec2& place, double at) const;
};

/// "axial", "coronal" or "sagittal".
[[nodiscard]] std::string slice_name(int axis);

/// Where a closed surface crosses the plane at `at` mm along an axis: closed curves, their
/// first point again at their ends; LPS, mm. Points on the plane count as above it, so that
/// each triangle crosses it by two edges or not at all. An open surface gives open curves.
/// Cost: triangles, and crossed ones times a logarithm.
[[nodiscard]] std::vector<std::vector<Vec3>> section(const TriMesh& surface, int axis, double at);

/// The colour of a voxel's value, by layer.
using LabelColour = std::function<Colour(int layer, std::int32_t label)>;

/// The labels of the voxels that a slice's pixels' centres lie in, the last layer's that is
/// not 0; white where there are none. `pixel` is a pixel's side, mm.
[[nodiscard]] Picture label_picture(std::span<const LabelVolume> layers, const SliceView& view,
                                    double at, double pixel, const LabelColour& colour);

/// A mesh's surface and the colour of its outline.
struct Outlined {
    TriMesh surface;
    Colour colour;
};

/// A slice's labels with the outlines of meshes over them and the patient's sides at its
/// edges: an element of a page, with `alternative` said to those who do not see it.
[[nodiscard]] std::string slice_svg(const Picture& labels, std::span<const Outlined> meshes,
                                    const SliceView& view, double at,
                                    const std::string& alternative);

}  // namespace myotet::report
