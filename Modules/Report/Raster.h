// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "Core/Geometry.h"
#include "Report/Picture.h"

namespace myotet::report {

/// A triangle on the picture: x to the right and y down in pixels, z away from the viewer.
struct FlatTriangle {
    std::array<Vec3, 3> corners;
    std::array<float, 3> colour;  ///< shaded
};

/// Draws triangles over a picture, the nearest at each sample; see draw. The same bytes on
/// any number of threads.
void rasterise(std::span<const FlatTriangle> triangles, Picture& picture);

}  // namespace myotet::report
