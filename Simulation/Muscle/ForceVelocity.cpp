// SPDX-License-Identifier: Apache-2.0
#include "Muscle/ForceVelocity.h"

#include <algorithm>
#include <cmath>

#include "Muscle/Require.h"

namespace myotet::muscle {

void ForceVelocity::validate() const {
    require(max_speed > 0, "max_speed", max_speed, "it must be positive (10 is usual)");
    require(shape > 0, "shape", shape, "it must be positive (0.25 is usual)");
    require(most > 1, "most", most, "it must be more than 1 (1.4 is usual)");
}

double ForceVelocity::value(double speed) const {
    const double v = speed / max_speed;
    if (v <= -1) return 0;
    if (v <= 0) return (1 + v) / (1 - v / shape);
    const double k = (1 + 1 / shape) / (most - 1);
    return (1 + k * most * v) / (1 + k * v);
}

double ForceVelocity::slope(double speed) const {
    const double v = speed / max_speed, steepest = 1 + 1 / shape;
    if (v <= -1) return 0;
    const double below = v <= 0 ? 1 - v / shape : 1 + steepest / (most - 1) * v;
    return steepest / (below * below) / max_speed;
}

// With c the shape and k as above, of v = speed / max_speed:
//     -c v - c (1 + c) ln(1 - v / c)            -1 < v <= 0; that of -1 below
//     m v - (m - 1) / k ln(1 + k v)             v > 0
double ForceVelocity::integral(double speed) const {
    const double v = std::max(speed / max_speed, -1.0);
    if (v <= 0) return -max_speed * shape * (v + (1 + shape) * std::log1p(-v / shape));
    const double k = (1 + 1 / shape) / (most - 1);
    return max_speed * (most * v - (most - 1) / k * std::log1p(k * v));
}

}  // namespace myotet::muscle
