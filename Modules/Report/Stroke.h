// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "Report/Picture.h"

namespace myotet::report {

/// A point of a picture, pixels: x to the right, y down; a pixel's centre is at halves.
using Vec2 = Eigen::Vector2d;

/// Part of a picture, pixels.
struct Rect {
    double left = 0, top = 0, right = kLongestSide, bottom = kLongestSide;
};

/// With what a path is drawn. Its tip is round.
struct Pen {
    double width = 1;  ///< pixels, above 0
    Colour colour = kBlack;
    Rect clip;  ///< pixels with their centres elsewhere stay as they are
    /// Lengths along the path between which the pen is down, then up, pixels; `up` 0: never up.
    double down = 0, up = 0;
};

/// Draws straight lines from point to point. A point that is not finite breaks the path, and
/// dashes begin anew after it; a point alone is a dot. Smooth at its edges: a pixel whose
/// centre is d away from the path is covered by the share width / 2 + 1/2 - d, held in [0, 1],
/// and a path that crosses itself covers no pixel twice. Coordinates are within 1e7 pixels.
/// Cost: for each line the pixels of the rectangle around it.
void draw_path(Picture& picture, std::span<const Vec2> path, const Pen& pen);

}  // namespace myotet::report
