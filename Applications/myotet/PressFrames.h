// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Membrane/Simulate.h"
#include "MeshFiles/MeshFiles.h"
#include "Report/Picture.h"

namespace myotet::app {

/// A moment of a pressed organ, its points and triangles in use alone.
struct PressFrame {
    TriMesh surface;               ///< where it is then, LPS, mm
    meshfiles::MeshArrays arrays;  ///< as the files have them
    std::vector<TriMesh> tools;    ///< where they are then
};

/// At points: `level`, `mass` (t), `force` of loads (N), `displacement` (mm), `velocity`
/// (mm/s), `curvature_change` (1/mm); at triangles: `label`, `level`.
[[nodiscard]] PressFrame frame_of(const membrane::View& view, std::int32_t label);

/// How frames are seen: from which directions, and what lies in all pictures.
struct PressView {
    Vec3 beside = Vec3::UnitY();  ///< looking across the way that tools press
    Vec3 behind = Vec3::UnitX();  ///< looking the way they press, a little from above
    Box fit;                      ///< about `points`
    std::vector<Vec3> points;     ///< of the organ in all pictures, mm
    double most = 1;              ///< displacement at the end of the colour map, mm
};

/// From the loads: along the first tool's or patch's way; without these, from the front
/// and the left.
[[nodiscard]] PressView view_of(const membrane::Loads& loads);

/// The organ from beside, with its tools, and from behind these without them, triangles'
/// edges drawn, coloured by displacement where that is at least a fiftieth of the largest.
[[nodiscard]] report::Picture frame_picture(const PressFrame& frame, const PressView& view);

}  // namespace myotet::app
