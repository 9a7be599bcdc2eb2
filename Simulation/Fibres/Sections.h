// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "Fibres/FibreField.h"

namespace myotet::fibres {

/// Where a surface of equal potential leaves the muscle: a closed line around it.
struct Section {
    std::vector<Vec3> loop;       ///< points at equal distances along the line, mm
    Vec3 centre = Vec3::Zero();   ///< of the line, mm
    Vec3 normal = Vec3::UnitZ();  ///< unit, towards the insertion; the loop runs
                                  ///< counter-clockwise about it
    std::size_t left_out = 0;     ///< shorter closed lines at the same potential
};

/// Points of a section's loop.
inline constexpr int kLoopPoints = 256;

/// The longest closed line at which `faces`, closed and outward, have the potential
/// `level`. Where there is none, its loop is empty and its normal zero.
[[nodiscard]] Section section_at(const TetMesh& mesh, const std::vector<Triangle>& faces,
                                 std::span<const double> potential, double level);

/// Turns `of`'s loop so that its points correspond to those of `to`: after `to`'s frame is
/// carried over without a twist, the sum of squared distances is least.
void align(const Section& to, Section& of);

/// Turns a loop so that its first point lies as far out as any along its longest axis.
void begin_at_long_axis(Section& section);

}  // namespace myotet::fibres
